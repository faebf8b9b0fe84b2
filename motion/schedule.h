// Who moves this frame: equation 1 of Lyu et al. 2018, staggered. Time is an integer tick; any frame can be
// computed without the ones before it.
#pragma once

#include <cstdint>

namespace motion {

inline constexpr int ticks_per_second = 60;

// Eq. 1's constant [1/m], in [0.05, 0.1].
inline constexpr float default_theta = 0.075f;

// Update period f [frames] >= 1 of a person at view depth `depth` [m], non-decreasing in depth:
// 1 up to D, then (depth - D) * theta rounded down, at least 1 and at most `max_period`.
int update_period(float depth, float motion_distance, float theta = default_theta);
inline constexpr int max_period = 32;

// The latest tick <= `tick` at which a person with this `stagger` (any value, a hash of the person) is due when
// moving every `period` ticks: due ticks are spread evenly over the people of equal period.
std::int64_t due_tick(std::int64_t tick, int period, std::uint32_t stagger);

}  // namespace motion
