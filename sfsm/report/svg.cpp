#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>

#include "sfsm/report/markup.h"
#include "sfsm/report/plot.h"
#include "sfsm/report/report.h"

namespace sfsm {
namespace {

using namespace report;

// [px]
constexpr double width = 960;
constexpr double left = 64, right = 936;
constexpr double strip_height = 12, strip_gap = 3;
constexpr int columns = static_cast<int>(right - left);

// After Okabe and Ito, darkened where a line on white needs it; page/base.css has the same.
constexpr std::array<const char*, 8> run_colours = {"#0072b2", "#d55e00", "#00805a", "#a8508a",
                                                    "#8f6400", "#4a5361", "#7a4b1e", "#5d4fb3"};
constexpr std::array<const char*, 3> state_colours = {"#dce2e9", "#a9b5c7", "#7486a0"};
constexpr std::array<const char*, 3> state_names = {"original", "slowed", "points"};
constexpr const char* ink = "#1c2127";
constexpr const char* faint_ink = "#56606c";
constexpr const char* grid = "#e4e7eb";
constexpr const char* band = "#dde3ec";

const char* colour_of(std::size_t run) {
    return run_colours[run % run_colours.size()];
}

std::string text(double x, double y, const std::string& attributes, const std::string& content) {
    return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" " + attributes + ">" + escaped(content) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour) {
    return "<path d=\"M" + pixels(x1) + " " + pixels(y1) + "L" + pixels(x2) + " " + pixels(y2) + "\" stroke=\"" +
           colour + "\"/>\n";
}

std::string rectangle(double x, double y, double w, double h, const std::string& fill) {
    return "<rect x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" width=\"" + pixels(w) + "\" height=\"" + pixels(h) +
           "\" fill=\"" + fill + "\"/>\n";
}

std::string filled(std::string colour) {
    return "fill=\"" + std::move(colour) + "\"";
}

std::string fill_of(State state) {
    constexpr std::array<const char*, 3> fills = {state_colours[0], "url(#state-slowed)", state_colours[2]};
    return fills[static_cast<std::size_t>(state)];
}

// One field of a run's frames; D only where it means something.
std::vector<float> series(const ReportRun& run, float ReportFrame::*field) {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> values;
    values.reserve(run.frames.size());
    for (const ReportFrame& frame : run.frames) {
        const bool means_nothing = field == &ReportFrame::motion_distance && frame.state == State::original;
        values.push_back(means_nothing ? none : frame.*field);
    }
    return values;
}

// What all charts over time share.
struct TimeAxis {
    std::int64_t frames = 0;  // of the longest run
    Axis axis;
};

TimeAxis time_axis(const Report& report) {
    TimeAxis time{1, {}};  // a picture of no frames has an axis too
    for (const ReportRun& run : report.runs) {
        time.frames = std::max(time.frames, static_cast<std::int64_t>(run.frames.size()));
    }
    time.axis = {-0.5, static_cast<double>(time.frames) - 0.5, left, right};
    return time;
}

// The thinned values, as many columns as their frames have of the axis.
std::vector<Bucket> thin_over(const TimeAxis& time, const std::vector<float>& values) {
    const double share = static_cast<double>(values.size()) / static_cast<double>(time.frames);
    return thin(values, std::max(1, static_cast<int>(std::ceil(columns * share))));
}

// From bucket to bucket, each from the end that is nearer to where the last one ended. `steps`: values hold for whole
// frames. One that stands alone becomes a short dash, or nobody would see it.
std::string curve(const TimeAxis& time, const Axis& y, const std::vector<float>& values, bool steps) {
    std::string path;
    bool is_drawing = false;
    double last = 0;
    const std::vector<Bucket> buckets = thin_over(time, values);
    for (std::size_t i = 0; i < buckets.size(); ++i) {
        const Bucket& bucket = buckets[i];
        if (bucket.is_empty()) {
            is_drawing = false;
            continue;
        }
        const bool is_alone = !is_drawing && (i + 1 == buckets.size() || buckets[i + 1].is_empty());
        double near = y(bucket.low), far = y(bucket.high);
        if (is_drawing && std::abs(far - last) < std::abs(near - last)) std::swap(near, far);
        const double begin = static_cast<double>(bucket.begin) - 0.5, end = static_cast<double>(bucket.end) - 0.5;
        const double x = time.axis(steps ? begin : (begin + end) / 2);
        path += (is_drawing ? "L" : "M") + pixels(x) + " " + pixels(near);
        if (far != near || !is_drawing) path += "V" + pixels(far);
        if (steps) path += "H" + pixels(time.axis(end));
        if (!steps && is_alone) path += "h-3h6";
        is_drawing = true;
        last = far;
    }
    return path;
}

std::string stroke(const std::string& path, const std::string& colour, const std::string& attributes = "") {
    if (path.empty()) return "";
    return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-linejoin=\"round\" " +
           "stroke-linecap=\"round\" " + attributes + "/>\n";
}

// The line of a title over a chart, the grid, and the labels of the y-axis.
std::string chart_frame(const std::string& title, const Axis& y, int most_ticks) {
    std::string out = text(left, y.end - 10, filled(ink) + " font-weight=\"600\"", title);
    for (const double tick : ticks(y, most_ticks)) {
        out += line(left, y(tick), right, y(tick), grid);
        out += text(left - 8, y(tick) + 4, filled(faint_ink) + " text-anchor=\"end\"", tick_text(tick));
    }
    return out;
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

// Small triangles at the top where a curve goes on beyond it.
std::string carets(const TimeAxis& time, const Axis& y, const std::vector<float>& values, const std::string& colour) {
    constexpr double apart = 5;
    std::string path;
    double last = -apart;
    for (const Bucket& bucket : thin_over(time, values)) {
        const double x = time.axis((static_cast<double>(bucket.begin + bucket.end) - 1) / 2);
        if (bucket.is_empty() || bucket.high <= y.high || x - last < apart) continue;
        path += "M" + pixels(x - 3.5) + " " + pixels(y.end) + "h7l-3.5 -6z";
        last = x;
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"" + colour + "\"/>\n";
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
    const std::int64_t most = std::max<std::int64_t>(1, (time.frames + columns - 1) / columns);
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

// Runs, in as many lines as they need, and states. Returns the last line's place.
double draw_legend(std::string& out, const Report& report, double y) {
    constexpr double letter = 7.2, swatch = 26, apart = 22;  // as wide as most letters are
    constexpr double states = 300;
    constexpr std::size_t most = 40;
    double x = right - states;
    for (std::size_t state = 0; state < state_names.size(); ++state, x += states / 3) {
        out += rectangle(x, y - 10, 20, strip_height, fill_of(static_cast<State>(state))) +
               text(x + swatch, y, filled(faint_ink), state_names[state]);
    }
    x = left;
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        const std::string name = shortened(report.runs[i].name, most);
        const double needed = swatch + letter * static_cast<double>(name.size()) + apart;
        if (x > left && x + needed > right - states) {
            x = left;
            y += 20;
        }
        out += "<path d=\"M" + pixels(x) + " " + pixels(y - 4) + "h18\" stroke=\"" + colour_of(i) +
               "\" stroke-width=\"3\"/>\n" + text(x + swatch, y, filled(ink), name);
        x += needed;
    }
    return y;
}

// Measured over predicted over target, and what state each run was in below. Returns where it ends.
double draw_times(std::string& out, const Report& report, const TimeAxis& time, const Axis& y) {
    // Thinned, dashes only make what is measured hard to see.
    const bool shows_predicted = time.frames <= columns;
    out += chart_frame(
        std::string("Frame time [ms], target \u00B15 %") + (shows_predicted ? "; dashed: predicted" : ""), y, 6);
    const std::vector<float> targets = series(report.runs[0], &ReportFrame::target_ms);
    out += target_band(time, y, targets);
    const bool is_thinned = time.frames > 2 * columns;  // curves are areas: they would hide the target
    const std::string target = stroke(curve(time, y, targets, true), is_thinned ? ink : faint_ink);
    if (!is_thinned) out += target;
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        const std::vector<float> times = series(report.runs[i], &ReportFrame::frame_ms);
        out += stroke(curve(time, y, times, false), colour_of(i), "stroke-width=\"1.25\" stroke-opacity=\"0.9\"");
        out += carets(time, y, times, colour_of(i));
        if (!shows_predicted) continue;
        const std::vector<float> predicted = series(report.runs[i], &ReportFrame::predicted_ms);
        out +=
            stroke(curve(time, y, predicted, false), colour_of(i), "stroke-dasharray=\"3 3\" stroke-opacity=\"0.7\"");
    }
    if (is_thinned) out += target;
    double bottom = y.begin + 8;
    for (std::size_t i = 0; i < report.runs.size(); ++i, bottom += strip_height + strip_gap) {
        out += rectangle(left - 10, bottom, 6, strip_height, colour_of(i)) + state_strip(time, report.runs[i], bottom);
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
        all.push_back(series(run, field));
        for (const float value : all.back()) {
            if (std::isfinite(value)) most = std::max<double>(most, value);
        }
    }
    const Axis y{0, most > 0 ? 1.08 * most : 1, top + height, top};
    out += chart_frame(title, y, 3);
    for (std::size_t i = 0; i < all.size(); ++i) {
        out += stroke(curve(time, y, all[i], true), colour_of(i), "stroke-width=\"1.5\"");
    }
    out += frame_labels(time, y.begin + 16);
    return y.begin + 16;
}

// Nearest ranks of the finite times; NaN of none.
std::vector<double> percentiles(const ReportRun& run, std::span<const double> shares) {
    std::vector<double> sorted;
    for (const ReportFrame& frame : run.frames) {
        if (std::isfinite(frame.frame_ms)) sorted.push_back(frame.frame_ms);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> values;
    for (const double share : shares) {
        const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
        values.push_back(sorted.empty() ? std::numeric_limits<double>::quiet_NaN()
                                        : sorted[std::max<std::size_t>(rank, 1) - 1]);
    }
    return values;
}

double draw_percentiles(std::string& out, const Report& report, double top) {
    constexpr std::array<double, 7> shares = {0.01, 0.5, 0.9, 0.95, 0.99, 0.999, 1};
    constexpr std::array<const char*, 7> names = {"1 %", "50 %", "90 %", "95 %", "99 %", "99.9 %", "all"};
    constexpr double column = 96, row = 20;
    out += text(left, top, filled(ink) + " font-weight=\"600\"", "Frame times that so many frames do not exceed [ms]");
    double y = top + row + 4;
    for (std::size_t k = 0; k < names.size(); ++k) {
        out += text(right - column * static_cast<double>(names.size() - 1 - k), y,
                    filled(faint_ink) + " text-anchor=\"end\"", names[k]);
    }
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        out += line(left, y + 7, right, y + 7, grid);
        y += row + 4;
        out += rectangle(left, y - 10, 6, strip_height, colour_of(i));
        out += text(left + 14, y, filled(ink), shortened(report.runs[i].name, 30));
        const std::vector<double> values = percentiles(report.runs[i], shares);
        for (std::size_t k = 0; k < values.size(); ++k) {
            out += text(right - column * static_cast<double>(names.size() - 1 - k), y,
                        filled(ink) + " text-anchor=\"end\"", figure(values[k], 1));
        }
    }
    return y;
}

constexpr const char* patterns = R"(<defs>
<pattern id="state-slowed" width="6" height="6" patternUnits="userSpaceOnUse">
<path d="M0 0h6v6h-6z" fill="#a9b5c7"/><path d="M-1 7L7 -1M-1 1L1 -1M5 7L7 5" stroke="#f4f6f8" stroke-width="1.2"/>
</pattern>
</defs>
)";

std::vector<float> all_of(const Report& report, float ReportFrame::*field) {
    std::vector<float> all;
    for (const ReportRun& run : report.runs) {
        for (const ReportFrame& frame : run.frames) all.push_back(frame.*field);
    }
    return all;
}

}  // namespace

void write_report_svg(std::ostream& out, const Report& report) {
    const TimeAxis time = time_axis(report);
    const double top = fitted_top(all_of(report, &ReportFrame::frame_ms), all_of(report, &ReportFrame::target_ms));
    std::string body =
        text(left, 38, filled(ink) + " font-size=\"19\" font-weight=\"600\"", shortened(report.title, 80));
    double y = draw_legend(body, report, 68) + 48;
    y = draw_times(body, report, time, {0, top, y + 240, y});
    y = draw_detail(body, report, time, "D [m]: beyond it people move at a lower rate", &ReportFrame::motion_distance,
                    y + 44);
    y = draw_detail(body, report, time, "S [px]: size of the points that people are drawn as", &ReportFrame::splat_size,
                    y + 44);
    body += text(right, y + 18, filled(faint_ink) + " text-anchor=\"end\"", "frame");
    y = draw_percentiles(body, report, y + 48) + 28;
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << pixels(width) << ' ' << pixels(y)
        << "\" role=\"img\" aria-label=\"" << escaped(report.title) << "\" font-family=\"system-ui, sans-serif\" "
        << "font-size=\"12.5\" fill=\"none\">\n"
        << patterns << "<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#fff\"/>\n"
        << body << "</svg>\n";
}

}  // namespace sfsm
