// The first points of a progressive order. The farthest ones are extremities: a person of a dozen of them, each a
// square of many pixels, would be all hair and hands, and stick out. Until there are enough to follow a shape, points
// stand for the surface around them instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pointsample/candidates.h"

namespace pointsample {

inline constexpr std::size_t opening_size = 16;

// Greedy medians: each next candidate is the one that most lowers the mean squared distance of the surface to its
// nearest point; opposed faces count as twice as far.
//   count        different candidates come back; fewer if there is no room for more, but one at least
//   least_apart  no two have a key (farthest_tree.h) below its square, so that longer prefixes are even
//   seed         shifts which 512 candidates stand for the surface
std::vector<std::uint32_t> opening(const Candidates& candidates, std::size_t count, float least_apart,
                                   std::uint64_t seed);

}  // namespace pointsample
