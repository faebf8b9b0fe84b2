// What a run came to, in the figures the paper and the scorecard use.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sfsm/trace.h"

namespace sfsm {

struct Summary {
    std::int64_t frames = 0;  // with a measured time
    double target_ms = 0;     // of the last frame
    double mean_ms = 0, p50_ms = 0, p99_ms = 0;
    double control_rate = 0;                     // mean of max(0, 1 - |T - t| / t), in [0, 1]
    double within_5pct = 0, within_10pct = 0;    // shares of frames with |T - t| <= 5 % / 10 % of t
    double over_5pct = 0;                        // share of frames with T > 1.05 t
    std::array<std::int64_t, 3> state_frames{};  // of the frames counted in `frames`
    std::int64_t out_of_reach_frames = 0;        // of all: those that the law expected to take over 1.05 t

    // What was kept: TraceRow's promises, of all frames whose renderer made them; NaN without any.
    double max_motion_error_px = std::numeric_limits<double>::quiet_NaN();  // the largest
    double max_splat_error_px = std::numeric_limits<double>::quiet_NaN();
    double predicted_flip = std::numeric_limits<double>::quiet_NaN();  // mean
    double worst_predicted_flip = std::numeric_limits<double>::quiet_NaN();
};

// Of the measured frames: those with a finite time and a finite target over 0. Zeros where there are none. Percentiles
// are of the sorted times, nearest rank.
Summary summarize(std::span<const TraceRow> rows);

// A frame as far as a summary goes, and the same summary of such frames.
struct FrameTime {
    double target_ms = 0, frame_ms = 0;
    State state = State::original;
};
Summary summarize_times(std::span<const FrameTime> frames);

// The same of frames that nobody keeps. A measured one takes 8 bytes.
class Summing {
public:
    void expect(std::size_t frames) { times_.reserve(frames); }
    void add(const FrameTime& frame);
    Summary finish();  // once

private:
    Summary sum_;
    std::vector<double> times_;
};

// One JSON object on several lines, ending in a line feed: the fields above under their names, and people, law, seed
// and device as the trace settings of those names have them (null where they are missing; seed and people are numbers).
//   warnings  what was lost of the files that were read, a line a kind
std::string summary_json(const Summary& summary, const std::map<std::string, std::string>& settings,
                         std::span<const std::string> warnings);

}  // namespace sfsm
