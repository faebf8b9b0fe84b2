#include "apps/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace apps {
namespace {

constexpr std::string_view standard_output = "-";

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot write " + (path == standard_output ? "standard output" : path) + ": " + reason);
}

// The reason of the last failed write; streams keep none of their own.
std::string last_error() {
    return errno != 0 ? std::strerror(errno) : "the write failed";
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
    if (path_ == standard_output) return;
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path_, ignored);
    if (std::filesystem::is_directory(status)) fail(path_, "found a directory, expected a file");
    if (std::filesystem::exists(status)) target_ = std::filesystem::canonical(path_, ignored).string();
    if (target_.empty()) target_ = path_;
    const bool in_place = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
    if (!in_place) temporary_ = target_ + ".part" + std::to_string(::getpid());
    errno = 0;
    file_.open(in_place ? target_ : temporary_, std::ios::binary);
    if (file_) return;
    temporary_.clear();
    fail(path_, last_error());
}

OutputFile::~OutputFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

std::ostream& OutputFile::stream() {
    return path_ == standard_output ? std::cout : file_;
}

void OutputFile::commit() {
    errno = 0;
    stream().flush();
    if (file_.is_open()) file_.close();
    if (!stream()) fail(path_, last_error());
    if (temporary_.empty()) return;
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) fail(path_, error.message());
    temporary_.clear();
}

}  // namespace apps
