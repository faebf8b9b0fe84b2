// How far a surface's spots are from the nearest of the first n points, in whichever pose that is worst.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pointsample/point_model.h"
#include "pointsample/surface.h"

namespace pointsample {

// The numbers of points that coverage is given for: 1, 2, 3, 4, 6, 8, 12, 16 ... below `count`, and `count`.
std::vector<std::uint32_t> coverage_marks(std::size_t count);

// Visible places that stand for the surface, in the order of its line (candidates.h).
struct Spots {
    std::vector<motion::SurfacePoint> places;
    double area = 0;  // that each stands for [units^2]
};

// At most this many spots are looked at, and this many points, in a pose: 0.1 s.
inline constexpr std::size_t most_spots = 524288, most_covering_points = 32768;

// One element a mark. `first_radius`, one element a mark [units]: the first pose's, where it is known already; empty:
// it is measured. Beyond most_covering_points, what other poses add to the first's stays in proportion, and a measured
// first falls as that of independent points does, sqrt(log n / n). What is measured has half the diagonal of a spot's
// square added, for the surface between spots; with a known first pose and no other, there need be none. Poses in
// parallel, 24 MB each at most.
std::vector<Coverage> measure_coverage(const Surface& surface, const Spots& spots,
                                       std::span<const motion::SurfacePoint> points,
                                       std::span<const std::uint32_t> marks, std::span<const float> first_radius);

}  // namespace pointsample
