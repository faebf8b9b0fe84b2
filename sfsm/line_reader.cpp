#include "sfsm/line_reader.h"

#include <algorithm>
#include <istream>
#include <stdexcept>
#include <utility>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr const char* too_long = "found a line over 1 MiB, expected a row of a trace";

}  // namespace

LineReader::LineReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {
    fill();
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (head().starts_with(mark)) buffer_.take(mark.size());
}

bool LineReader::next(std::string_view& line) {
    ++number_;
    has_line_end_ = buffer_.take_line(line);
    while (!has_line_end_) {
        if (buffer_.size() > longest_line) fail(too_long);
        if (!fill()) break;
        has_line_end_ = buffer_.take_line(line);
    }
    if (!has_line_end_ && !buffer_.take_last_line(line)) {
        --number_;
        has_line_end_ = true;
        return false;
    }
    if (line.size() > longest_line) fail(too_long);
    return true;
}

// False at the end of the stream.
bool LineReader::fill() {
    const std::span<char> room = buffer_.room();
    in_.read(room.data(), static_cast<std::streamsize>(room.size()));
    if (in_.bad()) fail("found a file that can't be read on, expected a row of a trace");
    buffer_.added(static_cast<std::size_t>(in_.gcount()));
    return in_.gcount() > 0;
}

void LineReader::fail_at(std::int64_t line, const std::string& found_and_expected) const {
    const std::int64_t first = 1;
    throw std::runtime_error(name_ + ":" + std::to_string(std::max(line, first)) + ": " + found_and_expected);
}

}  // namespace sfsm
