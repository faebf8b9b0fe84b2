#include <algorithm>
#include <array>
#include <cmath>

#include "sfsm/report/markup.h"
#include "sfsm/report/numbers.h"
#include "sfsm/report/pictures.h"
#include "sfsm/report/series.h"
#include "sfsm/report/svg_parts.h"

namespace sfsm::report {
namespace {

constexpr const char* gpu_colour = "#c3d3e6";
constexpr const char* cpu_colour = "#f0c9a0";

// Of one recording where its frames lie, over the time of the longest.
struct Course {
    std::vector<double> starts;  // of each frame and the end of the last [px]
    std::vector<float> times;

    Begins begins() const {
        return [this](std::int64_t frame) { return starts[static_cast<std::size_t>(frame)]; };
    }
};

Course course_of(const ReportedRecording& recording, const Axis& seconds) {
    Course course{{seconds(0)}, series_of(recording.frames, &FrameRecord::frame_ms)};
    double now = 0;
    for (const FrameRecord& frame : recording.frames) {
        now += is_timed(frame) ? frame.frame_ms / 1000 : 0;
        course.starts.push_back(seconds(now));
    }
    return course;
}

// One bucket a frame as long as no more than two share a column, else one a column.
std::vector<Bucket> thin_along(const std::vector<float>& values, const Course& course) {
    const auto frames = static_cast<std::int64_t>(values.size());
    if (frames <= 2 * chart_columns) return thin(values, chart_columns);
    std::vector<Bucket> buckets;
    for (std::int64_t begin = 0, end = 0; begin < frames; begin = end) {
        const double column = std::floor(course.starts[static_cast<std::size_t>(begin)]);
        for (end = begin + 1; end < frames && std::floor(course.starts[static_cast<std::size_t>(end)]) == column;)
            ++end;
        buckets.push_back(bucket(values, begin, end));
    }
    return buckets;
}

std::string second_labels(const Axis& seconds, double y) {
    std::string out;
    for (const double tick : ticks(seconds, 10))
        out += text(seconds(tick), y, filled(faint_ink) + " text-anchor=\"middle\"", tick_text(tick));
    return out;
}

// Where a stutter's mark would hide the last one's there is none.
std::string stutter_marks(const ReportedRecording& recording, const Course& course, double bottom,
                          const std::string& colour) {
    constexpr double apart = 4;
    std::string path;
    double last = -apart;
    for (const Stutter& stutter : recording.stutters) {
        const auto frame = static_cast<std::size_t>(stutter.frame);
        const double x = (course.starts[frame] + course.starts[frame + 1]) / 2;
        if (x - last < apart) continue;
        path += "M" + pixels(x - 4) + " " + pixels(bottom) + "l4 -9l4 9z";
        last = x;
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"" + colour + "\"/>\n";
}

double draw_times(std::string& out, const Report& report, const std::vector<Course>& courses, const Axis& seconds,
                  double top) {
    std::vector<float> all, targets;
    for (const Course& course : courses) all.insert(all.end(), course.times.begin(), course.times.end());
    const double target = common_target(report.recordings);
    if (std::isfinite(target)) targets.push_back(static_cast<float>(target));
    const Axis y{0, fitted_top(all, targets), top + 240, top};
    out += chart_frame(std::string("Frame time [ms]") + (has_stutters(report) ? "; triangles: stutters" : ""), y, 6);
    if (!targets.empty()) out += line(chart_left, y(target), chart_right, y(target), faint_ink);
    double bottom = y.begin;
    for (std::size_t i = 0; i < courses.size(); ++i) {
        const Begins begins = courses[i].begins();
        const std::vector<Bucket> thinned = thin_along(courses[i].times, courses[i]);
        out += stroke(curve(thinned, begins, y, false), colour_of(i), "stroke-width=\"1.25\" stroke-opacity=\"0.9\"");
        out += carets(thinned, begins, y, colour_of(i));
        if (report.recordings[i].stutters.empty()) continue;
        bottom += 13;
        out += stutter_marks(report.recordings[i], courses[i], bottom, colour_of(i));
    }
    out += second_labels(seconds, bottom + 16);
    return bottom + 16;
}

// From 0 up to the most of each bucket.
std::string area(const std::vector<float>& values, const Course& course, const Axis& y, const char* colour) {
    std::string path;
    for (const Bucket& bucket : thin_along(values, course)) {
        if (bucket.is_empty()) continue;
        const double begin = course.starts[static_cast<std::size_t>(bucket.begin)];
        const double end = course.starts[static_cast<std::size_t>(bucket.end)];
        path += "M" + pixels(begin) + " " + pixels(y.begin) + "V" + pixels(y(bucket.high)) + "H" + pixels(end) + "V" +
                pixels(y.begin) + "z";
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"" + colour + "\" fill-opacity=\"0.75\"/>\n";
}

double sum_of(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += std::isfinite(value) ? static_cast<double>(value) : 0;
    return sum;
}

// Of the first recording: of several, areas would cover each other.
double draw_busy(std::string& out, const Report& report, const Course& course, const Axis& seconds, double top) {
    const ReportedRecording& recording = report.recordings.front();
    const std::vector<float> gpu = series_of(recording.frames, &FrameRecord::gpu_ms),
                             cpu = series_of(recording.frames, &FrameRecord::cpu_ms);
    if (!is_told(gpu) && !is_told(cpu)) return top;
    const Axis y{0, fitted_top(course.times, {}), top + 134, top + 44};
    out += chart_frame("GPU (blue) and CPU (orange) busy [ms]" +
                           (report.recordings.size() > 1 ? " of " + shortened(recording.name, 40) : ""),
                       y, 3);
    const std::string gpu_area = area(gpu, course, y, gpu_colour), cpu_area = area(cpu, course, y, cpu_colour);
    out += sum_of(gpu) > sum_of(cpu) ? gpu_area + cpu_area : cpu_area + gpu_area;  // the greater would hide the other
    out += second_labels(seconds, y.begin + 16);
    return y.begin + 16;
}

// From 0 on, or as far down as up.
Axis series_axis(const std::vector<float>& values, bool is_signed, double top) {
    double far = 0;
    for (const float value : values) far = std::isfinite(value) ? std::max<double>(far, std::abs(value)) : far;
    if (is_signed && far > 0) return {-1.05 * far, 1.05 * far, top + 134, top + 44};
    return {0, fitted_top(values, {}), top + 134, top + 44};
}

// Of all recordings that tell it, from shown frame to shown frame.
double draw_series(std::string& out, const Report& report, const std::vector<Course>& courses, const Axis& seconds,
                   const char* title, float FrameRecord::*field, bool is_signed, double top) {
    std::vector<std::vector<float>> told;
    std::vector<float> all;
    for (const ReportedRecording& recording : report.recordings) {
        told.push_back(series_of(recording.frames, field));
        all.insert(all.end(), told.back().begin(), told.back().end());
    }
    if (!is_told(all)) return top;
    const Axis y = series_axis(all, is_signed, top);
    out += chart_frame(title, y, 3);
    for (std::size_t i = 0; i < told.size(); ++i) {
        std::vector<Bucket> thinned = thin_along(told[i], courses[i]);
        std::erase_if(thinned, [](const Bucket& bucket) { return bucket.is_empty(); });
        out += stroke(curve(thinned, courses[i].begins(), y, false), colour_of(i), "stroke-width=\"1.1\"");
    }
    out += second_labels(seconds, y.begin + 16);
    return y.begin + 16;
}

// The figures that people look for first, a row a recording.
double draw_figures(std::string& out, const Report& report, double top) {
    constexpr std::array<const char*, 6> heads = {"average fps",  "P1",           "P0.1",
                                                  "1 % low int.", "longest [ms]", "in stutter [%]"};
    constexpr double column = 112, row = 24;
    const auto place = [&](std::size_t k) { return chart_right - column * static_cast<double>(heads.size() - 1 - k); };
    for (std::size_t k = 0; k < heads.size(); ++k)
        out += text(place(k), top, filled(faint_ink) + " text-anchor=\"end\"", heads[k]);
    double y = top;
    for (std::size_t i = 0; i < report.recordings.size(); ++i) {
        const Figures& f = report.recordings[i].figures;
        const std::array<double, 6> values = {f.average_fps,    f.p1_fps,  f.p01_fps,
                                              f.low_1.integral, f.most_ms, 100 * f.stutter_share};
        out += line(chart_left, y + 7, chart_right, y + 7, grid);
        y += row;
        out += rectangle(chart_left, y - 10, 6, 12, colour_of(i));
        out += text(chart_left + 14, y, filled(ink), shortened(report.recordings[i].name, 24));
        for (std::size_t k = 0; k < values.size(); ++k)
            out += text(place(k), y, filled(ink) + " text-anchor=\"end\"", figure(values[k], k == 5 ? 2 : 1));
    }
    return y;
}

}  // namespace

double draw_recordings(std::string& out, const Report& report, double top) {
    double longest = 0;
    for (const ReportedRecording& recording : report.recordings) longest = std::max(longest, recording.figures.seconds);
    const Axis seconds{0, longest > 0 ? longest : 1, chart_left, chart_right};
    std::vector<Course> courses;
    for (const ReportedRecording& recording : report.recordings) courses.push_back(course_of(recording, seconds));
    double y = draw_figures(out, report, top) + 54;
    y = draw_times(out, report, courses, seconds, y);
    y = draw_series(out, report, courses, seconds, "Between changes of the display [ms]", &FrameRecord::display_ms,
                    false, y);
    y = draw_series(out, report, courses, seconds, "Animation error [ms]: over 0 too soon, under 0 too late",
                    &FrameRecord::animation_error_ms, true, y);
    y = draw_busy(out, report, courses.front(), seconds, y);
    out += text(chart_right, y + 18, filled(faint_ink) + " text-anchor=\"end\"", "seconds");
    std::vector<std::vector<float>> times;
    for (const Course& course : courses) times.push_back(course.times);
    return draw_percentiles(out, names_of(report.recordings), times, y + 48);
}

}  // namespace sfsm::report
