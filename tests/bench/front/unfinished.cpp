#include "tests/bench/front/unfinished.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "tests/bench/front/csv.h"
#include "tests/bench/front/files.h"

namespace bench::front {

namespace {

constexpr std::string_view about_start = "# about: ";

// Of a run about the same; without what was being written when it was broken off.
std::vector<Row> rows_of(const std::filesystem::path& path, const std::string& about) {
    std::string text = contents_of(path).value_or("");
    text.resize(text.rfind('\n') + 1);  // nothing, if there is no line end
    if (text.empty()) return {};
    const std::string first = std::string(about_start) + about + '\n';
    const bool has_columns = text.find('\n' + header_line() + '\n') != std::string::npos;
    if (!text.starts_with(first) || !has_columns) {
        std::fprintf(stderr, "front: %s is about another machine, another renderer or other columns; starting anew\n",
                     path.c_str());
        return {};
    }
    constexpr std::int64_t lines_before = 1;
    return from_csv(std::string_view(text).substr(first.size()), path.string(), lines_before).rows;
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
