// One even sample of a fixed size: farthest-point optimisation (Schloemer, Heck, Deussen 2011). Points are taken back
// one by one and put down again where the largest hole is; the smallest distance never falls.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "pointsample/candidates.h"

namespace pointsample {

// Moves `points` (of farthest_order) until no candidate among them has a key below `spacing`^2 (farthest_tree.h), or
// sixteen rounds are over: three or four with 24 candidates a point and a spacing of 0.76 d_max. `progress` gets rising
// fractions. Time is O(n log n) a round, about 10 microseconds a point.
std::vector<std::uint32_t> make_even(Candidates& candidates, std::vector<std::uint32_t> points, float spacing,
                                     const std::function<void(double)>& progress = {});

}  // namespace pointsample
