#include "apps/places.h"

#include <stdexcept>
#include <system_error>

namespace apps {

namespace fs = std::filesystem;

namespace {

constexpr int most_links = 40;  // as the kernel follows

[[noreturn]] void refuse(const Place& a, const Place& b, const std::string& where, const std::string& expected) {
    throw std::invalid_argument(a.option + " and " + b.option + ": found both " + where + ", expected " + expected);
}

}  // namespace

fs::path followed(const fs::path& path) {
    std::error_code error;
    fs::path end = fs::absolute(path, error);
    // weakly_canonical takes a link that leads to nothing for a name that is still free.
    for (int links = 0; links < most_links && fs::is_symlink(fs::symlink_status(end, error)); ++links)
        end = end.parent_path() / fs::read_symlink(end, error);
    const fs::path whole = fs::weakly_canonical(end, error);
    return error ? end : whole;
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    const fs::file_status of_a = fs::status(a, error), of_b = fs::status(b, error);
    if (!fs::exists(of_a) && !fs::exists(of_b)) return followed(a) == followed(b);
    return fs::is_regular_file(of_a) && fs::is_regular_file(of_b) && fs::equivalent(a, b, error);
}

void check_places(std::span<const Place> inputs, std::span<const Place> outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const Place& output = outputs[i];
        if (output.path.empty()) continue;
        for (const Place& other : outputs.first(i)) {
            if (other.path.empty()) continue;
            if (other.path == "-" && output.path == "-") refuse(other, output, "on stdout", "at most one there");
            if (other.path == "-" || output.path == "-") continue;
            if (same_file(other.path, output.path)) refuse(other, output, "to be " + output.path, "two files");
        }
        if (output.path == "-") continue;
        for (const Place& input : inputs) {
            if (!input.path.empty() && same_file(input.path, output.path))
                refuse(input, output, "to be " + output.path, "an output that is not an input");
        }
    }
}

}  // namespace apps
