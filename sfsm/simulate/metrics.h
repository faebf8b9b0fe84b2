// What a run was worth: the figures of the scorecard, each defined here.
#pragma once

#include <optional>
#include <span>

#include "sfsm/simulate/course.h"

namespace sfsm::simulate {

// T: measured time; t: the user's target, or an outside cap where that is slower; d: the detail of a frame's decision;
// C: its cost, free of noise. Judged frames: those from statistics_from on that are not interrupted and in which t can
// be met (the best decision costs no more). Where there are none, all figures of judged frames are 0.
struct Metrics {
    double judged_ms = 0;       // sum of T of judged frames; 0: there are none
    double over_target = 0;     // share of judged frames with T > t
    double over_5pct = 0;       // ... T > 1.05 t
    double within_5pct = 0;     // ... |T - t| <= 5 % of t
    double within_10pct = 0;    // ... |T - t| <= 10 % of t
    double control_rate = 0;    // mean over judged frames of max(0, 1 - |T - t| / t)
    double worst_second = 0;    // largest share of frames with T > 1.05 t in a stretch of judged frames that lasts 1 s;
                                // 0 where judged_ms is less
    double hitch_ms_per_s = 0;  // sum of max(0, T - t) over the sum of T, of judged frames [ms/s]

    // Sum of d over the sum of the best decisions' d, of the frames from statistics_from on that are not interrupted,
    // whether t can be met or not.
    double quality = 0;

    // Frames from a step of load or target until the law has settled: the first frame from which on, in 57 of 60
    // frames, the median of the last 9 T / t is within 10 % of 1. 0: it never left. Of several steps the slowest
    // counts. Nothing: it did not settle while that load lasted, or there is no such step.
    std::optional<double> settle_down, settle_up;
    // The same with C / t instead of the median, so without its delay. 0: the very first frame drawn under the new load
    // was within 10 %.
    std::optional<double> cost_settle_down, cost_settle_up;

    // Largest C / t - 1 in the judged frames, in percent, at least 0. Without a forecast no law can know of a step in
    // its first 1 + delay frames: these are left out.
    double overshoot_pct = 0;

    // Of the steady frames: how often d turns around, how far it goes in all, and how often the decision differs from
    // the one before.
    double reversals_per_1000 = 0;
    double variation_per_1000 = 0;
    double changes_per_1000 = 0;

    // Frames from the end of the last interruption until d is back. It is back when in 57 of the next 60 frames it is
    // within 2 % of its mean in the 60 frames before the first interruption. 0: it never left. Nothing: it never came
    // back, or there is no interruption.
    std::optional<double> recovery;

    // Frames from where the best detail can be had again (Scenario::regained) until in 57 of 60 frames d is at least
    // Scenario::regained_share of it. Of several the slowest counts. Nothing: it never was, or nothing is to be
    // regained.
    std::optional<double> regain;

    // In the last 600 frames, of those that are judged more than half have T > 1.05 t, or d is less than half the
    // best's: 1, else 0.
    double is_stuck = 0;

    // Mean T of the frames from statistics_from on that are not interrupted, whether t can be met or not [ms].
    double mean_ms = 0;

    // What is seen of a single frame's change, in octaves of the effective S: the splat size, but finest_splat where
    // it is less or people are meshes. The largest change from a frame to the next, less what target and forecast
    // changed by themselves: by octaves of the target and of the count that changed most. From frame 10 on.
    double largest_step = 0;

    // Of the first ten frames that t can be met in: the largest C / t; and the largest effective S over its median in
    // the judged frames.
    double first_over = 0;
    double first_coarse = 0;
};

Metrics measure(const Course& course, std::span<const Outcome> outcomes);

}  // namespace sfsm::simulate
