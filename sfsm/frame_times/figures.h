// What people look for in a recording of frame times, as numbers. Frames without a time count for nothing but `frames`.
//
// A rate is 1000 over a time. Percentiles are CapFrameX's (Hyndman and Fan's definition 8): of n frames sorted from the
// slowest, P1 stands at place (n + 1/3) / 100 + 1/3, but not before the first or behind the last; between two places a
// rate goes linearly from rate to rate, and a time from time to time.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// Whether it has a time.
inline bool is_timed(const FrameRecord& frame) {
    return frame.frame_ms > 0;
}

// "1 % low" has three meanings, of which tools show one each [frames/s]: P1; the rate of the mean time of the slowest 1
// % of the frames (the last in part, at least one; CapFrameX's "1 % low average" but for ties, of which it takes all);
// and the rate of the frame at which the slowest frames, longest first, have taken 1 % of all the time ("1 % low
// integral", and MSI Afterburner's).
struct Low {
    double percentile = 0, mean = 0, integral = 0;
};

// Frames longer than a limit.
struct Over {
    double limit_ms = 0;
    std::int64_t frames = 0;
    double share = 0;  // of the frames with a time, [0, 1]
};

// Who held up the frames whose CPU and GPU times are both told, in shares of their time.
struct Bottleneck {
    std::int64_t frames = 0;  // with all three times; 0: the shares are NaN
    double gpu = 0, cpu = 0, neither = 0;
};

// The GPU, where it was busy for 90 % of the frame or more and no less than the CPU; else the CPU, where it was busy
// for 90 % or more; else, if both are told, neither, as frames wait for a display, a cap or a lock.
enum class HeldUpBy { gpu, cpu, neither, untold };
HeldUpBy held_up_by(const FrameRecord& frame);

struct Figures {
    std::int64_t frames = 0, timed = 0;         // all; those with a time
    std::int64_t dropped = 0, shown = 0;        // as far as their fate is told
    std::int64_t generated = 0, displayed = 0;  // presents besides; with a display's time
    double seconds = 0;                         // sum of the times
    double average_fps = 0, median_fps = 0, p1_fps = 0, p01_fps = 0, least_fps = 0, most_fps = 0;
    Low low_1, low_01;  // of 1 % and of 0.1 %
    double mean_ms = 0, median_ms = 0, p99_ms = 0, p999_ms = 0, least_ms = 0, most_ms = 0;
    double mean_step_ms = 0;                        // of |time - time before|, of neighbours that both have one
    std::int64_t stutters = 0, stutter_window = 0;  // stutters.h; the window in frames
    double stutter_share = 0;                       // of the time, [0, 1]
    std::vector<Over> over;                         // a limit each, as they are given
    Bottleneck bottleneck;
    double mean_animation_error_ms = 0;  // of its size, where it is told; else NaN
};

// Frames over their target. `limit_ms` is the target, NaN where it changes; without targets all is NaN.
Over over_targets(std::span<const FrameRecord> frames, const std::function<double(std::size_t frame)>& target_ms);

// 120, 60 and 30 frames a second, as people write them: a game that is held at 60 is not over 16.7.
inline constexpr std::array<double, 3> usual_limits_ms = {8.3, 16.7, 33.3};

// Where no frame has a time: no seconds, no stutters, and rates, times and shares are NaN. O(n log n).
Figures figures_of(std::span<const FrameRecord> frames, std::int64_t generated, std::span<const double> limits_ms);

}  // namespace sfsm
