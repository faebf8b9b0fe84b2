// What a piece of each kind of work costs, learned from a recorded run that counted its work.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "sfsm/prices.h"
#include "sfsm/trace.h"

namespace sfsm::simulate {

// Prices, and how well prices times counts explain the times of a trace.
struct CostFit {
    Prices prices;            // [ms] each >= 0: robust, non-negative least squares
    Prices sigma;             // [ms] 1 sigma of each; where the rows can't tell, as large as the price that is believed
    std::int64_t frames = 0;  // that were fitted
    double r2 = 0;         // 1 - residual / total sum of squares of the times; can be negative; 0 where all are equal
    double median_ms = 0;  // of the times
    // Percentiles of the relative residual time / model - 1.
    static constexpr std::array<double, 7> percents{1, 5, 25, 50, 75, 95, 99};
    std::array<double, 7> residual{};
};

// The prices, none below 0, of the least Huber loss of time / model - 1.
// - Residuals are relative, since noise is. A pause fifty times as long weighs as much as a frame that is somewhat off.
// - Where a residual is like the one before it, only their difference is fitted: a machine that drifts has no
//   new prices.
// - Rows can't tell the price of a kind that was never drawn, or whose count hardly changed. There the belief of
//   work_table decides (fit_pieces, fit_spread), and a known kind of shape tells of the others: triangles that were
//   never drawn are not free, and the time of a constant crowd is shared between its people and the frame.
// - That belief is weak against hundreds of noisy frames, and moves nothing where there is no noise.
// - Left out: rows without a time, or with one more than a thousandfold from the median.
// `drawing`: by what the rows were drawn, whose beliefs those are. Throws std::runtime_error where fewer than 16 rows
// are left, or no work is counted in any.
CostFit fit_costs(std::span<const TraceRow> rows, Drawing drawing = Drawing::opengl);

// A time that a frame can take at all: from a nanosecond to eleven days.
inline bool is_frame_time(double ms) {
    return ms >= 1e-6 && ms <= 1e9;
}

}  // namespace sfsm::simulate
