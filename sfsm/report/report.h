// Recordings and runs drawn for people: how a game ran, and why it stuttered; then frame time against target and what a
// law decided, of one law or several. As one HTML file that needs nothing else and can be zoomed, hovered and printed,
// or as an SVG picture.
#pragma once

#include <iosfwd>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sfsm/decision.h"
#include "sfsm/frame_times/differences.h"
#include "sfsm/frame_times/figures.h"
#include "sfsm/frame_times/stutters.h"
#include "sfsm/recordings/frame_record.h"
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

// What was recorded, as it is. `frames` must live as long.
struct ReportedRecording {
    std::string name;
    std::vector<std::pair<std::string, std::string>> facts;  // of the game and the machine, in the order shown
    std::vector<std::string> notes;                          // on how it was read
    std::span<const FrameRecord> frames;
    Figures figures;
    std::vector<Stutter> stutters;
    Over over_target = {FrameRecord::untold, 0,
                        FrameRecord::untold};  // limit: NaN where the target changes; share: NaN without one
};

// What the runs of a trace of ours show, in words.
inline constexpr std::string_view decision_words =
    "How each frame was drawn. People beyond the distance D move at a lower rate; in state points everybody is drawn "
    "as "
    "points of size S.";

// Two of the report's recordings.
struct Comparison {
    std::size_t first = 0, second = 0;
    std::vector<Difference> differences;
};

// A page's parts come in this order; those that are empty are left out.
struct Report {
    std::string title;
    std::vector<std::pair<std::string, std::string>> facts;  // of the laws' runs, in the order shown
    std::vector<ReportRun> runs;                             // of laws; the first is shown first
    std::string runs_title = "Frame by frame";               // of the part with the runs
    std::string runs_words = {};                             // in which what the runs are is explained

    std::vector<ReportedRecording> recordings = {};
    std::vector<Comparison> comparisons = {};
};

// Text may hold anything: it is escaped. The same report gives the same bytes. Colours come again after eight runs;
// over six laws are a table with small pictures.
//
// Times of a recording's frames are kept to 0.001 ms, of over 200,000 frames to 0.01 ms: 1 to 3 bytes a frame. Of all
// else 20,000 frames are kept, a recording's to 0.001 ms and a law's to the bit; of more frames the least and the most
// in each of 4,096 stretches, but for the times of a law's run of up to 200,000 frames. A picture is never more than
// some 100 KB a run.
void write_report_html(std::ostream& out, const Report& report);
void write_report_svg(std::ostream& out, const Report& report);

}  // namespace sfsm
