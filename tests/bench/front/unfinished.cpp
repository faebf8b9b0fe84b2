#include "tests/bench/front/unfinished.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "tests/bench/front/csv.h"

namespace bench::front {

namespace {

constexpr std::string_view about_start = "# about: ";

std::string read_all(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Of a run about the same; without what was being written when it was broken off.
std::vector<Row> rows_of(const std::filesystem::path& path, const std::string& about) {
    std::string text = read_all(path);
    text.resize(text.rfind('\n') + 1);  // nothing, if there is no line end
    if (text.empty()) return {};
    const std::string first = std::string(about_start) + about + '\n';
    if (!text.starts_with(first)) {
        std::fprintf(stderr, "front: %s is about another machine or another renderer; starting anew\n", path.c_str());
        return {};
    }
    const std::string_view rest = std::string_view(text).substr(first.size());
    const bool has_columns = rest.find(header_line()) != std::string_view::npos;
    return has_columns ? from_csv(rest, path.string()).rows : std::vector<Row>{};
}

}  // namespace

// Written anew, so that what was broken off within a line goes on with a whole one.
Unfinished::Unfinished(std::filesystem::path path, const std::string& about, const Machine& machine)
    : path_(std::move(path)), rows_(rows_of(path_, about)) {
    const std::filesystem::path fresh = path_.string() + ".new";
    file_.reset(std::fopen(fresh.c_str(), "wb"));
    if (!file_) throw std::runtime_error("cannot write " + path_.string() + ": " + std::strerror(errno));
    write(std::string(about_start) + about + '\n' + to_csv({machine, rows_}));
    std::filesystem::rename(fresh, path_);
}

void Unfinished::add(const Row& row) {
    write(line_of(row) + '\n');
    rows_.push_back(row);
}

void Unfinished::remove() {
    file_.reset();
    std::filesystem::remove(path_);
}

void Unfinished::write(const std::string& text) {
    const bool is_written =
        std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() && std::fflush(file_.get()) == 0;
    if (!is_written) throw std::runtime_error("cannot write " + path_.string() + ": " + std::strerror(errno));
}

}  // namespace bench::front
