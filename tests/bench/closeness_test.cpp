#include "tests/bench/closeness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/pointsample/shapes.h"

namespace {

TEST(Closeness, TheGridFindsTheNearestPoint) {
    const model::Mesh sphere = tests::make_sphere(2, 3);
    const std::vector<glm::vec3> spots = bench::random_spots(sphere, sphere.positions, 2000, 1).positions;
    for (const std::size_t count : {1u, 2u, 17u, 500u}) {
        const std::vector<glm::vec3> points = bench::random_spots(sphere, sphere.positions, count, 2).positions;
        double largest = 0, sum = 0;
        for (const glm::vec3& spot : spots) {
            float nearest = std::numeric_limits<float>::max();
            for (const glm::vec3& point : points) nearest = std::min(nearest, glm::distance(spot, point));
            largest = std::max<double>(largest, nearest);
            sum += nearest;
        }
        const bench::Covering covering = bench::covering_of(spots, points);
        EXPECT_EQ(covering.largest, largest);
        EXPECT_NEAR(covering.mean, sum / 2000, 1e-9);
        EXPECT_LE(covering.percentile_99, largest);
    }
}

TEST(Closeness, DistancesToACubeAreThoseToItsFacesEdgesAndCorners) {
    const model::Mesh cube = tests::make_cube();
    const auto distance = [&](const glm::vec3& point) {
        return bench::mean_distance_to_surface({&point, 1}, cube, cube.positions);
    };
    EXPECT_NEAR(distance({0.3f, 0.4f, 1.5f}), 0.5, 1e-6);
    EXPECT_NEAR(distance({0.5f, 0.5f, 0.4f}), 0.4, 1e-6);
    EXPECT_NEAR(distance({-3, 5, 0.25f}), 5, 1e-6);
    EXPECT_NEAR(distance({2, 2, 2}), std::sqrt(3.0), 1e-6);
}

TEST(Closeness, RandomPointsAreOnTheSurfaceAndAreaUniform) {
    const model::Mesh cube = tests::make_cube();
    const std::vector<glm::vec3> spots = bench::random_spots(cube, cube.positions, 6000, 3).positions;
    EXPECT_NEAR(bench::mean_distance_to_surface(spots, cube, cube.positions), 0, 1e-7);
    const auto top = std::count_if(spots.begin(), spots.end(), [](const glm::vec3& spot) { return spot.y > 0.9999f; });
    constexpr double expected = 1000, five_deviations = 5 * 29;
    EXPECT_NEAR(static_cast<double>(top), expected, five_deviations);
}

}  // namespace
