// Surfaces that are partly transparent, and hulls that are seen through from outside.
#include "model/cutout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "model/sides.h"
#include "pointsample/hidden.h"
#include "pointsample/sample.h"
#include "tests/pointsample/shapes.h"

namespace {

using pointsample::Order;
using pointsample::PointModel;
using pointsample::PosedMesh;

constexpr int side = 64;        // [texels]
constexpr double radius = 0.4;  // of the disk that there is of a leaf, whose side is 1
constexpr double disk = std::numbers::pi * radius * radius;

// The distance of a texel's middle from the texture's.
double off_middle(int x, int y) {
    return std::hypot((x + 0.5) / side - 0.5, (y + 0.5) / side - 0.5);
}

// A square [0, 1]^2 at height z that faces +z, of which there is a disk.
model::Mesh make_leaf(float z = 0) {
    model::Mesh mesh;
    for (const glm::vec2 at : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        mesh.positions.emplace_back(at, z);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.uvs.push_back(at);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    tests::fill_looks(mesh);
    model::Texture texture{side, side, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) texture.texels.emplace_back(20, 200, 30, off_middle(x, y) < radius ? 255 : 0);
    mesh.textures.push_back(texture);
    mesh.materials[0].texture = 0;
    mesh.materials[0].alpha_cutoff = 0.5f;
    return mesh;
}

PointModel sample(const model::Mesh& mesh, std::size_t count, Order order, bool visible_only) {
    const PosedMesh rest{mesh.positions, mesh.normals};
    return pointsample::sample(mesh, {&rest, 1}, {count, 1, order, visible_only});
}

TEST(Cutouts, ALeafHasItsPointsAndItsAreaWhereItIs) {
    constexpr double texel = 1.0 / side;
    const model::Mesh leaf = make_leaf();
    for (const Order order : {Order::progressive, Order::even, Order::uniform}) {
        for (const bool visible_only : {false, true}) {
            const PointModel model = sample(leaf, 3000, order, visible_only);
            EXPECT_EQ(model.size(), 3000u);
            EXPECT_EQ(model.hidden_removed, 0u);
            EXPECT_NEAR(static_cast<double>(model.area), disk, 0.01 * disk);
            std::size_t inner = 0;
            for (const glm::vec3& at : model.positions) {
                const double off = std::hypot(static_cast<double>(at.x) - 0.5, static_cast<double>(at.y) - 0.5);
                ASSERT_LT(off, radius + texel);
                inner += off < radius * std::numbers::sqrt2 / 2;
            }
            EXPECT_NEAR(static_cast<double>(inner) / 3000, 0.5, 0.03);  // half of the area
        }
    }
}

TEST(Cutouts, WithoutACutoffTransparentTexelsAreASurface) {
    model::Mesh leaf = make_leaf();
    leaf.materials[0].alpha_cutoff = 0;
    EXPECT_FLOAT_EQ(sample(leaf, 500, Order::progressive, true).area, 1.0f);
}

TEST(Cutouts, OneSeesThroughThem) {
    model::Mesh box = tests::make_cube();  // closed, but for a lid with a hole
    model::Mesh mesh = make_leaf(1.01f);
    for (glm::u8vec4& texel : mesh.textures[0].texels) texel.a = static_cast<std::uint8_t>(255 - texel.a);
    for (glm::vec3& position : mesh.positions)
        position = glm::vec3(8.0f * (glm::vec2(position) - 0.5f) + 0.5f, position.z);
    const std::size_t leaf_triangles = mesh.triangle_count();
    tests::append(mesh, box);
    mesh.materials.resize(2);
    mesh.materials[1] = {};
    for (std::size_t v = 4; v < mesh.vertex_count(); ++v) mesh.material_ids[v] = 1;
    const PosedMesh rest{mesh.positions, mesh.normals};
    const std::vector<PosedMesh> poses{rest};
    const pointsample::Surface surface(mesh.indices, poses);
    std::vector<motion::SurfacePoint> on_top;
    for (std::uint32_t t = static_cast<std::uint32_t>(leaf_triangles); t < mesh.triangle_count(); ++t)
        if (mesh.normals[mesh.indices[3 * t]].z > 0) on_top.push_back({t, 0.3f, 0.3f});
    ASSERT_FALSE(on_top.empty());
    EXPECT_TRUE(std::ranges::all_of(pointsample::HiddenTest(surface, mesh).visible(on_top), std::identity()));
    mesh.materials[0].alpha_cutoff = 0;
    EXPECT_TRUE(std::ranges::none_of(pointsample::HiddenTest(surface, mesh).visible(on_top), std::identity()));
}

TEST(Cutouts, WhatIsWhollyTransparentIsRefused) {
    model::Mesh leaf = make_leaf();
    for (glm::u8vec4& texel : leaf.textures[0].texels) texel.a = 0;
    for (const Order order : {Order::progressive, Order::even, Order::uniform})
        EXPECT_THROW(sample(leaf, 5000, order, true), std::runtime_error);
}

// A ball in a slightly larger one that faces inward.
model::Mesh ball_in_hull() {
    model::Mesh mesh = tests::make_sphere(1, 3), hull = tests::make_sphere(1.05f, 3);
    for (std::size_t i = 0; i < hull.indices.size(); i += 3) std::swap(hull.indices[i], hull.indices[i + 1]);
    for (glm::vec3& normal : hull.normals) normal = -normal;
    const std::size_t ball = mesh.vertex_count();
    tests::append(mesh, hull);
    mesh.materials.resize(2);
    mesh.materials[1].sampler.nearest = true;  // no two alike
    for (std::size_t v = ball; v < mesh.vertex_count(); ++v) mesh.material_ids[v] = 1;
    return mesh;
}

TEST(Hulls, HideNothingOfWhatTheyAreAround) {
    for (const bool is_ball_double_sided : {false, true}) {
        model::Mesh mesh = ball_in_hull();
        mesh.materials[0].double_sided = is_ball_double_sided;
        for (const bool split : {false, true}) {
            if (split) model::split_sides(mesh);
            const PointModel model = sample(mesh, 4000, Order::progressive, true);
            std::size_t of_ball = 0;
            for (std::size_t i = 0; i < model.size(); ++i) {
                const bool inner = glm::length(model.positions[i]) < 1.02f;
                of_ball += inner && glm::dot(model.positions[i], model.normals[i]) > 0;
            }
            EXPECT_GT(of_ball, 1600u) << is_ball_double_sided << split;  // of two nearly equal surfaces' 4000
        }
    }
}

TEST(Sides, ATwinIsTheOtherSideOfItsTriangle) {
    model::Mesh mesh = tests::make_cube();
    const std::size_t one_sided = mesh.triangle_count(), vertices = mesh.vertex_count();
    tests::append(mesh, make_leaf(3));
    mesh.materials.resize(2);
    mesh.materials[1].double_sided = true;
    for (std::size_t v = vertices; v < mesh.vertex_count(); ++v) mesh.material_ids[v] = 1;
    model::MorphTarget morph;
    morph.first_vertex = static_cast<std::uint32_t>(vertices - 1);  // of one that has no twin, too
    for (int i = 0; i < 3; ++i) {
        morph.position_offsets.emplace_back(i, 1, 2);
        morph.normal_offsets.emplace_back(0, i, 1);
    }
    mesh.morphs.push_back(morph);
    model::split_sides(mesh);
    EXPECT_FALSE(mesh.double_sided());
    ASSERT_EQ(mesh.triangle_count(), one_sided + 4);
    ASSERT_EQ(mesh.vertex_count(), vertices + 8);
    for (const auto* values : {&mesh.positions, &mesh.normals}) EXPECT_EQ(values->size(), mesh.vertex_count());
    const auto corner = [&](std::size_t t, std::size_t k) { return mesh.positions[mesh.indices[3 * t + k]]; };
    const auto facing = [&](std::size_t t) {
        return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    };
    for (std::size_t t = 0; t < 2; ++t) {
        const std::size_t twin = one_sided + 2 + t;
        EXPECT_EQ(facing(one_sided + t), -facing(twin));
        EXPECT_GT(glm::dot(facing(twin), mesh.normals[mesh.indices[3 * twin]]), 0.0f);
    }
    ASSERT_EQ(mesh.morphs.size(), 2u);
    EXPECT_EQ(mesh.morphs[1].first_vertex, vertices + 4);
    EXPECT_EQ(mesh.morphs[1].position_offsets, (std::vector<glm::vec3>{{1, 1, 2}, {2, 1, 2}}));
    EXPECT_EQ(mesh.morphs[1].normal_offsets, (std::vector<glm::vec3>{{0, -1, -1}, {0, -2, -1}}));
}

TEST(Sides, MeshesOfOneKindStayAsTheyAre) {
    for (const bool double_sided : {false, true}) {
        model::Mesh mesh = tests::make_cube();
        mesh.materials[0].double_sided = double_sided;
        const std::vector<std::uint32_t> indices = mesh.indices;
        model::split_sides(mesh);
        EXPECT_EQ(mesh.indices, indices);
        EXPECT_EQ(mesh.double_sided(), double_sided);
    }
}

}  // namespace
