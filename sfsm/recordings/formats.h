// The tables that tools write, and which of their columns we read. A tool or a column more is a line in formats.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/recordings/raw_times.h"

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
    record,   // what a line is: of Afterburner's own files

    // Rows may end before these.
    display_change,   // [ms] from the display's change before to the one that shows the frame
    displayed_time,   // [ms] how long it was shown
    animation_error,  // [ms]
    compilations,     // how many shaders or pipelines
    animation_time,   // [ms] when its simulation began
    simulation_step,  // [ms] since the one before began
    cpu_start,        // [ms] when the CPU began with it
    present_seconds,  // [s] when Present() was called
    in_present,       // [ms] how long it took
    runtime,
    resolution,
    present_mode,
};
inline constexpr std::size_t column_count = 26;
constexpr bool may_be_missing(Column column) {
    return column >= Column::display_change;
}

enum class Rows {
    presents,  // one a present
    frames,    // one a frame
    samples,   // one now and then, or one a frame
    clock,     // one a frame: when it began
    times,     // a column of times, of which the header tells what it can
};

struct Format {
    std::string_view name;
    Rows rows;
    std::string_view frame_time;                                         // the column that it must have
    std::vector<std::string_view> marks;                                 // and one of these, if there are any
    bool has_preamble = false;                                           // and lines "//Key=Value" before the header
    std::string_view frame_rest = {};                                    // a second column that it must have
    std::optional<Unit> unit = {};                                       // of Rows::times
    enum class Lines { rows, unreal, afterburner } lines = Lines::rows;  // what lines behind the header are
};

// What is asked for in place of what the table finds.
struct ColumnWish {
    std::string column;        // a name, or a number from 1 where columns have no names; empty: any that is known
    std::optional<Unit> unit;  // of Rows::times
};

// Where the columns of one file stand.
struct Header {
    const Format* format = nullptr;
    char separator = ',';
    std::size_t fields = 0;
    ColumnMeaning meaning;  // of Rows::times
    bool is_a_row = false;  // the line has no names but values
    std::array<std::optional<std::size_t>, column_count> position;
    std::array<std::string, column_count> names;  // as the file has them

    bool has(Column column) const { return position[static_cast<std::size_t>(column)].has_value(); }
    const std::string& name(Column column) const { return names[static_cast<std::size_t>(column)]; }
};

// The header that `line` is, if it is one; names in any case, separators ',', ';' or tab. A table that is none of these
// may have one column of times: by its name ("Frame time (ms)"), or as a number alone in its line. Throws as `place`
// does if a column that we read is there twice.
std::optional<Header> find_header(std::string_view line, bool after_preamble, const ColumnWish& wish,
                                  const LineReader& place);

// The columns with numbers of a table whose header is `line`, in quotes, or their
// numbers where it has no names; `next` is the line behind it. Empty: there are none.
std::string number_columns(std::string_view line, std::string_view next);

// "one of our own traces, PresentMon ...", for messages: short, as they are one line.
std::string readable_formats();

// The number that a field tells. NaN: not available; nothing: no number. A decimal comma is as good as a point.
std::optional<double> told_number(std::string_view text);

// "NA" or the like, or what a C library writes where there is no number: "-1.#IND", "1.#QNAN", "-nan(ind)" ...
bool is_not_available(std::string_view text);

}  // namespace sfsm
