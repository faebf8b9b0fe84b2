#include "model/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
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

constexpr std::array<char, 2> gzip_magic{'\x1f', '\x8b'};

// A bomb of a few bytes may unfold to anything.
std::uint64_t most_unpacked(std::uint64_t packed_bytes) {
    constexpr std::uint64_t free = std::uint64_t{16} << 20, bytes_a_byte = 100;
    return free + std::min(packed_bytes, std::numeric_limits<std::uint64_t>::max() / (2 * bytes_a_byte)) * bytes_a_byte;
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

// What gzip packed, member after member.
class InputFile::Gzip {
public:
    Gzip() {
        if (inflateInit2(&stream_, MAX_WBITS + 16) != Z_OK) throw std::bad_alloc();
    }
    ~Gzip() { inflateEnd(&stream_); }
    Gzip(const Gzip&) = delete;
    Gzip& operator=(const Gzip&) = delete;

    // As many bytes as come of what read(room) gives; 0 at the end.
    template <typename Read>
    std::size_t unpack(std::span<char> room, Read read) {
        stream_.next_out = reinterpret_cast<Bytef*>(room.data());
        stream_.avail_out = static_cast<uInt>(room.size());
        while (stream_.avail_out == room.size()) {
            if (stream_.avail_in == 0) {
                stream_.avail_in = static_cast<uInt>(read(std::span<char>(packed_)));
                stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
                if (stream_.avail_in == 0 && !at_member_end_) fail("a gzip file that ends too early", "all of it");
                if (stream_.avail_in == 0) break;
            }
            if (at_member_end_ && *stream_.next_in != gzip_magic[0]) break;  // padding
            if (at_member_end_) inflateReset(&stream_);
            const int result = inflate(&stream_, Z_NO_FLUSH);
            at_member_end_ = result == Z_STREAM_END;
            if (result != Z_OK && result != Z_STREAM_END) fail("a damaged gzip file", "one that unpacks");
        }
        return room.size() - stream_.avail_out;
    }

private:
    z_stream stream_{};
    std::array<char, sfsm::BlockBuffer::block> packed_;
    bool at_member_end_ = false;
};

InputFile::InputFile(const fs::path& path, const std::string& expected, Packing packing) {
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
    std::array<char, 2> magic{};
    if (packing == Packing::as_it_is || pread(descriptor_, magic.data(), magic.size(), 0) != 2 || magic != gzip_magic)
        return;
    gzip_ = std::make_unique<Gzip>();
    unread_ = most_unpacked(unread_);
}

InputFile::~InputFile() {
    if (descriptor_ >= 0) close(descriptor_);
}

// 0: there are no more.
std::size_t InputFile::read_bytes(std::span<char> room) {
    ssize_t got = 0;
    do {
        got = room.empty() ? 0 : read(descriptor_, room.data(), room.size());
    } while (got < 0 && errno == EINTR);
    if (got < 0) fail(reason(), "its bytes");
    return static_cast<std::size_t>(got);
}

// False at the end of the file.
bool InputFile::fill() {
    std::span<char> room = buffer_.room();
    if (!gzip_) room = room.first(static_cast<std::size_t>(std::min<std::uint64_t>(unread_, room.size())));
    const std::size_t got =
        gzip_ ? gzip_->unpack(room, [&](std::span<char> bytes) { return read_bytes(bytes); }) : read_bytes(room);
    if (gzip_ && got > unread_) fail("more than a hundred bytes a byte in a gzip file", "less");
    unread_ = got == 0 ? 0 : unread_ - got;  // it may have become shorter
    buffer_.added(got);
    return got > 0;
}

// The buffer's first line and where the next begins. False: it may not end there yet.
bool InputFile::find_line(std::size_t& length, std::size_t& end) {
    const std::string_view rest = buffer_.rest();
    no_feed_ = std::min(rest.find('\n', no_feed_), rest.size());
    no_return_ = std::min(rest.find('\r', no_return_), rest.size());
    length = std::min(no_feed_, no_return_);
    end = length + 1;
    if (length == rest.size()) return false;
    if (no_return_ > no_feed_ || returns_) return true;
    if (end == rest.size() && unread_ > 0) return false;  // a LF may come
    const bool feed = end < rest.size() && rest[end] == '\n';
    if (feed) ++end;
    returns_ = !feed;
    return true;
}

bool InputFile::line(std::string_view& out) {
    ++line_number_;
    std::size_t length = 0, end = 0;
    while (!find_line(length, end)) {
        if (buffer_.size() > longest_line) fail("a line over 16 MiB", "shorter ones");
        if (fill()) continue;
        if (find_line(length, end)) break;
        if (buffer_.size() == 0) {
            --line_number_;
            return false;
        }
        end = length;
        break;
    }
    out = buffer_.rest().substr(0, length);
    buffer_.take(end);
    no_feed_ -= std::min(no_feed_, end);
    no_return_ -= std::min(no_return_, end);
    return true;
}

std::string_view InputFile::peek(std::size_t size) {
    while (buffer_.size() < size && fill()) continue;
    return buffer_.rest().substr(0, size);
}

void InputFile::require(std::size_t size) {
    while (buffer_.size() < size)
        if (!fill()) fail("the end of the file", "more data");
}

void InputFile::skip(std::uint64_t size) {
    if (size > left()) fail("the end of the file", "more data");
    no_feed_ = no_return_ = 0;
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
