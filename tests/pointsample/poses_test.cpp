// Models that are to look right in several poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pointsample/sample.h"
#include "pointsample/surface.h"
#include "tests/pointsample/shapes.h"

namespace {

using pointsample::Order;
using pointsample::PointModel;
using pointsample::PosedMesh;

// Each triangle with vertices of its own, so that it can be stretched by itself.
model::Mesh apart(const model::Mesh& mesh) {
    model::Mesh out;
    for (const std::uint32_t i : mesh.indices) {
        out.indices.push_back(static_cast<std::uint32_t>(out.positions.size()));
        out.positions.push_back(mesh.positions[i]);
        out.normals.push_back(mesh.normals[i]);
    }
    tests::fill_looks(out);
    return out;
}

std::vector<PosedMesh> poses_of(const model::Mesh& mesh, std::size_t count) {
    std::vector<PosedMesh> poses;
    while (poses.size() < count) poses.push_back({mesh.positions, mesh.normals});
    return poses;
}

bool is_upper(const model::Mesh& mesh, std::size_t triangle) {
    const auto y = [&](std::size_t k) { return mesh.positions[mesh.indices[3 * triangle + k]].y; };
    return y(0) + y(1) + y(2) > 0;
}

TEST(Poses, AHalfThatStretchesToTwiceGetsTwoThirds) {
    const model::Mesh sphere = apart(tests::make_sphere(1, 4));
    std::vector<PosedMesh> poses = poses_of(sphere, 2);
    for (std::size_t i = 0; i < sphere.indices.size(); ++i)
        if (is_upper(sphere, i / 3)) poses[1].positions[i] *= std::sqrt(2.0f);
    for (const Order order : {Order::progressive, Order::even, Order::uniform}) {
        const PointModel model = pointsample::sample(sphere, poses, {8000, 1, order, false});
        double upper = 0;
        for (std::size_t n = 0; n < model.size(); ++n) {
            upper += is_upper(sphere, model.surface[n].triangle);
            const double size = static_cast<double>(n + 1), due = size * 2 / 3;
            // An even order is off by a part of what lies along the equator, a random one by its deviation.
            const double slack = order == Order::uniform ? 4 * std::sqrt(size * 2 / 9) : std::sqrt(size);
            ASSERT_NEAR(upper, due, 3 + slack) << n;
        }
        EXPECT_NEAR(upper / 8000, 2.0 / 3, 0.02);
        EXPECT_NEAR(model.area, 4 * std::numbers::pi, 0.1);  // the first pose's
    }
}

TEST(Poses, ShrinkingTakesNoPointsAway) {
    const model::Mesh sphere = apart(tests::make_sphere(1, 3));
    std::vector<PosedMesh> poses = poses_of(sphere, 2);
    for (glm::vec3& p : poses[1].positions) p *= 0.1f;
    const pointsample::Surface surface(sphere.indices, poses);
    for (std::size_t i = 0; i < surface.triangle_count(); ++i) ASSERT_EQ(surface.stretch(i), 1.0f);
}

TEST(Poses, VerticesThatAreNowhereStretchNothing) {
    const model::Mesh sphere = tests::make_sphere(1, 3);
    std::vector<PosedMesh> poses = poses_of(sphere, 2);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (glm::vec3& p : poses[1].positions) p = glm::vec3(nan);
    const PointModel model = pointsample::sample(sphere, poses, {1000, 1, Order::progressive, true});
    EXPECT_EQ(model.size(), 1000u);
    for (const pointsample::Coverage& at : model.coverage) EXPECT_TRUE(std::isfinite(at.radius));
}

// A ball in a shell: hidden, unless it comes out in some pose.
TEST(Poses, WhatIsSeenInOnePoseStays) {
    model::Mesh nested = tests::make_sphere(1, 4);
    const std::size_t shell = nested.triangle_count(), shell_vertices = nested.vertex_count();
    tests::append(nested, tests::make_sphere(0.5f, 3));
    std::vector<PosedMesh> poses = poses_of(nested, 3);
    for (std::size_t i = shell_vertices; i < nested.vertex_count(); ++i) poses[2].positions[i].x += 5;
    for (const Order order : {Order::progressive, Order::even, Order::uniform}) {
        const auto inner_points = [&](std::size_t pose_count) {
            const PointModel model =
                pointsample::sample(nested, std::span(poses).first(pose_count), {4000, 1, order, true});
            EXPECT_EQ(model.size(), 4000u);
            EXPECT_NEAR(static_cast<double>(model.hidden_removed), pose_count < 3 ? 1000 : 0, 150);
            return std::count_if(model.surface.begin(), model.surface.end(),
                                 [&](const motion::SurfacePoint& p) { return p.triangle >= shell; });
        };
        EXPECT_EQ(inner_points(1), 0);
        EXPECT_EQ(inner_points(2), 0);
        EXPECT_NEAR(static_cast<double>(inner_points(3)), 800, 100);  // a fifth of the area
    }
}

// What a model says of itself, bit by bit.
void expect_same_points(const PointModel& a, const PointModel& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a.surface[i].triangle, b.surface[i].triangle) << i;
        ASSERT_EQ(a.surface[i].u, b.surface[i].u) << i;
        ASSERT_EQ(a.surface[i].v, b.surface[i].v) << i;
        ASSERT_EQ(a.normals[i], b.normals[i]) << i;
    }
    EXPECT_EQ(a.hidden_removed, b.hidden_removed);
}

// A sphere whose upper half is stretched in one pose and its lower in another, with a ball in it that looks out.
std::vector<PosedMesh> three_poses(const model::Mesh& mesh) {
    std::vector<PosedMesh> poses = poses_of(mesh, 3);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i].y > 0) poses[1].positions[i].x *= 2;
        if (mesh.positions[i].y < 0) poses[2].positions[i].z *= 3;
    }
    return poses;
}

TEST(Poses, OnlyTheFirstIsAboveTheOthers) {
    model::Mesh mesh = apart(tests::make_sphere(1, 3));
    tests::append(mesh, apart(tests::make_sphere(0.9f, 2)));
    const std::vector<PosedMesh> poses = three_poses(mesh);
    for (const Order order : {Order::progressive, Order::even, Order::uniform}) {
        const auto sample = [&](std::vector<std::size_t> which) {
            std::vector<PosedMesh> chosen;
            for (const std::size_t pose : which) chosen.push_back(poses[pose]);
            return pointsample::sample(mesh, chosen, {800, 1, order, order == Order::progressive});
        };
        const PointModel model = sample({0, 1, 2});
        for (const std::vector<std::size_t>& which : {std::vector<std::size_t>{0, 2, 1}, {0, 2, 2, 1, 0}}) {
            const PointModel other = sample(which);
            ASSERT_NO_FATAL_FAILURE(expect_same_points(model, other));
            EXPECT_EQ(model.positions, other.positions);
            EXPECT_EQ(model.spacing, other.spacing);
            ASSERT_EQ(model.coverage.size(), other.coverage.size());
            for (std::size_t i = 0; i < model.coverage.size(); ++i)
                EXPECT_EQ(model.coverage[i].radius, other.coverage[i].radius) << i;
        }
        // Without either there are fewer points where it stretches.
        EXPECT_NE(sample({0, 1}).positions, model.positions);
        EXPECT_NE(sample({0, 2}).positions, model.positions);
    }
}

// By a power of two, so that no float is rounded otherwise.
TEST(Poses, ALargerSurfaceHasTheSamePointsFartherApart) {
    const model::Mesh mesh = apart(tests::make_sphere(1, 3));
    const std::vector<PosedMesh> poses = three_poses(mesh);
    for (const Order order : {Order::progressive, Order::even, Order::uniform}) {
        const PointModel model = pointsample::sample(mesh, poses, {800, 1, order, true});
        for (const float size : {1.0f / 16, 64.0f}) {
            std::vector<PosedMesh> larger = poses;
            for (PosedMesh& pose : larger)
                for (glm::vec3& position : pose.positions) position *= size;
            const PointModel other = pointsample::sample(mesh, larger, {800, 1, order, true});
            ASSERT_NO_FATAL_FAILURE(expect_same_points(model, other));
            EXPECT_EQ(other.area, model.area * size * size);
            for (std::size_t i = 0; i < model.size(); ++i) {
                ASSERT_EQ(other.positions[i], size * model.positions[i]) << i;
                ASSERT_FLOAT_EQ(other.spacing[i], size * model.spacing[i]) << i;
            }
            for (std::size_t i = 0; i < model.coverage.size(); ++i)
                ASSERT_FLOAT_EQ(other.coverage[i].radius, size * model.coverage[i].radius) << i;
        }
    }
}

// What is stretched to four times its area has its points half as far apart in the first pose, in any order.
TEST(Poses, APointsSpacingIsThatWhereItIsStretchedMost) {
    const model::Mesh sphere = apart(tests::make_sphere(1, 4));
    std::vector<PosedMesh> poses = poses_of(sphere, 2);
    for (std::size_t i = 0; i < sphere.indices.size(); ++i)
        if (is_upper(sphere, i / 3)) poses[1].positions[i] *= 2.0f;
    for (const auto& [order, reached] : {std::pair{Order::progressive, 0.64}, {Order::even, 0.72}}) {
        constexpr std::size_t count = 3000;
        const PointModel model = pointsample::sample(sphere, poses, {count, 1, order, false});
        // Of the densest packing of so many on both halves together, the upper of four times the area.
        const double area = 2 * std::numbers::pi * (1 + 4);
        const double densest = 2 * std::sqrt(area / (2 * std::numbers::sqrt3 * count));
        double least[2] = {9, 9};  // lower, upper, in the second pose
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                const glm::vec3 a = model.positions[i], b = model.positions[k];
                if (std::abs(a.y) < 0.1f || std::abs(b.y) < 0.1f || (a.y > 0) != (b.y > 0)) continue;  // the seam
                const bool upper = a.y > 0;
                least[upper] = std::min(least[upper], static_cast<double>(glm::distance(a, b) * (upper ? 2.0f : 1.0f)));
            }
        }
        EXPECT_GT(least[0], reached * densest);
        EXPECT_GT(least[1], reached * densest);
        EXPECT_NEAR(static_cast<double>(model.spacing.back()), std::min(least[0], least[1]), 0.1 * densest);
    }
}

}  // namespace
