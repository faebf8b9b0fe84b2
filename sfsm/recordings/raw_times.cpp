#include "sfsm/recordings/raw_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sfsm/recordings/stream_frames.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

constexpr std::array<std::pair<std::string_view, Unit>, 18> unit_names = {{{"ns", Unit::ns},
                                                                           {"nanoseconds", Unit::ns},
                                                                           {"us", Unit::us},
                                                                           {"\u00b5s", Unit::us},
                                                                           {"\u03bcs", Unit::us},
                                                                           {"usec", Unit::us},
                                                                           {"microseconds", Unit::us},
                                                                           {"ms", Unit::ms},
                                                                           {"msec", Unit::ms},
                                                                           {"milliseconds", Unit::ms},
                                                                           {"millis", Unit::ms},
                                                                           {"s", Unit::s},
                                                                           {"sec", Unit::s},
                                                                           {"secs", Unit::s},
                                                                           {"seconds", Unit::s},
                                                                           {"fps", Unit::fps},
                                                                           {"hz", Unit::fps},
                                                                           {"frames/s", Unit::fps}}};

// How times go on from row to row.
struct Course {
    std::size_t steps = 0, back = 0;  // back: or standing
    double risen = 0, range = 0;      // sum of the steps up; between the least and the greatest, of each clock
};

Course course_of(const std::vector<RawTime>& raw) {
    Course course;
    double least = 0, greatest = 0;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (std::isnan(raw[i].time)) continue;
        if (i == 0 || raw[i].is_first || std::isnan(raw[i - 1].time)) {
            course.range += greatest - least;
            least = greatest = raw[i].time;
            continue;
        }
        const double step = raw[i].time - raw[i - 1].time;
        ++course.steps;
        course.back += !(step > 0);
        course.risen += std::max(step, 0.0);
        least = std::min(least, raw[i].time);
        greatest = std::max(greatest, raw[i].time);
    }
    course.range += greatest - least;
    return course;
}

// A clock goes on from row to row, but for a few; frames rise and fall within their range.
bool is_clock(const std::vector<RawTime>& raw, ColumnMeaning::Sense sense) {
    const Course course = course_of(raw);
    const bool is_likely = sense == ColumnMeaning::Sense::likely_clock;
    const std::size_t fewest = is_likely ? 0 : 10;
    const double most_back = is_likely ? 0.5 : 0.01, least_range = 0.5;
    return course.steps >= fewest &&
           static_cast<double>(course.back) <= most_back * static_cast<double>(course.steps) &&
           course.range >= least_range * course.risen;
}

// Times become those since the row before; the first of each clock goes.
void take_differences(std::vector<RawTime>& raw) {
    std::size_t kept = 0;
    double before = 0;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const double time = std::exchange(before, raw[i].time);
        if (i == 0 || raw[i].is_first) continue;
        raw[kept] = raw[i];
        raw[kept++].time -= time;
    }
    raw.resize(kept);
}

double median_time(const std::vector<RawTime>& raw) {
    std::vector<double> times;
    for (const RawTime& row : raw) {
        if (row.time > 0) times.push_back(row.time);
    }
    return median(std::move(times));
}

// The unit in which it is between a quarter of a millisecond and a second; of no time milliseconds.
Unit likely_unit(double time) {
    constexpr double shortest_ms = 0.25, longest_ms = 1000;
    if (time > 0 && time < shortest_ms) return Unit::s;
    if (!(time > longest_ms)) return Unit::ms;
    return time <= 1000 * longest_ms ? Unit::us : Unit::ns;
}

}  // namespace

std::optional<Unit> unit_named(std::string_view name) {
    for (const auto& [known, unit] : unit_names) {
        if (same_name(name, known)) return unit;
    }
    return std::nullopt;
}

std::string_view name_of(Unit unit) {
    for (const auto& [name, known] : unit_names) {
        if (known == unit) return name;
    }
    return {};
}

double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double in_milliseconds(double time, Unit unit) {
    constexpr double ms_per_s = 1000;
    switch (unit) {
        case Unit::ns:
            return time / 1e6;
        case Unit::us:
            return time / 1000;
        case Unit::ms:
            return time;
        case Unit::s:
            return time * ms_per_s;
        case Unit::fps:
            return time > 0 ? ms_per_s / time : std::nan("");
    }
    return time;
}

void take_raw_times(StreamFrames& stream, ColumnMeaning meaning) {
    using Sense = ColumnMeaning::Sense;
    const bool may_be_clock = meaning.sense != Sense::frames && meaning.unit != Unit::fps;
    const bool is_of_clock = may_be_clock && is_clock(stream.raw, meaning.sense);
    if (is_of_clock != (meaning.sense == Sense::likely_clock)) {
        stream.notes.push_back(is_of_clock ? "times that go on from row to row: taken for a clock, frames are the steps"
                                           : "times that stand or run back: taken for frames, not for a clock");
    }
    if (is_of_clock) take_differences(stream.raw);
    if (!meaning.unit) {
        meaning.unit = likely_unit(median_time(stream.raw));
        stream.notes.push_back("no unit told: taken for " + std::string(name_of(*meaning.unit)) +
                               ", as the median is then a frame's");
    }
    stream.frames.reserve(stream.raw.size());
    for (const RawTime& row : stream.raw) {
        const FrameRecord told{in_milliseconds(row.time, *meaning.unit)};
        stream.frames.push_back(usable_frame(told, stream, row.line));
    }
    stream.raw = {};
}

}  // namespace sfsm
