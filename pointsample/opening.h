// The points a progressive order opens with. The farthest are extremities: a person drawn by a dozen of them, each a
// square of many pixels, would be all hair and hands, and stick out. Until there are enough to follow a shape, points
// stand for the surface around them instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pointsample/candidates.h"

namespace pointsample {

inline constexpr std::size_t opening_size = 16;

// `count` different candidates, each of which lowers the mean squared distance of the surface to its nearest point
// most, given those before it (greedy medians); opposed faces count as twice as far. Seen by 512 candidates, which a
// seed shifts. No two have a key (farthest_tree.h) below `least_apart`^2, so that longer prefixes are even; fewer than
// `count` where there is no room for more, but one at least.
std::vector<std::uint32_t> opening(const Candidates& candidates, std::size_t count, float least_apart,
                                   std::uint64_t seed);

}  // namespace pointsample
