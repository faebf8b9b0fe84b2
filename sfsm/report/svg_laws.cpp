#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sfsm/report/markup.h"
#include "sfsm/report/pictures.h"
#include "sfsm/report/series.h"
#include "sfsm/report/svg_parts.h"

namespace sfsm::report {
namespace {

constexpr double strip_height = 12, strip_gap = 3;  // [px]
constexpr std::array<const char*, 3> state_colours = {"#dce2e9", "#a9b5c7", "#7486a0"};
constexpr std::array<const char*, 3> state_names = {"original", "slowed", "points"};
constexpr const char* band = "#dde3ec";

std::string fill_of(State state) {
    constexpr std::array<const char*, 3> fills = {state_colours[0], "url(#state-slowed)", state_colours[2]};
    return fills[static_cast<std::size_t>(state)];
}

// What all charts over time share.
struct TimeAxis {
    std::int64_t frames = 0;  // of the longest run
    Axis axis;

    Begins begins() const {
        return [x = axis](std::int64_t frame) { return x(static_cast<double>(frame) - 0.5); };
    }
};

TimeAxis time_axis(const Report& report) {
    TimeAxis time{1, {}};  // a picture of no frames has an axis too
    for (const ReportRun& run : report.runs) {
        time.frames = std::max(time.frames, static_cast<std::int64_t>(run.frames.size()));
    }
    time.axis = {-0.5, static_cast<double>(time.frames) - 0.5, chart_left, chart_right};
    return time;
}

// The thinned values, as many chart_columns as their frames have of the axis.
std::vector<Bucket> thin_over(const TimeAxis& time, const std::vector<float>& values) {
    const double share = static_cast<double>(values.size()) / static_cast<double>(time.frames);
    return thin(values, std::max(1, static_cast<int>(std::ceil(chart_columns * share))));
}

std::string frame_labels(const TimeAxis& time, double y) {
    std::string out;
    constexpr int most = 10;
    for (const double tick : ticks(time.axis, most)) {
        if (tick != std::floor(tick)) continue;
        out += text(time.axis(tick), y, filled(faint_ink) + " text-anchor=\"middle\"", tick_text(tick));
    }
    return out;
}

// 5 % on either side of the run's target.
std::string target_band(const TimeAxis& time, const Axis& y, const std::vector<float>& targets) {
    std::string out;
    const std::vector<Bucket> buckets = thin_over(time, targets);
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < buckets.size(); begin = end) {
        const Bucket& first = buckets[begin];
        for (end = begin + 1;
             end < buckets.size() && buckets[end].low == first.low && buckets[end].high == first.high;) {
            ++end;
        }
        if (first.is_empty()) continue;
        const double x = time.axis(static_cast<double>(first.begin) - 0.5);
        const double w = time.axis(static_cast<double>(buckets[end - 1].end) - 0.5) - x;
        out += rectangle(x, y(1.05 * first.high), w, y(0.95 * first.low) - y(1.05 * first.high), band);
    }
    return out;
}

// How long a run was in each state: a column that holds several is shared between them.
std::string state_strip(const TimeAxis& time, const ReportRun& run, double top) {
    const auto frames = static_cast<std::int64_t>(run.frames.size());
    std::string out;
    const auto flush = [&](std::int64_t begin, std::int64_t end, const std::array<std::int64_t, 3>& counts) {
        const double x = time.axis(static_cast<double>(begin) - 0.5);
        const double w = time.axis(static_cast<double>(end) - 0.5) - x;
        double y = top;
        for (std::size_t state = 0; state < counts.size(); ++state) {
            const double h = strip_height * static_cast<double>(counts[state]) / static_cast<double>(end - begin);
            if (h > 0) out += rectangle(x, y, w, h, fill_of(static_cast<State>(state)));
            y += h;
        }
    };
    const std::int64_t most = std::max<std::int64_t>(1, (time.frames + chart_columns - 1) / chart_columns);
    for (std::int64_t begin = 0, end = 0; begin < frames; begin = end) {
        std::array<std::int64_t, 3> counts{};
        const State first = run.frames[begin].state;
        for (end = begin; end < frames && run.frames[end].state == first; ++end)
            ++counts[static_cast<std::size_t>(first)];
        for (; end < std::min(frames, begin + most); ++end) ++counts[static_cast<std::size_t>(run.frames[end].state)];
        flush(begin, end, counts);
    }
    return out;
}

// Runs on the left, states on the right. Returns the last line's place.
double draw_keys(std::string& out, const Report& report, double y) {
    constexpr double states = 300, swatch = 26;
    double x = chart_right - states;
    for (std::size_t state = 0; state < state_names.size(); ++state, x += states / 3) {
        out += rectangle(x, y - 10, 20, strip_height, fill_of(static_cast<State>(state))) +
               text(x + swatch, y, filled(faint_ink), state_names[state]);
    }
    return draw_legend(out, names_of(report.runs), y, chart_right - states);
}

// Measured over predicted over target, and what state each run was in below. Returns where it ends.
double draw_times(std::string& out, const Report& report, const TimeAxis& time, const Axis& y) {
    // Thinned, dashes only make what is measured hard to see.
    const bool shows_predicted = time.frames <= chart_columns;
    out += chart_frame(
        std::string("Frame time [ms], target \u00B15 %") + (shows_predicted ? "; dashed: predicted" : ""), y, 6);
    const Begins begins = time.begins();
    const std::vector<float> targets = series_of(report.runs[0].frames, &ReportFrame::target_ms);
    out += target_band(time, y, targets);
    const bool is_thinned = time.frames > 2 * chart_columns;  // curves are areas: they would hide the target
    const std::string target =
        stroke(curve(thin_over(time, targets), time.begins(), y, true), is_thinned ? ink : faint_ink);
    if (!is_thinned) out += target;
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        const std::vector<float> times = series_of(report.runs[i].frames, &ReportFrame::frame_ms);
        const std::vector<Bucket> thinned = thin_over(time, times);
        out += stroke(curve(thinned, begins, y, false), colour_of(i), "stroke-width=\"1.25\" stroke-opacity=\"0.9\"");
        out += carets(thinned, begins, y, colour_of(i));
        if (!shows_predicted) continue;
        const std::vector<float> predicted = series_of(report.runs[i].frames, &ReportFrame::predicted_ms);
        out += stroke(curve(thin_over(time, predicted), begins, y, false), colour_of(i),
                      "stroke-dasharray=\"3 3\" stroke-opacity=\"0.7\"");
    }
    if (is_thinned) out += target;
    double bottom = y.begin + 8;
    for (std::size_t i = 0; i < report.runs.size(); ++i, bottom += strip_height + strip_gap) {
        out += rectangle(chart_left - 10, bottom, 6, strip_height, colour_of(i)) +
               state_strip(time, report.runs[i], bottom);
    }
    out += frame_labels(time, bottom + 14);
    return bottom + 14;
}

double draw_detail(std::string& out, const Report& report, const TimeAxis& time, const std::string& title,
                   float ReportFrame::*field, double top) {
    constexpr double height = 84;
    std::vector<std::vector<float>> all;
    double most = 0;
    for (const ReportRun& run : report.runs) {
        all.push_back(series_of(run.frames, field));
        for (const float value : all.back()) {
            if (std::isfinite(value)) most = std::max<double>(most, value);
        }
    }
    const Axis y{0, most > 0 ? 1.08 * most : 1, top + height, top};
    out += chart_frame(title, y, 3);
    for (std::size_t i = 0; i < all.size(); ++i) {
        out += stroke(curve(thin_over(time, all[i]), time.begins(), y, true), colour_of(i), "stroke-width=\"1.5\"");
    }
    out += frame_labels(time, y.begin + 16);
    return y.begin + 16;
}

std::vector<float> all_of(const Report& report, float ReportFrame::*field) {
    std::vector<float> all;
    for (const ReportRun& run : report.runs) {
        for (const ReportFrame& frame : run.frames) all.push_back(frame.*field);
    }
    return all;
}

}  // namespace

const char* const law_patterns = R"(<defs>
<pattern id="state-slowed" width="6" height="6" patternUnits="userSpaceOnUse">
<path d="M0 0h6v6h-6z" fill="#a9b5c7"/><path d="M-1 7L7 -1M-1 1L1 -1M5 7L7 5" stroke="#f4f6f8" stroke-width="1.2"/>
</pattern>
</defs>
)";

double draw_laws(std::string& out, const Report& report, double top) {
    const TimeAxis time = time_axis(report);
    const double highest = fitted_top(all_of(report, &ReportFrame::frame_ms), all_of(report, &ReportFrame::target_ms));
    double y = draw_keys(out, report, top) + 48;
    y = draw_times(out, report, time, {0, highest, y + 240, y});
    y = draw_detail(out, report, time, "D [m]: beyond it people move at a lower rate", &ReportFrame::motion_distance,
                    y + 44);
    y = draw_detail(out, report, time, "S [px]: size of the points that people are drawn as", &ReportFrame::splat_size,
                    y + 44);
    out += text(chart_right, y + 18, filled(faint_ink) + " text-anchor=\"end\"", "frame");
    std::vector<std::vector<float>> times;
    for (const ReportRun& run : report.runs) times.push_back(series_of(run.frames, &ReportFrame::frame_ms));
    return draw_percentiles(out, names_of(report.runs), times, y + 48);
}

}  // namespace sfsm::report
