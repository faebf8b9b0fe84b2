#include "pointsample/opening.h"

#include <algorithm>
#include <limits>

#include "pointsample/farthest_tree.h"
#include "sfsm/random.h"

namespace pointsample {
namespace {

using sfsm::stream;
using sfsm::unit;

constexpr std::size_t most_spots = 512;
constexpr float opposed_squared = opposed_factor * opposed_factor;

float squared_distance(const Place& a, const Place& b) {
    const glm::vec3 apart = a.position - b.position;
    return glm::dot(apart, apart) * (glm::dot(a.normal, b.normal) < opposed_cosine ? opposed_squared : 1.0f);
}

// Evenly along the candidates' line, so each stands for as much of the surface.
std::vector<std::uint32_t> spots_of(const Candidates& candidates, std::uint64_t seed) {
    const std::size_t count = std::min(candidates.count, most_spots);
    const double shift = unit(stream(seed, std::numeric_limits<std::uint64_t>::max()));  // no candidate's
    std::vector<std::uint32_t> spots;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = (static_cast<double>(i) + shift) / static_cast<double>(count);
        spots.push_back(static_cast<std::uint32_t>(at * static_cast<double>(candidates.count)));
    }
    return spots;
}

}  // namespace

std::vector<std::uint32_t> opening(const Candidates& candidates, std::size_t count, float least_apart,
                                   std::uint64_t seed) {
    const std::vector<std::uint32_t> spots = spots_of(candidates, seed);
    const std::size_t n = spots.size();
    std::vector<float> distance(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            distance[i * n + j] = squared_distance(candidates.place(spots[i]), candidates.place(spots[j]));
    }
    std::vector<float> nearest(n, std::numeric_limits<float>::max());
    std::vector<std::uint32_t> points;
    while (points.size() < std::min(count, n)) {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < n; ++i) {
            const float key = nearest[i] * candidates.stretch(spots[i]);
            if (key <= 0 || key < least_apart * least_apart) continue;  // a point, or too near to one
            double sum = 0;
            for (std::size_t j = 0; j < n; ++j) sum += std::min(nearest[j], distance[i * n + j]);
            if (sum < least) least = sum, best = i;
        }
        if (least == std::numeric_limits<double>::infinity()) break;
        points.push_back(spots[best]);
        for (std::size_t j = 0; j < n; ++j) nearest[j] = std::min(nearest[j], distance[best * n + j]);
    }
    return points;
}

}  // namespace pointsample
