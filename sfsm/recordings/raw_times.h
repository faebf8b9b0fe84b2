// Times as a column has them, and what they mean: their unit, and whether they are of frames or of a clock. A file has
// one unit and one meaning, decided from all its rows.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace sfsm {

enum class Unit { ns, us, ms, s, fps };

// Of "us", "microseconds" ... in any case; nothing for any other text.
std::optional<Unit> unit_named(std::string_view name);
std::string_view name_of(Unit unit);

// [ms]
double in_milliseconds(double time, Unit unit);

// Of two in the middle the greater; NaN of none.
double median(std::vector<double> values);

// A row whose time can't be told before all are known.
struct RawTime {
    double time = 0;                                        // in the file's unit
    double fps = std::numeric_limits<double>::quiet_NaN();  // that it says beside; NaN: not told
    double elapsed_ns = std::numeric_limits<double>::quiet_NaN();
    std::int64_t line = 0;
    bool is_first = false;  // behind a header: a clock begins anew
};

struct StreamFrames;

// What a column is known to hold; what isn't told is decided from the rows.
struct ColumnMeaning {
    std::optional<Unit> unit;
    enum class Sense { frames, likely_clock, to_be_found } sense = Sense::to_be_found;
};

// The raw times become frames. Not told, a unit is the one in which the median is most likely a frame's, and a sense is
// that of a clock if times hardly ever stand or run back; what is likely a clock is none if they do so in most rows
// or go up and down in a small range.
// Guesses become notes.
void take_raw_times(StreamFrames& stream, ColumnMeaning meaning);

}  // namespace sfsm
