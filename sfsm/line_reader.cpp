#include "sfsm/line_reader.h"

#include <algorithm>
#include <cstring>
#include <istream>
#include <stdexcept>
#include <utility>

namespace sfsm {
namespace {

constexpr std::size_t block = std::size_t{64} << 10;  // stays in the second-level cache until it is read again

}  // namespace

LineReader::LineReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)), buffer_(block) {
    fill();
    if (head().starts_with("\xEF\xBB\xBF")) begin_ += 3;
}

bool LineReader::next(std::string_view& line) {
    ++number_;
    std::size_t searched = 0;  // of the bytes from begin_
    const char* newline = nullptr;
    while (true) {
        const char* begin = buffer_.data() + begin_;
        const std::size_t size = end_ - begin_;
        if (size > searched) newline = static_cast<const char*>(std::memchr(begin + searched, '\n', size - searched));
        const std::size_t length = newline ? static_cast<std::size_t>(newline - begin) : size;
        if (length > longest_line) fail("found a line over 1 MiB, expected a row of a trace");
        if (newline) break;
        searched = size;
        if (!fill()) break;
    }
    if (!newline && begin_ == end_) {
        --number_;
        return false;
    }
    has_line_end_ = newline != nullptr;
    const std::size_t length = newline ? static_cast<std::size_t>(newline - (buffer_.data() + begin_)) : end_ - begin_;
    line = {buffer_.data() + begin_, length};
    begin_ += length + has_line_end_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
}

// Reads behind the bytes not yet handed out. False at the end of the stream.
bool LineReader::fill() {
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
    in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
    if (in_.bad()) fail("found a file that can't be read on, expected a row of a trace");
    end_ += static_cast<std::size_t>(in_.gcount());
    return in_.gcount() > 0;
}

void LineReader::fail_at(std::int64_t line, const std::string& found_and_expected) const {
    const std::int64_t first = 1;
    throw std::runtime_error(name_ + ":" + std::to_string(std::max(line, first)) + ": " + found_and_expected);
}

}  // namespace sfsm
