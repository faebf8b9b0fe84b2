#include "sfsm/report/svg_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sfsm/report/markup.h"

namespace sfsm::report {
namespace {

// After Okabe and Ito, darkened where a line on white needs it; page/base.css has the same.
constexpr std::array<const char*, 8> run_colours = {"#0072b2", "#d55e00", "#00805a", "#a8508a",
                                                    "#8f6400", "#4a5361", "#7a4b1e", "#5d4fb3"};

constexpr double swatch = 26;  // [px]

// Nearest ranks of the finite times; NaN of none.
std::vector<double> percentiles(std::span<const float> times, std::span<const double> shares) {
    std::vector<double> sorted;
    for (const float time : times) {
        if (std::isfinite(time)) sorted.push_back(time);
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

}  // namespace

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

std::string stroke(const std::string& path, const std::string& colour, const std::string& attributes) {
    if (path.empty()) return "";
    return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-linejoin=\"round\" " +
           "stroke-linecap=\"round\" " + attributes + "/>\n";
}

std::string curve(std::span<const Bucket> buckets, const Begins& begins, const Axis& y, bool steps) {
    std::string path;
    bool is_drawing = false;
    double last = 0;
    for (std::size_t i = 0; i < buckets.size(); ++i) {
        const Bucket& bucket = buckets[i];
        if (bucket.is_empty()) {
            is_drawing = false;
            continue;
        }
        const bool is_alone = !is_drawing && (i + 1 == buckets.size() || buckets[i + 1].is_empty());
        double near = y(bucket.low), far = y(bucket.high);
        if (is_drawing && std::abs(far - last) < std::abs(near - last)) std::swap(near, far);
        const double begin = begins(bucket.begin), end = begins(bucket.end);
        const double x = steps ? begin : (begin + end) / 2;
        path += (is_drawing ? "L" : "M") + pixels(x) + " " + pixels(near);
        if (far != near || !is_drawing) path += "V" + pixels(far);
        if (steps) path += "H" + pixels(end);
        if (!steps && is_alone) path += "h-3h6";
        is_drawing = true;
        last = far;
    }
    return path;
}

std::string carets(std::span<const Bucket> buckets, const Begins& begins, const Axis& y, const std::string& colour) {
    constexpr double apart = 5;
    std::string path;
    double last = -apart;
    for (const Bucket& bucket : buckets) {
        const double x = (begins(bucket.begin) + begins(bucket.end)) / 2;
        if (bucket.is_empty() || bucket.high <= y.high || x - last < apart) continue;
        path += "M" + pixels(x - 3.5) + " " + pixels(y.end) + "h7l-3.5 -6z";
        last = x;
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"" + colour + "\"/>\n";
}

std::string chart_frame(const std::string& title, const Axis& y, int most_ticks) {
    std::string out = text(chart_left, y.end - 10, filled(ink) + " font-weight=\"600\"", title);
    for (const double tick : ticks(y, most_ticks)) {
        out += line(chart_left, y(tick), chart_right, y(tick), grid);
        out += text(chart_left - 8, y(tick) + 4, filled(faint_ink) + " text-anchor=\"end\"", tick_text(tick));
    }
    return out;
}

double draw_legend(std::string& out, std::span<const std::string> names, double y, double end) {
    constexpr double letter = 7.2, apart = 22;  // as wide as most letters are
    constexpr std::size_t most = 40;
    double x = chart_left;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = shortened(names[i], most);
        const double needed = swatch + letter * static_cast<double>(name.size()) + apart;
        if (x > chart_left && x + needed > end) {
            x = chart_left;
            y += 20;
        }
        out += "<path d=\"M" + pixels(x) + " " + pixels(y - 4) + "h18\" stroke=\"" + colour_of(i) +
               "\" stroke-width=\"3\"/>\n" + text(x + swatch, y, filled(ink), name);
        x += needed;
    }
    return y;
}

double draw_percentiles(std::string& out, std::span<const std::string> names, std::span<const std::vector<float>> times,
                        double top) {
    constexpr std::array<double, 7> shares = {0.01, 0.5, 0.9, 0.95, 0.99, 0.999, 1};
    constexpr std::array<const char*, 7> heads = {"1 %", "50 %", "90 %", "95 %", "99 %", "99.9 %", "all"};
    constexpr double column = 96, row = 20, swatch_height = 12;
    const auto place = [&](std::size_t k) { return chart_right - column * static_cast<double>(heads.size() - 1 - k); };
    out += text(chart_left, top, filled(ink) + " font-weight=\"600\"",
                "Frame times that so many frames do not exceed [ms]");
    double y = top + row + 4;
    for (std::size_t k = 0; k < heads.size(); ++k)
        out += text(place(k), y, filled(faint_ink) + " text-anchor=\"end\"", heads[k]);
    for (std::size_t i = 0; i < names.size(); ++i) {
        out += line(chart_left, y + 7, chart_right, y + 7, grid);
        y += row + 4;
        out += rectangle(chart_left, y - 10, 6, swatch_height, colour_of(i));
        out += text(chart_left + 14, y, filled(ink), shortened(names[i], 30));
        const std::vector<double> values = percentiles(times[i], shares);
        for (std::size_t k = 0; k < values.size(); ++k)
            out += text(place(k), y, filled(ink) + " text-anchor=\"end\"", figure(values[k], 1));
    }
    return y;
}

}  // namespace sfsm::report
