// Who sees out of what: holes of known size and place, and what points of a run tell those after them.
#include "pointsample/visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pointsample/hidden.h"
#include "tests/motion/tentacle.h"
#include "tests/pointsample/shapes.h"

namespace {

using pointsample::Place;
using pointsample::Visibility;

constexpr std::size_t directions_asked = 64, rays_after_hidden = 8;  // visibility.h

// A sphere about `center` without what is nearer to one of `holes` than the cosine says. 0.9: a twentieth of the sky.
model::Mesh pierced(const glm::vec3& center, const std::vector<glm::vec3>& holes, float cosine = 0.9f) {
    const model::Mesh sphere = tests::make_sphere(1, 5);
    model::Mesh mesh;
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < 3; ++k) middle += sphere.positions[sphere.indices[i + k]] / 3.0f;
        bool kept = true;
        for (const glm::vec3& hole : holes) kept = kept && glm::dot(glm::normalize(middle), hole) < cosine;
        if (kept)
            mesh.indices.insert(mesh.indices.end(), sphere.indices.begin() + static_cast<std::ptrdiff_t>(i),
                                sphere.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    for (const glm::vec3& position : sphere.positions) mesh.positions.push_back(center + position);
    mesh.normals = sphere.normals;
    tests::fill_looks(mesh);
    return mesh;
}

const glm::vec3 up(0, 0, 1), far_off(9, 0, 0);

// A sphere with a hole on either side: from its middle a place that faces one sees no other. And a whole sphere from
// which nothing is seen.
struct TwoHolesAndAPrison {
    model::Mesh mesh;
    Place one, other, imprisoned{far_off, up};

    explicit TwoHolesAndAPrison(const glm::vec3& hole)
        : mesh(pierced(glm::vec3(0), {hole, -hole})), one{glm::vec3(0), hole}, other{glm::vec3(0), -hole} {
        tests::append(mesh, pierced(far_off, {}));
    }
};

// Of many, as those that are asked first find some holes by chance.
std::vector<glm::vec3> axes() {
    tests::Random random(7);
    std::vector<glm::vec3> axes{up};
    while (axes.size() < 10) axes.push_back(random.rotation() * up);
    return axes;
}

std::vector<char> look(const model::Mesh& mesh, const std::vector<Place>& places) {
    return Visibility(mesh.positions, mesh.indices).look(places, false);
}

TEST(Visibility, AfterOneThatSeesOutEveryPlaceIsAskedInAllDirections) {
    for (const glm::vec3& axis : axes()) {
        const TwoHolesAndAPrison scene(axis);
        // The direction that one sees out in is no use to the next.
        std::vector<Place> places{scene.imprisoned, scene.imprisoned};
        places.resize(places.size() + rays_after_hidden + 4, scene.one);
        const std::size_t opened = places.size();
        for (int i = 0; i < 40; ++i) places.push_back(i % 2 ? scene.one : scene.other);
        const std::vector<char> seen = look(scene.mesh, places);
        EXPECT_FALSE(seen[0] || seen[1]);
        for (std::size_t i = opened; i < places.size(); ++i) EXPECT_TRUE(seen[i]) << i - opened;
    }
}

TEST(Visibility, HiddenRunsThatOpenAgainAreSeenWhereverTheyDo) {
    // By then every direction has been asked once, eight at a time.
    constexpr std::size_t patience = directions_asked / rays_after_hidden;
    for (const glm::vec3& axis : axes()) {
        const TwoHolesAndAPrison scene(axis);
        const Visibility visibility(scene.mesh.positions, scene.mesh.indices);
        for (std::size_t hidden = 1; hidden < 24; hidden += 2) {
            for (const Place& place : {scene.one, scene.other}) {
                std::vector<Place> places(hidden, scene.imprisoned);
                places.resize(hidden + 2 * patience, place);
                const std::vector<char> seen = visibility.look(places, false);
                for (std::size_t i = hidden + patience; i < places.size(); ++i) EXPECT_TRUE(seen[i]) << hidden;
            }
        }
    }
}

TEST(Visibility, RunsForgetEachOther) {
    for (const glm::vec3& axis : axes()) {
        const TwoHolesAndAPrison scene(axis);
        std::vector<Place> places(256, scene.imprisoned);  // one run
        places.push_back(scene.one);
        EXPECT_TRUE(look(scene.mesh, places).back());
    }
}

TEST(Visibility, AHoleOfATwentiethOfTheSkyIsFoundWhereverItIs) {
    tests::Random random(3);
    for (int i = 0; i < 25; ++i) {
        const glm::vec3 hole = random.rotation() * up;
        const model::Mesh mesh = pierced(glm::vec3(0), {hole});
        // Facing the hole, or nearly aside of it.
        const glm::vec3 aside = glm::normalize(glm::cross(hole, random.rotation() * up));
        for (const glm::vec3& normal : {hole, glm::normalize(hole + aside), glm::normalize(0.6f * hole + aside)})
            EXPECT_TRUE(look(mesh, {{glm::vec3(0), normal}})[0]) << i;
        EXPECT_FALSE(look(mesh, {{glm::vec3(0), -hole}})[0]) << i;
    }
}

// A flat floor under a lid: the sky is a ring above the horizon.
model::Mesh under_a_lid(float elevation) {
    const float height = std::tan(elevation), side = 1 / std::sqrt(2.0f);  // the lid's corners are one away
    model::Mesh mesh = tests::make_triangle({-200, -200, 0}, {200, -200, 0}, {0, 300, 0});
    const std::vector<glm::vec3> lid{
        {-side, -side, height}, {side, -side, height}, {side, side, height}, {-side, side, height}};
    tests::append(mesh, tests::make_triangle(lid[0], lid[1], lid[2]));
    tests::append(mesh, tests::make_triangle(lid[0], lid[2], lid[3]));
    return mesh;
}

TEST(Visibility, WhatIsOpenBelowTwoDegreesAboveTheSurfaceIsNotSeen) {
    constexpr float degree = 0.0174533f;
    // Over a lid's side the ring is higher than over its corners: by the square root of two in the tangent.
    EXPECT_FALSE(look(under_a_lid(0.5f * degree), {{glm::vec3(0), up}})[0]);
    EXPECT_FALSE(look(under_a_lid(1.0f * degree), {{glm::vec3(0), up}})[0]);
    EXPECT_TRUE(look(under_a_lid(12.0f * degree), {{glm::vec3(0), up}})[0]);
    EXPECT_TRUE(look(under_a_lid(45.0f * degree), {{glm::vec3(0), up}})[0]);
}

TEST(Visibility, ClothesAHairAboveTheSkinHideIt) {
    constexpr float gap = 2e-4f;  // of a size of two: 0.3 mm on a person
    model::Mesh mesh = tests::make_sphere(1, 4);
    for (const glm::vec3& place : {glm::vec3(0), glm::vec3(500, 0, 0)}) {
        model::Mesh dressed = mesh, clothes = tests::make_sphere(1 + gap, 4);
        tests::append(dressed, clothes);
        for (glm::vec3& position : dressed.positions) position += place;
        std::vector<Place> skin, cloth;
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            const pointsample::PosedMesh pose{dressed.positions, dressed.normals};
            const motion::SurfacePoint middle{static_cast<std::uint32_t>(t), 0.33f, 0.33f};
            skin.push_back(pointsample::place_of(middle, dressed.indices, pose));
            cloth.push_back(pointsample::place_of(
                {middle.triangle + static_cast<std::uint32_t>(mesh.triangle_count()), middle.u, middle.v},
                dressed.indices, pose));
        }
        for (const char seen : look(dressed, skin)) ASSERT_FALSE(seen);
        for (const char seen : look(dressed, cloth)) ASSERT_TRUE(seen);
    }
}

// Each of three balls comes out of its shell in a pose of its own; one never does.
TEST(HiddenTest, APointStaysIfItIsSeenInAnyPose) {
    model::Mesh mesh = tests::make_sphere(1, 3);
    const std::size_t shell_vertices = mesh.vertex_count(), shell = mesh.triangle_count();
    const model::Mesh ball = tests::make_sphere(0.2f, 1);
    const std::vector<glm::vec3> places{{0.5f, 0, 0}, {0, 0.5f, 0}, {0, 0, 0.5f}, {-0.5f, 0, 0}};
    for (const glm::vec3& place : places) {
        model::Mesh moved = ball;
        for (glm::vec3& position : moved.positions) position += place;
        tests::append(mesh, moved);
    }
    std::vector<pointsample::PosedMesh> poses(4, {mesh.positions, mesh.normals});
    for (std::size_t pose = 1; pose < 4; ++pose)
        for (std::size_t v = 0; v < ball.vertex_count(); ++v)
            poses[pose].positions[shell_vertices + (pose - 1) * ball.vertex_count() + v] *= 10.0f;
    std::vector<motion::SurfacePoint> points;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) points.push_back({t, 0.3f, 0.3f});
    for (std::size_t count = 1; count <= 4; ++count) {
        const pointsample::Surface surface(mesh.indices, std::span(poses).first(count));
        const std::vector<char> seen = pointsample::HiddenTest(surface, false).visible(points);
        for (std::size_t t = 0; t < points.size(); ++t) {
            const std::size_t whose = t < shell ? 0 : 1 + (t - shell) / ball.triangle_count();
            EXPECT_EQ(seen[t] != 0, whose < count) << "triangle " << t << " of " << whose << ", poses " << count;
        }
    }
}

// In its second pose the shell has grown with what is in it.
TEST(HiddenTest, EveryPoseHidesItsOwnPoints) {
    model::Mesh mesh = tests::make_sphere(1, 3);
    const std::size_t shell = mesh.triangle_count();
    tests::append(mesh, tests::make_sphere(0.5f, 2));
    std::vector<pointsample::PosedMesh> poses(2, {mesh.positions, mesh.normals});
    for (glm::vec3& position : poses[1].positions) position *= 10.0f;
    const pointsample::Surface surface(mesh.indices, poses);
    std::vector<motion::SurfacePoint> points;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) points.push_back({t, 0.3f, 0.3f});
    const std::vector<char> seen = pointsample::HiddenTest(surface, false).visible(points);
    for (std::size_t t = 0; t < points.size(); ++t) EXPECT_EQ(seen[t] != 0, t < shell) << t;
}

}  // namespace
