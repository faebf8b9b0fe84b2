#include "tests/bench/front/files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace bench::front {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw std::runtime_error("cannot read " + path.string() + ": " + reason);
}

}  // namespace

std::optional<std::string> contents_of(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) return {};
    if (error) fail(path, error.message());
    if (std::filesystem::is_directory(status)) fail(path, "found a directory, expected a file");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, std::strerror(errno));
    return std::string(std::istreambuf_iterator<char>(file), {});
}

void make_folder(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw std::runtime_error("cannot make the folder " + path.string() + ": " + error.message());
}

}  // namespace bench::front
