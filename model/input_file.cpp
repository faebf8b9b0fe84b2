#include "model/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>

namespace model {
namespace {

namespace fs = std::filesystem;

// What is there in place of a file.
std::string kind_of(const fs::path& path, const std::error_code& error, fs::file_type type) {
    if (path.empty()) return "an empty name";
    switch (type) {
        case fs::file_type::not_found:
            return "no such file";
        case fs::file_type::directory:
            return "a directory";
        case fs::file_type::character:
        case fs::file_type::block:
            return "a device";
        case fs::file_type::fifo:
            return "a pipe";
        default:
            return error ? "a file that can't be read (" + error.message() + ")" : "no file of bytes";
    }
}

std::string reason() {
    return "a file that can't be read (" + std::generic_category().message(errno) + ")";
}

// Names out of the file may hold anything.
std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    return text;
}

}  // namespace

void fail(const std::string& found, const std::string& expected) {
    throw std::runtime_error("found " + found + "; expected " + expected);
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    const bool cut = text.size() > longest;
    return "'" + one_line(std::string(text.substr(0, longest))) + (cut ? "..." : "") + "'";
}

void throw_with_name(const fs::path& path) {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(one_line(path.string()) + ": found more than fits into memory; expected less");
    } catch (const std::exception& error) {
        throw std::runtime_error(one_line(path.string() + ": " + error.what()));
    }
}

InputFile::InputFile(const fs::path& path, const std::string& expected) {
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if (type != fs::file_type::regular) fail(kind_of(path, error, type), expected);
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status {};
    if (descriptor_ < 0 || fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        const std::string found = reason();
        if (descriptor_ >= 0) close(descriptor_);
        fail(found, expected);
    }
    unread_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
    close(descriptor_);
}

// False at the end of the file.
bool InputFile::fill() {
    const std::span<char> room = buffer_.room();
    const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(unread_, room.size()));
    ssize_t got = 0;
    do {
        got = wanted > 0 ? read(descriptor_, room.data(), wanted) : 0;
    } while (got < 0 && errno == EINTR);
    if (got < 0) fail(reason(), "its bytes");
    unread_ = got == 0 ? 0 : unread_ - static_cast<std::uint64_t>(got);  // it may have become shorter
    buffer_.added(static_cast<std::size_t>(got));
    return got > 0;
}

bool InputFile::line(std::string_view& out) {
    ++line_number_;
    while (!buffer_.take_line(out)) {
        if (buffer_.size() > longest_line) fail("a line over 16 MiB", "shorter ones");
        if (fill()) continue;
        if (buffer_.take_last_line(out)) break;
        --line_number_;
        return false;
    }
    return true;
}

void InputFile::require(std::size_t size) {
    while (buffer_.size() < size)
        if (!fill()) fail("the end of the file", "more data");
}

void InputFile::skip(std::uint64_t size) {
    if (size > left()) fail("the end of the file", "more data");
    while (size > 0) {
        if (buffer_.size() == 0) require(1);
        const std::size_t step = static_cast<std::size_t>(std::min<std::uint64_t>(size, buffer_.size()));
        buffer_.take(step);
        size -= step;
    }
}

std::vector<unsigned char> read_file(const fs::path& path, const std::string& expected, std::uint64_t most_bytes) {
    InputFile file(path, expected);
    if (file.left() > most_bytes)
        fail(std::to_string(file.left()) + " bytes", "a file of at most " + std::to_string(most_bytes));
    std::vector<unsigned char> bytes(static_cast<std::size_t>(file.left()));
    for (std::size_t at = 0; at < bytes.size(); at += sfsm::BlockBuffer::block) {
        const std::size_t size = std::min(sfsm::BlockBuffer::block, bytes.size() - at);
        std::memcpy(bytes.data() + at, file.take(size), size);
    }
    return bytes;
}

}  // namespace model
