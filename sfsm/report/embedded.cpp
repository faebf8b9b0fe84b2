#include "sfsm/report/embedded.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <ostream>

#include "sfsm/number_text.h"
#include "sfsm/report/markup.h"
#include "sfsm/report/numbers.h"
#include "sfsm/report/plot.h"
#include "sfsm/report/series.h"

namespace sfsm::report {
namespace {

constexpr std::int64_t most_exact = 20'000;             // frames
constexpr int stretches = 4096;                         // of more
constexpr std::int64_t most_fine = 200'000;             // frames whose times are kept to a microsecond
constexpr double fine_quantum = 0.001, quantum = 0.01;  // [ms]

void append_bytes(std::string& bytes, std::unsigned_integral auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

void append_varint(std::string& bytes, std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
    bytes += static_cast<char>(value);
}

// As numbers of equal width that compare by their bits: NaN is not equal to itself.
std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}
std::uint8_t bits(State state) {
    return static_cast<std::uint8_t>(state);
}

// Targets and states hardly ever change: counting equal neighbours makes them vanish.
template <class Value>
void write_values(std::ostream& out, const std::vector<Value>& series) {
    std::string all, values, counts;
    for (std::size_t i = 0; i < series.size();) {
        const auto value = bits(series[i]);
        std::uint32_t count = 0;
        for (; i < series.size() && bits(series[i]) == value; ++i, ++count) append_bytes(all, value);
        append_bytes(values, value);
        append_bytes(counts, count);
    }
    const bool is_shorter = values.size() + counts.size() < all.size();
    out << "{\"values\": \"" << base64(is_shorter ? values : all) << "\", \"counts\": \""
        << (is_shorter ? base64(counts) : "") << "\"}";
}

// Times always change, but not by much.
void write_packed(std::ostream& out, const std::vector<float>& series, double step) {
    std::string packed;
    std::int64_t last = 0;
    for (const float value : series) {
        if (!std::isfinite(value)) {
            append_varint(packed, 0);
            continue;
        }
        const std::int64_t steps = std::llround(static_cast<double>(value) / step), change = steps - last;
        append_varint(packed, 1 + (static_cast<std::uint64_t>(change) << 1 ^ static_cast<std::uint64_t>(change >> 63)));
        last = steps;
    }
    out << "{\"quantum\": " << number_text(step) << ", \"packed\": \"" << base64(packed) << "\"}";
}

// Frames in a stretch.
std::int64_t width_of(std::size_t frames) {
    const auto count = static_cast<std::int64_t>(frames);
    return count <= most_exact ? 1 : (count + stretches - 1) / stretches;
}

// Least or most of each stretch; NaN where none is known.
std::vector<float> ends_of(const std::vector<float>& series, float Bucket::*end) {
    const auto width = static_cast<std::size_t>(width_of(series.size()));
    std::vector<float> ends;
    for (std::size_t begin = 0; begin < series.size(); begin += width) {
        const Bucket stretch = bucket(series, static_cast<std::int64_t>(begin),
                                      static_cast<std::int64_t>(std::min(begin + width, series.size())));
        ends.push_back(stretch.is_empty() ? std::nanf("") : stretch.*end);
    }
    return ends;
}

// `write(out, values)` writes one row of numbers.
template <class Write>
void write_thinned(std::ostream& out, const char* name, const std::vector<float>& series, const Write& write) {
    const std::int64_t width = width_of(series.size());
    out << "\n\"" << name << "\": {\"width\": " << width << ", \"low\": ";
    write(out, width == 1 ? series : ends_of(series, &Bucket::low));
    if (width > 1) write(out << ", \"high\": ", ends_of(series, &Bucket::high));
    out << '}';
}

template <class Value>
void write_told(std::ostream& out, const char* name, std::span<const FrameRecord> frames, Value FrameRecord::*field) {
    const std::vector<float> series = series_of(frames, field);
    if (!is_told(series)) return;
    const double step = width_of(series.size()) == 1 ? fine_quantum : quantum;
    write_thinned(out << ',', name, series,
                  [&](std::ostream& to, const std::vector<float>& values) { write_packed(to, values, step); });
}

void write_recording(std::ostream& out, const ReportedRecording& recording) {
    const std::span<const FrameRecord> frames = recording.frames;
    out << "{\"name\": " << json_string(recording.name) << ", \"frames\": " << std::to_string(frames.size())
        << ", \"seconds\": " << number_text(recording.figures.seconds) << ", \"series\": {";
    out << "\n\"frame_ms\": {\"width\": 1, \"low\": ";
    const bool is_fine = std::ssize(frames) <= most_fine;
    write_packed(out, series_of(frames, &FrameRecord::frame_ms), is_fine ? fine_quantum : quantum);
    out << '}';
    write_told(out, "display_ms", frames, &FrameRecord::display_ms);
    write_told(out, "animation_error_ms", frames, &FrameRecord::animation_error_ms);
    write_told(out, "cpu_ms", frames, &FrameRecord::cpu_ms);
    write_told(out, "gpu_ms", frames, &FrameRecord::gpu_ms);
    std::string places, causes;
    for (const Stutter& stutter : recording.stutters) {
        append_bytes(places, static_cast<std::uint32_t>(stutter.frame));
        append_bytes(causes, static_cast<std::uint8_t>(stutter.cause));
    }
    out << "},\n\"stutters\": {\"frames\": \"" << base64(places) << "\", \"causes\": \"" << base64(causes) << "\"}}";
}

// Of each stretch the share of frames in a state, in 1/255.
std::string shares_of(const std::vector<ReportFrame>& frames, State state) {
    const auto width = static_cast<std::size_t>(width_of(frames.size()));
    std::string shares;
    for (std::size_t begin = 0; begin < frames.size(); begin += width) {
        const std::size_t end = std::min(begin + width, frames.size());
        const auto count = std::count_if(frames.begin() + static_cast<std::ptrdiff_t>(begin),
                                         frames.begin() + static_cast<std::ptrdiff_t>(end),
                                         [&](const ReportFrame& frame) { return frame.state == state; });
        shares += static_cast<char>(std::lround(255.0 * static_cast<double>(count) / static_cast<double>(end - begin)));
    }
    return shares;
}

void write_states(std::ostream& out, const std::vector<ReportFrame>& frames) {
    const std::int64_t width = width_of(frames.size());
    out << ",\n\"state\": {\"width\": " << width;
    if (width == 1) {
        std::vector<State> states;
        for (const ReportFrame& frame : frames) states.push_back(frame.state);
        write_values(out << ", \"low\": ", states);
    } else {
        out << ", \"slowed\": \"" << base64(shares_of(frames, State::slowed)) << "\", \"points\": \""
            << base64(shares_of(frames, State::points)) << '"';
    }
    out << '}';
}

void write_run_series(std::ostream& out, const char* name, const std::vector<float>& series) {
    write_thinned(out, name, series, [](std::ostream& to, const auto& values) { write_values(to, values); });
}

// Times decide how a run's spread is drawn, so more of them are kept than of all else.
void write_times(std::ostream& out, const std::vector<float>& times) {
    const auto frames = static_cast<std::int64_t>(times.size());
    if (frames <= most_exact || frames > most_fine) return write_run_series(out, "frame_ms", times);
    out << "\n\"frame_ms\": {\"width\": 1, \"low\": ";
    write_packed(out, times, fine_quantum);
    out << '}';
}

void write_run(std::ostream& out, const ReportRun& run) {
    out << "{\"name\": " << json_string(run.name) << ", \"frames\": " << std::to_string(run.frames.size())
        << ", \"series\": {";
    write_run_series(out, "target_ms", series_of(run.frames, &ReportFrame::target_ms));
    write_times(out << ',', series_of(run.frames, &ReportFrame::frame_ms));
    write_run_series(out << ',', "predicted_ms", series_of(run.frames, &ReportFrame::predicted_ms));
    write_run_series(out << ',', "splat_size", series_of(run.frames, &ReportFrame::splat_size));
    write_run_series(out << ',', "motion_distance", series_of(run.frames, &ReportFrame::motion_distance));
    write_states(out, run.frames);
    const bool is_by_rate = std::ranges::any_of(run.frames, [](const ReportFrame& frame) { return frame.rate > 0; });
    if (is_by_rate) write_run_series(out << ',', "rate", series_of(run.frames, &ReportFrame::rate));
    out << "}}";
}

}  // namespace

void write_embedded(std::ostream& out, const Report& report) {
    const double target = common_target(report.recordings);
    out << "{\"target_ms\": " << (std::isfinite(target) ? number_text(target) : "null") << ",\n\"causes\": [";
    for (const Cause cause : every_cause)
        out << (cause == every_cause.front() ? "" : ", ") << json_string(name_of(cause));
    out << "],\n\"recordings\": [";
    for (const ReportedRecording& recording : report.recordings) {
        write_recording(out << (&recording == &report.recordings.front() ? "\n" : ",\n"), recording);
    }
    out << "],\n\"runs\": [";
    for (const ReportRun& run : report.runs) {
        write_run(out << (&run == &report.runs.front() ? "\n" : ",\n"), run);
    }
    out << "]}\n";
}

}  // namespace sfsm::report
