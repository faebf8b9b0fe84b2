#include "tests/bench/front/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sfsm/report/markup.h"
#include "sfsm/report/plot.h"
#include "tests/bench/front/sentences.h"

namespace bench::front {
namespace {

using sfsm::report::Axis;
using sfsm::report::pixels;

// [px]
struct Look {
    double width, height, left, right, top, bottom;  // the last four: margins
    double point, mark;                              // radii
    int ticks;
};
constexpr Look small_look{220, 132, 30, 8, 8, 18, 1.6, 3, 2};
constexpr Look large_look{900, 440, 54, 14, 22, 40, 4, 6.5, 6};

struct Plot {
    Look look;
    Axis x, y;  // of log10(ms), of the error's height
    const ErrorKind& error;

    double at_ms(double ms) const { return x(std::log10(ms)); }
    bool is_small() const { return look.width < large_look.width; }
    double at(const Row& row) const { return y(error.height(row)); }
};

Plot plot_of(const Look& look, const Range& range, const ErrorKind& error) {
    const double margin = 0.04 * (range.most - range.least);
    const double exact = range.has_exact ? 3 * margin : 0;  // a place below the others
    return {look,
            {std::log10(range.fast_ms / 1.12), std::log10(range.slow_ms * 1.12), look.left, look.width - look.right},
            {range.least - margin - exact, range.most + margin, look.height - look.bottom, look.top},
            error};
}

bool is_shown(const Row& row, const ErrorKind& error) {
    return std::isfinite(row.wall_ms) && row.wall_ms > 0 && !std::isnan(error.height(row));
}

std::string text(double x, double y, const char* anchor, const std::string& content) {
    return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" text-anchor=\"" + anchor + "\">" + content +
           "</text>\n";
}

std::string path(const std::string& attributes, const std::string& d) {
    return "<path " + attributes + " d=\"" + d + "\"/>\n";
}

// 1, 2 and 5 of each decade that the axis of log10 holds, or powers of ten alone.
std::vector<double> log_ticks(const Axis& axis, bool only_powers) {
    std::vector<double> values;
    for (double power = std::floor(axis.low); power <= axis.high; ++power) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double log = power + std::log10(factor);
            if (log >= axis.low && log <= axis.high && (factor == 1 || !only_powers)) {
                values.push_back(factor * std::pow(10, power));
            }
        }
    }
    return values;
}

std::string y_grid(const Plot& plot, const Range& range) {
    const bool is_log = !plot.error.more_is_better;
    std::string out;
    for (const double tick :
         is_log ? log_ticks(plot.y, plot.is_small()) : sfsm::report::ticks(plot.y, plot.look.ticks)) {
        const double height = is_log ? std::log10(tick) : tick;
        if (range.has_exact && height < range.least) continue;  // what is exact has a label of its own
        const std::string y = pixels(plot.y(height));
        out += path("class=\"grid\"", "M" + pixels(plot.x.begin) + " " + y + "H" + pixels(plot.x.end));
        out += text(plot.x.begin - 6, plot.y(height) + 4, "end", sfsm::report::tick_text(is_log ? tick : -tick));
    }
    if (range.has_exact) out += text(plot.x.begin - 6, plot.y.begin, "end", plot.is_small() ? "=" : "exact");
    return out;
}

std::string x_ticks(const Plot& plot) {
    std::string out;
    const double bottom = plot.y.begin;
    for (const double ms : log_ticks(plot.x, plot.is_small())) {
        const double x = plot.at_ms(ms);
        out += path("class=\"axis\"", "M" + pixels(x) + " " + pixels(bottom) + "v4");
        out += text(x, bottom + 15, "middle", sfsm::report::tick_text(ms));
    }
    return out;
}

// What the axes are, and the time of a frame.
std::string titles(const Plot& plot) {
    const Look& look = plot.look;
    const std::string unit = plot.error.unit.empty() ? "" : " [" + std::string(plot.error.unit) + "]";
    return text(2, 10, "start", std::string(plot.error.name) + unit) +
           text(plot.at_ms(frame_ms), plot.y.end - 7, "middle", time_text(frame_ms) + " ms") +
           text(plot.x.end, look.height - 4, "end", "time of a frame [ms] \u2192");
}

std::string frame_line(const Plot& plot) {
    if (std::log10(frame_ms) < plot.x.low || std::log10(frame_ms) > plot.x.high) return "";
    return path("class=\"frame\"",
                "M" + pixels(plot.at_ms(frame_ms)) + " " + pixels(plot.y.end) + "V" + pixels(plot.y.begin));
}

// The best error so far for every time: down at each point of the front, then on to the next.
std::string front_line(const Plot& plot, const Scene& scene) {
    std::string d;
    for (const std::size_t i : front_of(scene.rows, plot.error)) {
        const Row& row = scene.rows[i];
        d += (d.empty() ? "M" + pixels(plot.at_ms(row.wall_ms)) + " " + pixels(plot.y.end)
                        : "H" + pixels(plot.at_ms(row.wall_ms))) +
             "V" + pixels(plot.at(row));
    }
    if (d.empty()) return "";
    d += "H" + pixels(plot.x.end);
    return path("class=\"under\"",
                d + "V" + pixels(plot.y.begin) + "H" + pixels(plot.x.begin) + "V" + pixels(plot.y.end) + "Z") +
           path("class=\"front\"", d);
}

std::string points(const Plot& plot, const Scene& scene, std::size_t family, const std::string& name) {
    std::string d, circles;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < scene.rows.size(); ++i) {
        const Row& row = scene.rows[i];
        if (row.family == name && !row.is_mark() && is_shown(row, plot.error)) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return scene.rows[a].wall_ms < scene.rows[b].wall_ms; });
    for (const std::size_t i : order) {
        const std::string x = pixels(plot.at_ms(scene.rows[i].wall_ms)), y = pixels(plot.at(scene.rows[i]));
        d += (d.empty() ? "M" : "L") + x + " " + y;
        circles += "<circle class=\"point\" data-row=\"" + std::to_string(scene.places[i]) + "\" cx=\"" + x +
                   "\" cy=\"" + y + "\" r=\"" + pixels(plot.look.point) + "\"/>\n";
    }
    if (order.empty()) return "";
    return "<g class=\"family family-" + std::to_string(family % family_looks) + "\">\n" + path("class=\"curve\"", d) +
           circles + "</g>\n";
}

std::string marks(const Plot& plot, const Scene& scene) {
    std::string out;
    for (std::size_t i = 0; i < scene.rows.size(); ++i) {
        const Row& row = scene.rows[i];
        if (!row.is_mark() || !is_shown(row, plot.error)) continue;
        out +=
            path("class=\"mark law-" + law_class(row.law) + "\" data-row=\"" + std::to_string(scene.places[i]) +
                     "\" transform=\"translate(" + pixels(plot.at_ms(row.wall_ms)) + " " + pixels(plot.at(row)) + ")\"",
                 mark_path(row.law, plot.look.mark));
    }
    return out;
}

}  // namespace

Range range_of(std::span<const Scene> scenes, const ErrorKind& error) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Range range{frame_ms, frame_ms, infinity, -infinity, false};
    for (const Scene& scene : scenes) {
        for (const Row& row : scene.rows) {
            if (!is_shown(row, error)) continue;
            range.fast_ms = std::min(range.fast_ms, row.wall_ms);
            range.slow_ms = std::max(range.slow_ms, row.wall_ms);
            if (row.target_ms > 0 && std::isfinite(row.target_ms)) {
                range.fast_ms = std::min(range.fast_ms, row.target_ms);
                range.slow_ms = std::max(range.slow_ms, row.target_ms);
            }
            const double height = error.height(row);
            range.has_exact = range.has_exact || height == -infinity;
            if (!std::isfinite(height)) continue;
            range.least = std::min(range.least, height);
            range.most = std::max(range.most, height);
        }
    }
    if (range.most < range.least) range.least = range.most = 0;
    const double most_decades = error.more_is_better ? infinity : 3;  // what is better than that is at the bottom
    range.least = std::max(range.least, range.most - most_decades);
    const double least_span = error.more_is_better ? 1 : 0.1;
    if (range.most - range.least < least_span) range.least = range.most - least_span;
    return range;
}

std::vector<std::string> families_of(const Front& front) {
    std::vector<std::string> families;
    for (const Row& row : front.rows)
        if (!row.is_mark() && std::find(families.begin(), families.end(), row.family) == families.end())
            families.push_back(row.family);
    return families;
}

std::string law_class(std::string_view law) {
    for (const std::string_view known : {"predictive", "safeguarded", "paper"})
        if (law == known) return std::string(known);
    return "other";
}

std::string mark_path(std::string_view law, double radius) {
    const std::string r = pixels(radius), side = pixels(1.8 * radius), half = pixels(0.9 * radius);
    if (law == "predictive") return "M0 -" + r + "L" + r + " 0L0 " + r + "L-" + r + " 0Z";
    if (law == "safeguarded") return "M-" + half + " -" + half + "h" + side + "v" + side + "h-" + side + "Z";
    if (law == "paper") return "M0 -" + r + "L" + r + " " + half + "L-" + r + " " + half + "Z";
    return "M-" + half + " -" + half + "l" + side + " " + side + "m0 -" + side + "l-" + side + " " + side;
}

std::string chart_svg(const Scene& scene, const ErrorKind& error, const Range& range,
                      const std::vector<std::string>& families, ChartSize size) {
    const Plot plot = plot_of(size == ChartSize::small ? small_look : large_look, range, error);
    std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + pixels(plot.look.width) + " " + pixels(plot.look.height) +
                      "\" role=\"img\" aria-label=\"" + sfsm::report::escaped(scene.name()) + ": time against " +
                      std::string(error.name) + "\">\n";
    out += y_grid(plot, range) + x_ticks(plot) + frame_line(plot);
    if (!plot.is_small()) out += titles(plot);
    out += front_line(plot, scene);
    for (std::size_t family = 0; family < families.size(); ++family)
        out += points(plot, scene, family, families[family]);
    return out + marks(plot, scene) + "</svg>\n";
}

}  // namespace bench::front
