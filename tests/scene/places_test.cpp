// What every place stands on: the stadium made in one call, and crowds on a path that is no oval.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scene/gathering.h"
#include "tests/scene/fake_cast.h"

namespace {

using scene::Crowd;

TEST(Places, TheStadiumIsWhatItsPlanSays) {
    const tests::FakeCast cast = tests::sitters_and_standers();
    const scene::Audience audience{70'000, cast.members, cast.poses, 3};
    const scene::Place place = scene::make_stadium(audience);
    const scene::StadiumPlan plan = scene::plan_stadium(70'000, scene::room_for(cast.members, cast.poses));
    const scene::StaticMesh structure = scene::build_structure(plan);
    ASSERT_EQ(place.structure.indices, structure.indices);
    ASSERT_EQ(place.structure.vertices.size(), structure.vertices.size());
    for (std::size_t i = 0; i < structure.vertices.size(); ++i)
        ASSERT_EQ(place.structure.vertices[i].position, structure.vertices[i].position);
    const Crowd crowd = scene::populate(plan, audience);
    EXPECT_EQ(place.crowd.position, crowd.position);
    EXPECT_EQ(place.crowd.hash, crowd.hash);
    for (const std::string_view name : scene::preset_names) {
        const scene::CameraPose got = place.cameras.named(name).at(7), expected = aim_cameras(plan).named(name).at(7);
        EXPECT_EQ(got.position, expected.position) << name;
        EXPECT_EQ(got.target, expected.target) << name;
    }
    EXPECT_EQ(place.ground.shader, "stadium.glsl");
    EXPECT_EQ(place.ground.parameters[0], glm::vec4(plan.oval.half_straight, plan.oval.radius, plan.stand_offset, 0));
}

TEST(Places, EverybodyIsSomewhereAround) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : {100, 20'000, 200'000}) {
        for (const float around : tests::populate(cast, people).around) {
            ASSERT_GE(around, 0.0f);
            ASSERT_LT(around, 1.0f);
        }
    }
}

// A hundred metres along x and back again.
struct ThereAndBack final : scene::Path {
    static constexpr float end = 100;  // [m]

    float length(float) const override { return 2 * end; }
    glm::vec2 position(float arc, float offset) const override {
        const float rest = arc - 2 * end * std::floor(arc / (2 * end));
        return {rest < end ? rest : 2 * end - rest, offset};
    }
    glm::vec2 tangent(float arc, float) const override {
        return {arc - 2 * end * std::floor(arc / (2 * end)) < end ? 1 : -1, 0};
    }
    float turning(float) const override { return std::numeric_limits<float>::infinity(); }
    motion::Bounds bounds(float offset) const override { return {{0, 0, offset}, {end, 0, offset}}; }
};

TEST(Gathering, WalkersFollowAnyPathAndStayInTheirBlock) {
    const tests::FakeCast cast = tests::sitters();
    scene::Gathering gathering({2, cast.members, cast.poses, 1}, std::make_shared<ThereAndBack>());
    gathering.open_block();
    gathering.add({.position = {3, 0, 10}, .height = 1.75f, .role = scene::Role::walker});
    gathering.add({.position = {-3, 0, 60}, .height = 1.75f, .role = scene::Role::walker});
    gathering.close_block();
    const Crowd& crowd = gathering.crowd;
    ASSERT_EQ(crowd.blocks.size(), 1u);
    const motion::Bounds& box = crowd.blocks[0].box;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        for (std::int64_t tick = -100; tick < 20'000; tick += 7) {
            const double walked = static_cast<double>(crowd.position[i].z) + 1.4 * static_cast<double>(tick) / 60;
            const double along = walked - 200 * std::floor(walked / 200);
            const scene::Placement at = scene::place(crowd, i, cast.members[0], tick);
            ASSERT_NEAR(at.position.x, along < 100 ? along : 200 - along, 1e-3);
            ASSERT_EQ(at.position.z, crowd.position[i].x);
            const bool turns = std::min({along, std::abs(along - 100), 200 - along}) < 0.01;
            ASSERT_TRUE(turns || std::abs(std::sin(at.yaw) - (along < 100 ? 1 : -1)) < 1e-6);
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_GE(at.position[axis], box.min[axis]);
                ASSERT_LE(at.position[axis], box.max[axis]);
            }
        }
    }
    EXPECT_GT(box.min.x, -2.5f) << "no larger than the way and somebody's reach";
    EXPECT_LT(box.max.x, 102.5f);
}

// The same people in centimetres and in kilometres.
TEST(Gathering, BoxesAreInMetresWhateverAModelsUnits) {
    for (const float units_a_metre : {100.0f, 0.001f}) {
        const auto block_of = [](const tests::FakeCast& cast, scene::Role role) {
            scene::Gathering gathering({1, cast.members, cast.poses, 1}, std::make_shared<ThereAndBack>());
            gathering.open_block();
            gathering.add({.position = {3, 1, 10}, .yaw = 0.4f, .height = 1.6f, .role = role});
            gathering.close_block();
            return gathering.crowd.blocks.at(0).box;
        };
        tests::FakeCast scaled = tests::sitters();
        for (motion::PoseTable& poses : scaled.poses) {
            poses.box.min *= units_a_metre;
            poses.box.max *= units_a_metre;
            poses.rest_height *= units_a_metre;
        }
        for (const scene::Role role : {scene::Role::walker, scene::Role::spectator}) {
            const motion::Bounds expected = block_of(tests::sitters(), role), box = block_of(scaled, role);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(box.min[axis], expected.min[axis], 1e-4) << units_a_metre << ", axis " << axis;
                EXPECT_NEAR(box.max[axis], expected.max[axis], 1e-4) << units_a_metre << ", axis " << axis;
            }
        }
    }
}

// What float32 tells from an origin must be near it (docs/precision.md).
TEST(Gathering, RefusesABlockThatReachesTooFarFromItsOrigin) {
    const tests::FakeCast cast = tests::sitters();
    const auto stand_at = [&](glm::vec3 at) {
        scene::Gathering gathering({1, cast.members, cast.poses, 1}, nullptr);
        gathering.open_block({4e6, 0, 5e6});
        gathering.add({.position = at, .character = 0});
        gathering.close_block();
        return gathering.crowd.blocks.at(0).origin;
    };
    EXPECT_EQ(stand_at({8'000, 0, -8'000}), glm::dvec3(4e6, 0, 5e6));
    for (const glm::vec3 at : {glm::vec3(8'200, 0, 0), glm::vec3(0, 0, -8'200), glm::vec3(0, NAN, 0)})
        EXPECT_THROW(stand_at(at), std::invalid_argument) << at.x << ", " << at.z;
}

TEST(Gathering, DropsABlockWithNobodyInIt) {
    const tests::FakeCast cast = tests::sitters();
    scene::Gathering gathering({1, cast.members, cast.poses, 1}, nullptr);
    gathering.open_block();
    gathering.close_block();
    gathering.open_block();
    gathering.add({.position = {5, 2, 1}, .character = 0});
    gathering.close_block();
    ASSERT_EQ(gathering.crowd.blocks.size(), 1u);
    EXPECT_EQ(gathering.crowd.blocks[0].first, 0u);
    EXPECT_EQ(gathering.crowd.blocks[0].count, 1u);
    EXPECT_EQ(gathering.crowd.position[0], glm::vec3(5, 2, 1)) << "somebody stands where they are put";
}

}  // namespace
