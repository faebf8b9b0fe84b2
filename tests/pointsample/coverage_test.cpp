#include "pointsample/coverage.h"

#include <gtest/gtest.h>

#include "pointsample/sample.h"
#include "tests/pointsample/evaluate.h"
#include "tests/pointsample/surfaces.h"

namespace {

using pointsample::Order;
using pointsample::PointModel;

// The same mesh with a pose's vertices.
model::Mesh in_pose(model::Mesh mesh, const pointsample::PosedMesh& pose) {
    mesh.positions = pose.positions;
    mesh.normals = pose.normals;
    return mesh;
}

// Where the model's points are in a pose.
tests::Sample sample_in(const PointModel& model, const model::Mesh& posed) {
    PointModel moved = model;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const std::uint32_t triangle = model.surface[i].triangle;
        const float u = model.surface[i].u, v = model.surface[i].v;
        const auto corner = [&](std::size_t k) { return posed.positions[posed.indices[3 * triangle + k]]; };
        moved.positions[i] = corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0));
    }
    return tests::sample_of(moved, posed);
}

// The largest distance of any of so many spots from the first n points [units].
double covering_radius(const tests::Sample& points, std::size_t n, const model::Mesh& posed) {
    const double area = tests::area_of(posed);
    return tests::cover(tests::dense(posed, 100000), points, n, area, tests::Opposed::doubled).max *
           tests::densest(area, n);
}

std::vector<pointsample::PosedMesh> two_poses(const model::Mesh& mesh) {
    std::vector<pointsample::PosedMesh> poses(2, {mesh.positions, mesh.normals});
    for (glm::vec3& p : poses[1].positions) p.x *= p.x > 0 ? 2.5f : 1.0f;
    return poses;
}

TEST(Coverage, NoSpotInAnyPoseIsFartherThanItSays) {
    constexpr double between_spots = 1.01;  // for what lies between the spots that were looked at
    constexpr double pessimism = 1.35;      // the largest of distances is rounded up by half a candidate's cell
    const model::Mesh mesh = tests::make_bumpy();
    const std::vector<pointsample::PosedMesh> poses = two_poses(mesh);
    for (const Order order : {Order::progressive, Order::even, Order::uniform}) {
        const PointModel model = pointsample::sample(mesh, poses, {5000, 1, order, false});
        ASSERT_EQ(model.coverage.back().points, model.size());
        for (std::size_t i = 0; i < model.coverage.size(); i += 3) {
            const auto [n, radius] = model.coverage[i];
            double farthest = 0;
            for (const pointsample::PosedMesh& pose : poses) {
                const model::Mesh posed = in_pose(mesh, pose);
                farthest = std::max(farthest, covering_radius(sample_in(model, posed), n, posed));
            }
            EXPECT_LE(farthest, radius * between_spots) << n << " points";
            EXPECT_LE(radius, farthest * pessimism) << n << " points";
        }
    }
}

TEST(Coverage, FallsAndEndsWithAllPoints) {
    const model::Mesh mesh = tests::make_cube_and_plate();
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    for (const std::size_t count : {1u, 2u, 5u, 1000u, 40000u}) {
        for (const Order order : {Order::progressive, Order::uniform}) {
            const PointModel model = pointsample::sample(mesh, {&rest, 1}, {count, 1, order, false});
            ASSERT_EQ(model.coverage.front().points, 1u);
            EXPECT_EQ(model.coverage.back().points, count);
            for (std::size_t i = 1; i < model.coverage.size(); ++i) {
                EXPECT_GT(model.coverage[i].points, model.coverage[i - 1].points);
                EXPECT_LE(model.coverage[i].radius, model.coverage[i - 1].radius);
            }
        }
    }
}

// Beyond what is measured it is reckoned from independent points' law.
TEST(Coverage, OfManyIndependentPointsIsNearlyWhatTheyHave) {
    constexpr std::size_t count = 160'000;
    constexpr double scatter = 1.25;  // the farthest of all spots differs from sample to sample
    const model::Mesh mesh = tests::make_ball();
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const PointModel model = pointsample::sample(mesh, {&rest, 1}, {count, 1, Order::uniform, false});
    const double found = covering_radius(tests::sample_of(model, mesh), count, mesh);
    EXPECT_LT(static_cast<double>(model.coverage.back().radius), found * scatter);
    EXPECT_GT(static_cast<double>(model.coverage.back().radius), found / scatter);
}

TEST(Coverage, MarksAreHalfOctaves) {
    using Marks = std::vector<std::uint32_t>;
    EXPECT_EQ(pointsample::coverage_marks(1), Marks({1}));
    EXPECT_EQ(pointsample::coverage_marks(3), Marks({1, 2, 3}));
    EXPECT_EQ(pointsample::coverage_marks(13), Marks({1, 2, 3, 4, 6, 8, 12, 13}));
    EXPECT_EQ(pointsample::coverage_marks(16), Marks({1, 2, 3, 4, 6, 8, 12, 16}));
}

PointModel model_covering(std::vector<pointsample::Coverage> coverage) {
    PointModel model;
    model.positions.resize(coverage.back().points);
    model.coverage = std::move(coverage);
    return model;
}

TEST(HoleFreePoints, AreWhereTheSquareCoversTheRadius) {
    const PointModel model = model_covering({{1, 1.0f}, {2, 0.7f}, {4, 0.5f}, {16, 0.25f}});
    EXPECT_EQ(model.hole_free_points(10, 20), 1u);  // radius 1 is 10 px, half a square's side
    EXPECT_EQ(model.hole_free_points(10, 14), 2u);
    EXPECT_EQ(model.hole_free_points(10, 10), 4u);
    EXPECT_EQ(model.hole_free_points(10, 5), 16u);
    EXPECT_EQ(model.hole_free_points(10, 4.9f), 17u);  // all together leave a hole
    // Between 4 and 16 points the radius falls as 1 / sqrt(n): 0.35 takes 4 (0.5 / 0.35)^2 = 8.2 points.
    EXPECT_EQ(model.hole_free_points(10, 7), 9u);
    EXPECT_EQ(model.hole_free_points(1000, 700), 9u);
}

TEST(HoleFreePoints, RiseWithTheSizeAndFallWithTheSplat) {
    const model::Mesh mesh = tests::make_bumpy();
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const PointModel model = pointsample::sample(mesh, {&rest, 1}, {2000, 1, Order::progressive, false});
    std::size_t last = 1;
    for (float pixels = 0.5f; pixels < 1000; pixels *= 1.07f) {
        const std::size_t points = model.hole_free_points(pixels, 3);
        EXPECT_GE(points, last) << pixels;
        EXPECT_LE(model.hole_free_points(pixels, 4), points) << pixels;
        last = points;
    }
    EXPECT_EQ(last, model.size() + 1);
}

}  // namespace
