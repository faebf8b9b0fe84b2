// The tables that tools write, and which of their columns we read. A tool or a column more is a line in formats.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sfsm {

class LineReader;

// What we read of a row.
enum class Column {
    frame_time,  // [ms]; of Rows::clock the time since the recording began
    frame_rest,  // [ms] to be added to it: where a tool writes two parts
    process,
    process_id,
    swap_chain,
    cpu,  // [ms]
    gpu,
    dropped,       // 0: shown, 1: never shown; anything else: unknown
    displayed,     // [ms] some time until or on display; 0 or NA: never shown. Read where there is no `dropped`
    frame_type,    // "Application", or who made the frame
    present_time,  // any text that differs from present to present
    fps,
    elapsed,  // [ns]
};
inline constexpr std::size_t column_count = 13;

enum class Rows {
    presents,  // one a present
    samples,   // one now and then, or one a frame
    clock,     // one a frame: when it began
};

struct Format {
    std::string_view name;
    Rows rows;
    std::string_view frame_time;          // the column that it must have
    std::vector<std::string_view> marks;  // and one of these, if there are any
    bool has_preamble = false;            // and lines "//Key=Value" before the header
    std::string_view frame_rest = {};     // a second column that it must have
};

// Where the columns of one file stand.
struct Header {
    const Format* format = nullptr;
    char separator = ',';
    std::size_t fields = 0;
    std::array<std::optional<std::size_t>, column_count> position;
    std::array<std::string, column_count> names;  // as the file has them

    bool has(Column column) const { return position[static_cast<std::size_t>(column)].has_value(); }
    const std::string& name(Column column) const { return names[static_cast<std::size_t>(column)]; }
};

// The header that `line` is, if it is one; names in any case, separators ',', ';' or tab. Throws as `place` does if a
// column that we read is there twice.
std::optional<Header> find_header(std::string_view line, bool after_preamble, const LineReader& place);

// "PresentMon 1.x, ...", for messages.
std::string readable_formats();

}  // namespace sfsm
