#include "sfsm/drift.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double first_index = 0.05;  // the tracking index until swings tell, and while the level lags
constexpr double one_way = 4;     // a swing's acceleration keeps its sign for half a period: it counts for so much more
constexpr double lag_memory = 8;  // [frames]
constexpr double lagging = 2;     // [standard errors] by which a level that lags is off

constexpr int memory = 150;                              // [frames] of slow means
constexpr double wide = 0.06;                            // [ln] root mean square of a wander that is worth following
constexpr double narrow = 0.03;                          // and of one that is no more
constexpr double side = 0.05;                            // [ln] from the mean, to be on a side of it
constexpr int swings = 2;                                // changes of side that convince
constexpr int longest_swing = 600, shortest_swing = 25;  // [frames]
constexpr double followed = -0.3;  // correlation of load and detail, while detail follows the load

constexpr double much = 0.15;  // [ln] by which a time is off, and
constexpr double far = 5;      // [sigmas]
constexpr double alike = 0.5;  // share by which two that agree differ at most

double square(double x) {
    return x * x;
}

}  // namespace

double Drift::ahead(double frames) const {
    return level_ + frames * slope_;
}

void Drift::observe(double log_load, double detail, double noise) {
    if (!std::exchange(has_begun_, true)) {
        detail_ = detail;
        return jump(log_load);
    }
    const double error = log_load - ahead(1);
    const bool is_off = std::abs(error) > std::max(much, far * noise);
    const double before = std::exchange(off_, is_off ? error : 0);
    if (is_off) {
        if (before != 0 && std::abs(error - before) < alike * std::abs(error)) return jump(log_load);
        level_ = ahead(1);
        return;
    }
    lag_ += (error - lag_) / lag_memory;
    const Weights weights = weights_for(noise);
    level_ = ahead(1) + weights.level * error;
    slope_ += weights.slope * error;
    judge(log_load, detail);
}

void Drift::jump(double log_load) {
    mean_ = level_ = log_load;
    slope_ = lag_ = off_ = wander_ = 0;
    swings_ = 0;
    is_on_ = false;
}

// By the tracking index, which is the acceleration over the noise (Kalata 1984).
Drift::Weights Drift::weights_for(double noise) const {
    const double turn = std::numbers::pi / half_period_;  // [1 / frame]
    const bool is_lagging = square(lag_) > square(lagging) * square(noise) / (2 * lag_memory - 1);
    const double index = is_on_ && !is_lagging ? one_way * std::sqrt(wander_) * square(turn) / noise : first_index;
    const double r = (4 + index - std::sqrt(8 * index + square(index))) / 4;
    return {1 - square(r), 2 * square(1 - r)};
}

void Drift::judge(double log_load, double detail) {
    const double from_mean = log_load - mean_, detail_from_mean = detail - detail_;
    mean_ += (level_ - mean_) / memory;
    detail_ += detail_from_mean / memory;
    wander_ += (square(level_ - mean_) - wander_) / memory;
    loads_ += (square(from_mean) - loads_) / memory;
    details_ += (square(detail_from_mean) - details_) / memory;
    both_ += (from_mean * detail_from_mean - both_) / memory;
    count_swings();
    const bool is_followed = both_ < followed * std::sqrt(loads_ * details_);
    is_on_ = is_followed && (is_on_ ? wander_ > square(narrow) : wander_ > square(wide) && swings_ >= swings);
}

void Drift::count_swings() {
    if (++since_swing_ > longest_swing) swings_ = 0;
    const double from_mean = level_ - mean_;
    if (std::abs(from_mean) < side || (from_mean > 0) == is_above_) return;
    half_period_ = std::max(since_swing_, shortest_swing);
    is_above_ = !is_above_;
    ++swings_;
    since_swing_ = 0;
}

}  // namespace sfsm
