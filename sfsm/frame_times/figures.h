// What people look for in a recording of frame times, as numbers. Frames without a time count for nothing but `frames`.
//
// A rate is 1000 over a time: the rate of P1 is that of the time which 99 % of the frames do not exceed. Percentiles
// are nearest ranks: of n sorted times the one at place ceil(share n), from 1.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// "1 % low" has three meanings, of which tools show one each [frames/s]: the rate that 99 % of the frames reach; the
// rate of the mean time of the slowest 1 % of the frames (the last of them in part, at least one); and the rate of the
// frame at which the slowest frames, longest first, have taken 1 % of all the time (CapFrameX's and MSI Afterburner's
// integral).
struct Low {
    double percentile = 0, mean = 0, integral = 0;
};

// Frames longer than a limit.
struct Over {
    double limit_ms = 0;
    std::int64_t frames = 0;
    double share = 0;  // of the frames with a time, [0, 1]
};

// Who held up the frames whose CPU and GPU times are both told, in shares of their time: the GPU, where it was busy for
// 90 % of a frame or more and no less than the CPU; else the CPU, where it was busy for 90 % or more; else neither, as
// frames wait for a display, a cap or a lock.
struct Bottleneck {
    std::int64_t frames = 0;  // with both times; 0: the shares say nothing
    double gpu = 0, cpu = 0, neither = 0;
};
enum class HeldUpBy { gpu, cpu, neither, untold };
HeldUpBy held_up_by(const FrameRecord& frame);

struct Figures {
    std::int64_t frames = 0, timed = 0;                      // all; those with a time
    std::int64_t dropped = 0, generated = 0, displayed = 0;  // never shown; presents besides; with a display's time
    double seconds = 0;                                      // sum of the times
    double average_fps = 0, median_fps = 0, p1_fps = 0, p01_fps = 0, least_fps = 0, most_fps = 0;
    Low low_1, low_01;  // of 1 % and of 0.1 %
    double mean_ms = 0, median_ms = 0, p99_ms = 0, p999_ms = 0, least_ms = 0, most_ms = 0;
    double mean_step_ms = 0;  // of |time - time before|, of neighbours that both have one
    std::int64_t stutters = 0;
    double stutter_share = 0;  // of the time, [0, 1]
    std::vector<Over> over;    // a limit each, as they are given
    Bottleneck bottleneck;
    double mean_animation_error_ms = 0;  // of its size, where it is told; else NaN
};

// 120, 60 and 30 frames a second.
inline constexpr std::array<double, 3> usual_limits_ms = {1000.0 / 120, 1000.0 / 60, 1000.0 / 30};

// NaN where no frame has a time. O(n log n).
Figures figures_of(std::span<const FrameRecord> frames, std::int64_t generated, std::span<const double> limits_ms);

}  // namespace sfsm
