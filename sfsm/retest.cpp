#include "sfsm/retest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double least_surprise = 0.05;  // [ln] and
constexpr double sure = 4;               // [standard errors] below what was believed

}  // namespace

void Retest::begin_anew() {
    wait_ = patience_ = first_wait;
    left_ = 0;
}

bool Retest::step(bool is_due, std::int64_t shifts) {
    if (!is_due || shifts != shifts_) begin_anew();
    shifts_ = shifts;
    if (!is_due) return false;
    if (left_ > 0) {
        --left_;
        return true;
    }
    if (--wait_ > 0) return false;
    wait_ = patience_ = std::min(2 * patience_, longest_wait_);
    left_ = frames - 1;
    heard_ = 0;
    return true;
}

bool Retest::has_disproved(double residual, double noise) {
    if (heard_ == frames) return false;
    residuals_[static_cast<std::size_t>(heard_++)] = residual;
    if (heard_ < frames) return false;
    std::sort(residuals_.begin(), residuals_.end());
    return residuals_[frames / 2] < -std::max(least_surprise, sure * noise / std::sqrt(frames));
}

}  // namespace sfsm
