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

// How far the farthest spot is, for each mark.
//   spots         what stands for the surface. A measured radius has half the diagonal of a spot's square added, for
//   what
//                 lies between spots. May be empty if no pose is measured: `first_radius` is given, and there is one
//                 pose.
//   marks         rising; one element of the result each
//   first_radius  [units] of the first pose, an element a mark, if it is known; empty: it is measured
// Marks beyond most_covering_points are not measured: the first pose's radius falls there as that of independent
// points, sqrt(log n / n), and the worst pose's stays as many times as large. Poses are measured in parallel, 24 MB
// each.
std::vector<Coverage> measure_coverage(const Surface& surface, const Spots& spots,
                                       std::span<const motion::SurfacePoint> points,
                                       std::span<const std::uint32_t> marks, std::span<const float> first_radius);

}  // namespace pointsample
