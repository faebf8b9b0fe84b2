// What drawers are handed of points: that levels find the looks that are theirs.
#include "figures/points.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "figures/way.h"
#include "pointsample/prefix_look.h"
#include "pointsample/sample.h"
#include "scene/person.h"

namespace {

struct Person {
    model::Character character = scene::make_person();
    pointsample::PointModel points;
    motion::PoseTable poses;

    explicit Person(std::size_t count) {
        points = pointsample::sample(character.mesh, pointsample::spread_poses(character, {}, 1), {.count = count});
        poses.point_count = static_cast<int>(points.size());
    }
    figures::Figure figure() const { return {&character.mesh, &poses, &points}; }
};

TEST(PointLevels, AreAtMostAnOctaveAndAtLeastAThirdApart) {
    const Person person(600);
    const std::vector<figures::Level> levels = figures::point_levels(person.figure());
    EXPECT_EQ(levels.front().count, 2u);
    EXPECT_EQ(levels.back().count, 512u);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_LE(3 * levels[i].count, 2 * 3 * levels[i - 1].count);
        EXPECT_GE(3 * levels[i].count, 4 * levels[i - 1].count);
    }
}

// An area-sampled picture gains nothing from points finer than half a pixel; a device's picks one of them.
TEST(PointLoss, NativelyIsTheSameForAllSplatsUpToHalfAPixel) {
    for (const double silhouette : {0.1, 0.5, 3.0, 60.0}) {
        const double finest = figures::native_point_outline_px(0.5, silhouette);
        EXPECT_EQ(finest, 0.5 * std::min(0.5, silhouette));
        for (const double size : {0.0, 0.1, 0.35, 0.49})
            EXPECT_EQ(figures::native_point_outline_px(size, silhouette), finest);
        for (const double size : {0.5, 0.7, 4.0, 32.0})
            EXPECT_EQ(figures::native_point_outline_px(size, silhouette), figures::point_outline_px(size, silhouette));
    }
}

TEST(PointsWorth, AreBelievedToCostWhatTheTrianglesDo) {
    EXPECT_EQ(figures::points_worth(1298, figures::by_opengl()), 649u);
    EXPECT_EQ(figures::points_worth(100'000, figures::by_opengl()), 16384u);
    EXPECT_EQ(figures::points_worth(100'000, figures::natively()), 4096u) << "more bring nothing";
    for (const std::size_t triangles : {1u, 12u, 100u, 500u}) {
        const figures::Way& way = figures::natively();
        const auto cost = [&](std::size_t points) {
            return way.pieces[sfsm::index_of(sfsm::WorkKind::point)] * static_cast<double>(points);
        };
        const std::size_t points = figures::points_worth(triangles, way);
        EXPECT_LE(cost(points), static_cast<double>(triangles));
        EXPECT_GT(cost(points + 1), static_cast<double>(triangles));
    }
}

TEST(PointLevels, BeginWhereTheirLooksAre) {
    const Person person(600);
    const std::vector<figures::PointLook> looks = figures::point_looks(person.figure());
    for (const figures::Level& level : figures::point_levels(person.figure())) {
        ASSERT_LE(level.first + level.count, looks.size());
        const bool averaged = level.count <= 32;
        const std::vector<pointsample::PrefixLook> means = pointsample::prefix_looks(person.points, level.count);
        for (std::uint32_t i = 0; i < level.count; ++i) {
            const figures::PointLook& look = looks[level.first + i];
            const glm::u8vec3 color = averaged ? means[i].color : person.points.colors[i];
            EXPECT_EQ(look.point, i) << level.count << " points";
            EXPECT_EQ(look.color, color) << level.count << " points";
            EXPECT_EQ(look.two_sided, level.count <= 8);
            if (averaged) {
                EXPECT_EQ(look.shares, means[i].shares);
            }
        }
    }
}

}  // namespace
