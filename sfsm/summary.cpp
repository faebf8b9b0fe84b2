#include "sfsm/summary.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "sfsm/number_text.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

bool is_measured(const FrameTime& frame) {
    return std::isfinite(frame.frame_ms) && std::isfinite(frame.target_ms) && frame.target_ms > 0;
}

// The smallest time that at least `percent` of the times do not exceed. Moves them about.
double nearest_rank(std::vector<double>& times, std::size_t percent) {
    const std::size_t rank = (times.size() * percent + 99) / 100;
    const auto place = times.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(times.begin(), place, times.end());
    return *place;
}

// Sums over frames; finish() makes shares of them.
void add_frame(Summary& sum, double ms, double target) {
    const double miss = std::abs(ms - target);
    sum.mean_ms += ms;
    sum.control_rate += std::max(0.0, 1 - miss / target);
    sum.within_5pct += miss <= 0.05 * target ? 1 : 0;
    sum.within_10pct += miss <= 0.10 * target ? 1 : 0;
    sum.over_5pct += ms - target > 0.05 * target ? 1 : 0;
}

void append_string(std::string& out, std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    out += '"';
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20) {
            out.append("\\u00").append({hex[code >> 4], hex[code & 15]});
        } else {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
    }
    out += '"';
}

// Where there are none the largest stays NaN: std::fmax leaves it out.
void add_promises(Summary& summary, std::span<const TraceRow> rows) {
    double flip = 0;
    std::int64_t promised = 0;
    for (const TraceRow& row : rows) {
        summary.max_motion_error_px = std::fmax(summary.max_motion_error_px, row.max_motion_error_px);
        summary.max_splat_error_px = std::fmax(summary.max_splat_error_px, row.max_splat_error_px);
        summary.worst_predicted_flip = std::fmax(summary.worst_predicted_flip, row.predicted_flip);
        if (row.predicted_ms > 1.05 * row.target_ms) ++summary.out_of_reach_frames;
        if (std::isnan(row.predicted_flip)) continue;
        flip += row.predicted_flip;
        ++promised;
    }
    if (promised > 0) summary.predicted_flip = flip / static_cast<double>(promised);
}

using Settings = std::map<std::string, std::string>;

// JSON has no infinity, which the mean of huge times may reach.
void append_figure(std::string& out, const char* name, double value) {
    append_string(out += "  ", name);
    out += ": " + (std::isfinite(value) ? number_text(value) : "null") + ",\n";
}

// Numbers stay as they are written: a seed may be larger than any number type of ours.
bool is_whole_number(std::string_view text) {
    const bool digits =
        !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    return digits && (text.size() == 1 || text[0] != '0');
}

void append_setting(std::string& out, const Settings& settings, const char* key, bool is_number) {
    const auto found = settings.find(key);
    append_string(out += "  ", key);
    out += ": ";
    if (found == settings.end()) {
        out += "null";
    } else if (is_number && is_whole_number(found->second)) {
        out += found->second;
    } else {
        append_string(out, found->second);
    }
    out += ",\n";
}

}  // namespace

Summary summarize(std::span<const TraceRow> rows) {
    std::vector<FrameTime> frames;
    frames.reserve(rows.size());
    for (const TraceRow& row : rows) frames.push_back({row.target_ms, row.frame_ms, row.decision.state});
    Summary summary = summarize_times(frames);
    add_promises(summary, rows);
    return summary;
}

Summary summarize_times(std::span<const FrameTime> frames) {
    Summing summing;
    summing.expect(frames.size());
    for (const FrameTime& frame : frames) summing.add(frame);
    return summing.finish();
}

void Summing::add(const FrameTime& frame) {
    if (!is_measured(frame)) return;
    times_.push_back(frame.frame_ms);
    add_frame(sum_, frame.frame_ms, frame.target_ms);
    sum_.target_ms = frame.target_ms;
    ++sum_.state_frames[static_cast<std::size_t>(frame.state)];
}

Summary Summing::finish() {
    if (times_.empty()) return sum_;
    const auto measured = static_cast<double>(times_.size());
    for (double* mean : {&sum_.mean_ms, &sum_.control_rate, &sum_.within_5pct, &sum_.within_10pct, &sum_.over_5pct}) {
        *mean /= measured;
    }
    sum_.frames = static_cast<std::int64_t>(times_.size());
    sum_.p50_ms = nearest_rank(times_, 50);
    sum_.p99_ms = nearest_rank(times_, 99);
    return sum_;
}

std::string summary_json(const Summary& summary, const Settings& settings, std::span<const std::string> warnings) {
    std::string out = "{\n";
    append_setting(out, settings, "people", true);
    append_number(out += "  \"frames\": ", summary.frames);
    out += ",\n";
    append_setting(out, settings, "law", false);
    append_setting(out, settings, "seed", true);
    append_setting(out, settings, "device", false);
    const std::pair<const char*, double> figures[] = {
        {"target_ms", summary.target_ms},
        {"mean_ms", summary.mean_ms},
        {"p50_ms", summary.p50_ms},
        {"p99_ms", summary.p99_ms},
        {"control_rate", summary.control_rate},
        {"within_5pct", summary.within_5pct},
        {"within_10pct", summary.within_10pct},
        {"over_5pct", summary.over_5pct},
        {"max_motion_error_px", summary.max_motion_error_px},
        {"max_splat_error_px", summary.max_splat_error_px},
        {"predicted_flip", summary.predicted_flip},
        {"worst_predicted_flip", summary.worst_predicted_flip},
    };
    for (const auto& [name, value] : figures) append_figure(out, name, value);
    out += "  \"state_frames\": [";
    append_number(out, summary.state_frames[0]);
    append_number(out += ", ", summary.state_frames[1]);
    append_number(out += ", ", summary.state_frames[2]);
    append_number(out += "],\n  \"out_of_reach_frames\": ", summary.out_of_reach_frames);
    out += ",\n  \"warnings\": [";
    for (const std::string& warning : warnings) append_string(out += &warning == warnings.data() ? "" : ", ", warning);
    return out += "]\n}\n";
}

}  // namespace sfsm
