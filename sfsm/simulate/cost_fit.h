// What a piece of each kind of work costs, learned from a recorded run that counted its work.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "sfsm/prices.h"
#include "sfsm/trace.h"

namespace sfsm::simulate {

// How well prices times counts explain the times of a trace.
struct CostFit {
    Prices prices;            // [ms] each >= 0: robust, non-negative least squares
    Prices sigma;             // [ms] 1 sigma of each; as large as a usual price where the rows can't tell
    std::int64_t frames = 0;  // that were fitted
    double r2 = 0;         // 1 - residual / total sum of squares of the times; can be negative; 0 where all are equal
    double median_ms = 0;  // of the times
    // Percentiles of the relative residual time / model - 1.
    static constexpr std::array<double, 7> percents{1, 5, 25, 50, 75, 95, 99};
    std::array<double, 7> residual{};
};

// The prices of the least Huber loss of time / model - 1: noise is relative, and a pause that takes fifty times as long
// weighs no more than a frame that is off by the usual noise. Where residuals are like their neighbours, only what is
// new in each is fitted: a machine's drift is no price. What rows can't tell (a kind of work that was never drawn, or
// people or updates whose count hardly changed) is settled by a belief: a triangle 1 piece, a point 2, a person 50, an
// update 4, as our renderer has them, each give or take as much again (1 sigma; an update, which is dear where people
// are skinned, 300); of triangles and points the known one tells of the other. Against hundreds of frames of some per
// cent of noise that is weak, and where times have no noise it moves nothing that they tell. So the time of a constant
// number of people is shared between them and the frame, and triangles that a run has none of are not free.
//
// Rows without a time, or one more than a thousandfold from the median, are left out. Throws std::runtime_error where
// fewer than 16 are left, or no work is counted in any.
CostFit fit_costs(std::span<const TraceRow> rows);

// A time that a frame can take at all: from a nanosecond to eleven days.
inline bool is_frame_time(double ms) {
    return ms >= 1e-6 && ms <= 1e9;
}

}  // namespace sfsm::simulate
