// Runs drawn for people: frame time against target and what the law decided, of one law or several over each other. As
// one HTML file that needs nothing else and can be zoomed, hovered and printed, or as an SVG picture.
#pragma once

#include <iosfwd>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sfsm/decision.h"
#include "sfsm/trace.h"

namespace sfsm {

// What is shown of a frame. Single precision: pictures need no more, and reports hold a million frames.
struct ReportFrame {
    float target_ms = 0;
    float frame_ms = std::numeric_limits<float>::quiet_NaN();      // NaN: not measured
    float predicted_ms = std::numeric_limits<float>::quiet_NaN();  // NaN: the law doesn't say
    float motion_distance = 0;                                     // D [m]; means nothing in state 0, may be infinite
    float splat_size = 0;                                          // S [px]
    State state = State::original;
    float rate = 0;  // [px / piece]; 0: D and S decided
};
ReportFrame report_frame(const TraceRow& row);

// A figure of the scorecard. The same names in the same order for all runs of a report.
struct Score {
    std::string name;  // "control rate"
    std::string unit;  // "%", "ms", ""
    double value = 0;  // NaN: none
    int digits = 1;    // shown after the point
    enum class Better { more, less, neither } better = Better::neither;
};

// Of any run: control rate, within 5 and 10 %, over by 5 %, mean, median, 99th percentile.
std::vector<Score> time_scores(const std::vector<ReportFrame>& frames);

struct ReportRun {
    std::string name;  // the law's
    std::vector<ReportFrame> frames;
    std::vector<Score> scores;
};

// A run with the scores of its times.
ReportRun report_run(std::string name, std::span<const TraceRow> rows);

struct Report {
    std::string title;
    std::vector<std::pair<std::string, std::string>> facts;  // of the run and the machine, in the order shown
    std::vector<ReportRun> runs;                             // >= 1; the first is shown first
};

// Text may hold anything: it is escaped. The same report gives the same bytes. Runs have eight colours; the ninth has
// the first's again. A page takes at most 28 bytes a frame and run, 34 where it was
// decided by rate, a picture never more than some 100 KB a run.
void write_report_html(std::ostream& out, const Report& report);
void write_report_svg(std::ostream& out, const Report& report);

}  // namespace sfsm
