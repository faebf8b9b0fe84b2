#include "sfsm/report/small_multiples.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "sfsm/report/markup.h"
#include "sfsm/report/plot.h"
#include "sfsm/report/series.h"

namespace sfsm::report {
namespace {

constexpr int width = 220;  // [px]
constexpr double height = 44;

// Least and most of each column.
std::string extent_path(const std::vector<float>& values, const Axis& x, const Axis& y) {
    std::string path;
    bool is_drawing = false;
    for (const Bucket& bucket : thin(values, width)) {
        if (bucket.is_empty()) {
            is_drawing = false;
            continue;
        }
        const double middle = x(static_cast<double>(bucket.begin + bucket.end) / 2);
        path += (is_drawing ? "L" : "M") + pixels(middle) + " " + pixels(y(bucket.low));
        path += "V" + pixels(y(bucket.high));
        is_drawing = true;
    }
    return path;
}

void write_path(std::ostream& out, const char* of, const std::string& path) {
    if (!path.empty()) out << "<path class=\"" << of << "\" d=\"" << path << "\"/>";
}

void write_picture(std::ostream& out, const Report& report, const ReportRun& run, double top) {
    const Axis x{0, static_cast<double>(std::max<std::size_t>(1, report.runs.front().frames.size())), 0, width};
    const Axis y{0, top, height - 1, 1};
    out << "<svg class=\"small\" viewBox=\"0 0 " << width << ' ' << pixels(height)
        << "\" role=\"img\" aria-label=\"Frame times of " << escaped(run.name) << "\">";
    if (&run != &report.runs.front()) {
        write_path(out, "small-first",
                   extent_path(series_of(report.runs.front().frames, &ReportFrame::frame_ms), x, y));
    }
    write_path(out, "small-run", extent_path(series_of(run.frames, &ReportFrame::frame_ms), x, y));
    write_path(out, "small-target", extent_path(series_of(run.frames, &ReportFrame::target_ms), x, y));
    out << "</svg>";
}

}  // namespace

void write_small_multiples(std::ostream& out, const Report& report) {
    const double top = fitted_top(series_of(report.runs.front().frames, &ReportFrame::frame_ms),
                                  series_of(report.runs.front().frames, &ReportFrame::target_ms));
    out << "<table class=\"multiples\"><thead><tr><th scope=\"col\">Run</th><th scope=\"col\">Frame time, 0 to "
        << figure(top, 1) << " <small>ms</small></th>";
    for (const Score& score : report.runs.front().scores) {
        out << "<th scope=\"col\">" << escaped(score.name)
            << (score.unit.empty() ? "" : " <small>" + escaped(score.unit) + "</small>") << "</th>";
    }
    out << "</tr></thead><tbody>\n";
    for (const ReportRun& run : report.runs) {
        out << "<tr><th scope=\"row\">" << escaped(run.name) << "</th><td>";
        write_picture(out, report, run, top);
        out << "</td>";
        for (const Score& score : run.scores) out << "<td>" << figure(score.value, score.digits) << "</td>";
        out << "</tr>\n";
    }
    out << "</tbody></table>\n";
}

}  // namespace sfsm::report
