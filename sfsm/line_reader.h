// Lines of a stream, read in blocks: memory is a block and the longest line, whatever the length of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

#include "sfsm/block_buffer.h"

namespace sfsm {

class LineReader {
public:
    static constexpr std::size_t longest_line = std::size_t{1} << 20;  // [bytes]

    // Skips a UTF-8 byte order mark. `name` is the file's in messages; `in` must outlive the reader.
    LineReader(std::istream& in, std::string name);

    // The first bytes of the file (up to 64 KiB), to tell what it is. Before the first line only.
    std::string_view head() const { return buffer_.rest(); }

    // The next line without its line end (LF or CR LF); valid until the next call. False: there is none. Throws
    // std::runtime_error for a line over longest_line and where the stream can't be read.
    bool next(std::string_view& line);

    // The next byte, or -1 at the end: for readers of a format without lines. Those taken are counted nevertheless, a
    // line feed as the last of its line.
    int peek_byte() { return buffer_.size() == 0 && !fill() ? -1 : static_cast<unsigned char>(buffer_.rest().front()); }
    int next_byte() {
        const int byte = peek_byte();
        if (byte < 0) return byte;
        buffer_.take(1);
        number_ = newlines_ + 1;
        newlines_ += byte == '\n';
        return byte;
    }

    std::int64_t number() const { return number_; }      // of the last line, from 1; 0 before the first
    bool has_line_end() const { return has_line_end_; }  // the last line; false: the file ends within it
    const std::string& name() const { return name_; }

    // Throw std::runtime_error "name:line: found_and_expected", of the last line or another one.
    [[noreturn]] void fail(const std::string& found_and_expected) const { fail_at(number_, found_and_expected); }
    [[noreturn]] void fail_at(std::int64_t line, const std::string& found_and_expected) const;

private:
    bool fill();

    std::istream& in_;
    std::string name_;
    BlockBuffer buffer_;
    std::int64_t number_ = 0, newlines_ = 0;
    bool has_line_end_ = true;
};

}  // namespace sfsm
