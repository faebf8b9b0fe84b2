#include "motion/schedule.h"

#include <cassert>

namespace motion {

int update_period(float depth, float motion_distance, float theta) {
    const float frames = (depth - motion_distance) * theta;
    // Negated, so that NaN (an infinite depth less an infinite distance) moves every frame.
    if (!(frames >= 1.0f)) return 1;
    return frames >= static_cast<float>(max_period) ? max_period : static_cast<int>(frames);
}

std::int64_t due_tick(std::int64_t tick, int period, std::uint32_t stagger) {
    assert(period >= 1);
    const std::int64_t phase = stagger % static_cast<std::uint32_t>(period);
    const std::int64_t since = (tick - phase) % period;  // in (-period, period): rounds to zero before tick 0
    return tick - (since < 0 ? since + period : since);
}

}  // namespace motion
