#include "pointsample/coverage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "pointsample/candidates.h"
#include "pointsample/farthest_tree.h"
#include "pointsample/prefix_ladder.h"

namespace pointsample {
namespace {

Place scaled_place(const Surface& surface, const motion::SurfacePoint& point, std::size_t pose) {
    const Place place = place_of(point, surface.indices(), surface.poses()[pose]);
    return {surface.scaled(place.position), place.normal};
}

// At the marks up to most_covering_points: the largest distance of a spot in the pose [units]. Nobody sees what is
// nowhere.
std::vector<double> radii_in(const Surface& surface, const Spots& spots, std::span<const motion::SurfacePoint> points,
                             std::span<const std::uint32_t> marks, std::size_t pose) {
    Candidates candidates;
    candidates.reserve(spots.places.size());
    for (const motion::SurfacePoint& spot : spots.places) {
        const Place place = scaled_place(surface, spot, pose);
        if (std::isfinite(glm::dot(place.position, place.position))) candidates.append(place, 1.0f, spot);
    }
    if (candidates.count == 0) return std::vector<double>(marks.size(), 0.0);
    candidates.pad();
    FarthestTree<false> tree(candidates);
    const double between = std::sqrt(0.5 * spots.area);
    std::vector<double> radii;
    for (std::size_t i = 0; i < std::min(points.size(), most_covering_points); ++i) {
        tree.cover(scaled_place(surface, points[i], pose));
        if (i + 1 == marks[radii.size()])
            radii.push_back(surface.unit() * std::sqrt(static_cast<double>(tree.farthest())) + between);
    }
    return radii;
}

// What the first pose has at all marks, from what it has at some.
void extend(std::vector<double>& radii, std::span<const std::uint32_t> marks) {
    const std::size_t known = radii.size();
    const auto shape = [&](std::size_t i) {
        return std::sqrt(std::log(static_cast<double>(marks[i])) / static_cast<double>(marks[i]));
    };
    for (std::size_t i = known; i < marks.size(); ++i) radii.push_back(radii[known - 1] * shape(i) / shape(known - 1));
}

}  // namespace

std::vector<std::uint32_t> coverage_marks(std::size_t count) {
    std::vector<std::uint32_t> marks;
    for (std::uint32_t rung = 0; points_of_rung(rung) < count; ++rung) marks.push_back(points_of_rung(rung));
    marks.push_back(static_cast<std::uint32_t>(count));
    return marks;
}

std::vector<Coverage> measure_coverage(const Surface& surface, const Spots& spots,
                                       std::span<const motion::SurfacePoint> points,
                                       std::span<const std::uint32_t> marks, std::span<const float> first_radius) {
    assert(!points.empty() && (first_radius.empty() || first_radius.size() == marks.size()));
    std::vector<std::vector<double>> radii(surface.poses().size());
    tbb::parallel_for(std::size_t{0}, radii.size(), [&](std::size_t pose) {
        if (pose > 0 || first_radius.empty()) radii[pose] = radii_in(surface, spots, points, marks, pose);
    });
    std::vector<double>& first = radii.front();
    if (first_radius.empty())
        extend(first, marks);
    else
        first.assign(first_radius.begin(), first_radius.end());

    double excess = 1;  // how many times the first pose's the worst is
    double least = std::numeric_limits<double>::infinity();
    std::vector<Coverage> coverage;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] <= most_covering_points) {
            double worst = first[i];
            for (const std::vector<double>& pose : radii) worst = std::max(worst, pose[i]);
            excess = worst / first[i];
        }
        least = std::min(least, excess * first[i]);
        coverage.push_back({marks[i], static_cast<float>(least)});
    }
    return coverage;
}

}  // namespace pointsample
