// Files from outside, opened with care and read in blocks: memory is a block and the longest line or record. Internal
// to the loaders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/block_buffer.h"

namespace model {

// Throws std::runtime_error "found `found`; expected `expected`". The loaders put the file's name before it.
[[noreturn]] void fail(const std::string& found, const std::string& expected);

// What may stand in a message: printable, one line, cut where it is long, in quotes.
std::string in_quotes(std::string_view text);

[[noreturn]] void throw_with_name(const std::filesystem::path& path);  // with_name's, within its handler

// Runs load() and puts the file's name before what it throws, as one line; out of memory too.
template <typename Load>
auto with_name(const std::filesystem::path& path, Load load) {
    try {
        return load();
    } catch (...) {
        throw_with_name(path);
    }
}

// A regular file: a pipe would block, and /dev/zero has no end.
class InputFile {
public:
    static constexpr std::size_t longest_line = std::size_t{1} << 24;  // [bytes]

    enum class Packing { as_it_is, unpacked };

    // Throws if there is no such file; `expected` says what should be there. Unpacked: a file that begins as gzip's do
    // is read as what is packed in it, of 16 MiB and a hundred bytes a byte of the file at most.
    InputFile(const std::filesystem::path& path, const std::string& expected, Packing packing = Packing::as_it_is);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    int descriptor() const { return descriptor_; }
    bool packed() const { return gzip_ != nullptr; }
    std::uint64_t left() const { return unread_ + buffer_.size(); }  // bytes not yet handed out; of packed ones at most

    // The next line without its line end (LF, CR LF or CR); valid until the next call. False: there is none. After a
    // line that ended in CR alone, a LF that follows a CR is of the next line.
    bool line(std::string_view& out);
    std::uint64_t line_number() const { return line_number_; }  // of the last line, from 1; 0 before the first

    // The next bytes, valid until the next call; throws where there are fewer. size: at most 64 KiB.
    const unsigned char* take(std::size_t size) {
        if (buffer_.size() < size) require(size);
        no_feed_ = no_return_ = 0;
        return reinterpret_cast<const unsigned char*>(buffer_.take(size));
    }
    void skip(std::uint64_t size);

    // The next bytes, as many as there are up to `size`, which stay the next; valid until the next call.
    std::string_view peek(std::size_t size);

private:
    class Gzip;

    bool fill();
    std::size_t read_bytes(std::span<char> room);
    void require(std::size_t size);
    bool find_line(std::size_t& length, std::size_t& end);

    int descriptor_ = -1;
    std::uint64_t unread_ = 0;  // of the size that the file had, or that may be in a packed one
    std::unique_ptr<Gzip> gzip_;
    std::size_t no_feed_ = 0, no_return_ = 0;  // up to there the buffer has no LF, no CR
    bool returns_ = false;                     // a line has ended in CR alone
    sfsm::BlockBuffer buffer_;
    std::uint64_t line_number_ = 0;
};

// All of it; throws as InputFile does, and if it is larger than `most_bytes`.
std::vector<unsigned char> read_file(const std::filesystem::path& path, const std::string& expected,
                                     std::uint64_t most_bytes);

}  // namespace model
