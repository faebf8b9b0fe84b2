#include "sfsm/report/embedded.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <ostream>

#include "sfsm/report/markup.h"

namespace sfsm::report {
namespace {

void append_bytes(std::string& bytes, std::unsigned_integral auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

// As numbers of equal width that compare by their bits: NaN is not equal to itself.
std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}
std::uint8_t bits(State state) {
    return static_cast<std::uint8_t>(state);
}

// Targets and states hardly ever change: counting equal neighbours makes them vanish. Times always do.
template <class Field>
void write_series(std::ostream& out, const char* name, const std::vector<ReportFrame>& frames,
                  Field ReportFrame::*field) {
    std::string all, values, counts;
    for (std::size_t i = 0; i < frames.size();) {
        const auto value = bits(frames[i].*field);
        std::uint32_t count = 0;
        for (; i < frames.size() && bits(frames[i].*field) == value; ++i, ++count) append_bytes(all, value);
        append_bytes(values, value);
        append_bytes(counts, count);
    }
    const bool is_shorter = values.size() + counts.size() < all.size();
    out << "\n\"" << name << "\": {\"values\": \"" << base64(is_shorter ? values : all) << "\", \"counts\": \""
        << (is_shorter ? base64(counts) : "") << "\"}";
}

void write_run(std::ostream& out, const ReportRun& run) {
    out << "{\"name\": " << json_string(run.name) << ", \"frames\": " << std::to_string(run.frames.size())
        << ", \"series\": {";
    write_series(out, "target_ms", run.frames, &ReportFrame::target_ms);
    write_series(out << ',', "frame_ms", run.frames, &ReportFrame::frame_ms);
    write_series(out << ',', "predicted_ms", run.frames, &ReportFrame::predicted_ms);
    write_series(out << ',', "motion_distance", run.frames, &ReportFrame::motion_distance);
    write_series(out << ',', "splat_size", run.frames, &ReportFrame::splat_size);
    write_series(out << ',', "state", run.frames, &ReportFrame::state);
    const bool is_by_rate = std::ranges::any_of(run.frames, [](const ReportFrame& frame) { return frame.rate > 0; });
    if (is_by_rate) write_series(out << ',', "rate", run.frames, &ReportFrame::rate);
    out << "}}";
}

}  // namespace

void write_embedded(std::ostream& out, const Report& report) {
    out << "{\"runs\": [";
    for (const ReportRun& run : report.runs) {
        if (&run != &report.runs.front()) out << ',';
        write_run(out << '\n', run);
    }
    out << "]}\n";
}

}  // namespace sfsm::report
