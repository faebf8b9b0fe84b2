#include "sfsm/tail.h"

#include <algorithm>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

// After n frames a step is gain / (head_start + n) times the estimate, or times sigma while that is more. The best
// gain is 1 / density there: some 15 sigmas of a normal distribution, and several times that of a heavy tail.
constexpr double gain = 18;
constexpr int head_start = 40;      // [frames]
constexpr int memory = 400;         // [frames] from which on steps shrink no more
constexpr double longest = 0.3;     // [ln] a frame a third longer than predicted is a hitch, a pause or another load
constexpr double hysteresis = 0.5;  // [sigmas] by which the estimate moves before it is heard

}  // namespace

void Tail::add(double residual, double noise) {
    if (residual > longest) return;
    const double step = gain / (head_start + heard_) * std::max(noise, estimate_);
    heard_ = std::min(heard_ + 1, memory);
    estimate_ = std::max(estimate_ + (residual > estimate_ ? percentile : percentile - 1) * step, 0.0);
    if (std::abs(estimate_ - excess_) >= hysteresis * noise) excess_ = estimate_;
}

}  // namespace sfsm
