// Any rig, any clip, any time, against an evaluator that shares no line with motion/pose.cpp.
#include "tests/motion/rig.h"

#include <gtest/gtest.h>

#include <set>

#include "motion/pose.h"
#include "tests/motion/reference.h"

namespace {

using tests::reference::Figure;

constexpr std::uint64_t rigs = 60;

// Nine levels of float matrices at most, on coordinates of a few units: some tens of roundings of 2^-23, relative to
// the largest product of scales on the way.
constexpr double place_tolerance = 1e-4;
// A normal is as exact as its map is round; below, the rounding of a flat map decides.
constexpr double normal_tolerance = 1e-4, least_roundness = 0.02;

struct Surface {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
};

void skin(const model::Character& character, Surface& surface) {
    motion::skin(character.mesh, surface.pose, surface.positions, surface.normals);
}

// Before the first key, on every key, between any two, and after the last.
std::set<double> telling_times(const model::Clip& clip) {
    std::set<double> times{-1.0, 0.0, clip.duration + 1};
    for (const model::Channel& channel : clip.channels) {
        for (std::size_t i = 0; i < channel.times.size(); ++i) {
            const double key = static_cast<double>(channel.times[i]);
            times.insert(key);
            if (i > 0) times.insert(0.3 * static_cast<double>(channel.times[i - 1]) + 0.7 * key);
        }
    }
    return times;
}

void expect_like(const model::Character& character, const Figure& expected, const Surface& got, int& normals) {
    ASSERT_EQ(got.positions.size(), character.mesh.vertex_count());
    for (std::size_t i = 0; i < got.positions.size(); ++i) {
        const glm::dvec3 place = expected.position(i);
        ASSERT_LT(glm::distance(glm::dvec3(got.positions[i]), place), place_tolerance * (1 + glm::length(place))) << i;
        ASSERT_NEAR(glm::length(got.normals[i]), 1.0f, 1e-5f);
        const double roundness = expected.roundness(i);
        if (roundness < least_roundness) continue;
        ASSERT_LT(glm::distance(glm::dvec3(got.normals[i]), expected.normal(i)), normal_tolerance / roundness) << i;
        ++normals;
    }
}

TEST(Rig, EveryTimeOfAnyClipIsTheReferences) {
    int normals = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= rigs; ++seed) {
        const model::Character character = tests::make_rig(seed);
        const model::Clip& clip = character.clips[0];
        Surface got;
        for (const double time : telling_times(clip)) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << " time " << time);
            motion::evaluate(character, clip, time, got.pose);
            skin(character, got);
            const Figure expected(character, clip, time);
            ASSERT_NO_FATAL_FAILURE(expect_like(character, expected, got, normals));
            all += static_cast<int>(got.positions.size());
            for (std::size_t i = 0; i < expected.morph_weights.size(); ++i)
                ASSERT_NEAR(static_cast<double>(got.pose.morph_weights[i]), expected.morph_weights[i], 1e-6);
        }
    }
    EXPECT_GT(normals, all / 2);
}

TEST(Rig, EveryNodeIsWhereTheReferenceHasIt) {
    for (std::uint64_t seed = 1; seed <= rigs; ++seed) {
        const model::Character character = tests::make_rig(seed);
        const model::Clip& clip = character.clips[0];
        motion::Pose pose;
        motion::evaluate(character, clip, 0.5 * clip.duration, pose);
        const Figure expected(character, clip, 0.5 * clip.duration);
        ASSERT_EQ(pose.world.size(), character.skeleton.nodes.size());
        for (std::int32_t node = 0; node < static_cast<std::int32_t>(pose.world.size()); ++node) {
            const glm::vec3 p(0.3f, -0.7f, 1.1f);
            const glm::vec3 got(pose.world[static_cast<std::size_t>(node)] * glm::vec4(p, 1));
            ASSERT_LT(glm::distance(glm::dvec3(got), expected.place(node, p)), 10 * place_tolerance) << seed;
        }
    }
}

TEST(Rig, AtRestItIsTheReferences) {
    int normals = 0;
    for (std::uint64_t seed = 1; seed <= rigs; ++seed) {
        const model::Character character = tests::make_rig(seed);
        Surface got;
        motion::evaluate_rest(character, got.pose);
        skin(character, got);
        ASSERT_NO_FATAL_FAILURE(expect_like(character, Figure(character), got, normals)) << seed;
    }
}

TEST(Rig, APoseForgetsTheOneBefore) {
    const model::Character large = tests::make_rig(1), small = tests::make_tentacle(2, 3);
    Surface fresh, used;
    motion::evaluate(large, large.clips[0], 0.4, used.pose);
    skin(large, used);
    motion::evaluate(small, small.clips[0], 0.4, used.pose);
    skin(small, used);
    motion::evaluate(small, small.clips[0], 0.4, fresh.pose);
    skin(small, fresh);
    EXPECT_EQ(used.pose.world, fresh.pose.world);
    EXPECT_EQ(used.pose.palette, fresh.pose.palette);
    EXPECT_EQ(used.pose.morph_weights, fresh.pose.morph_weights);
    EXPECT_EQ(used.positions, fresh.positions);
    EXPECT_EQ(used.normals, fresh.normals);
}

TEST(Rig, WeightsOfOneNodeLeaveTheOthersAlone) {
    model::Character character = tests::make_rig(3);
    model::Mesh& mesh = character.mesh;
    motion::Pose rest, posed;
    motion::evaluate_rest(character, rest);
    for (const std::int32_t node : {2, 5}) {
        const model::Channel weights{node, model::Path::morph_weights, model::Interpolation::step, {0}, {7, 8, 9}};
        motion::evaluate(character, {"one", 0, {weights}}, 0, posed);
        for (std::size_t i = 0; i < mesh.morphs.size(); ++i) {
            const float driven = weights.values[static_cast<std::size_t>(mesh.morphs[i].weight)];
            EXPECT_EQ(posed.morph_weights[i], mesh.morphs[i].node == node ? driven : rest.morph_weights[i]);
        }
    }
}

TEST(Rig, SmallTurnsAreAsExactAsLargeOnes) {
    // A float's rounding of a unit quaternion, twice for the angle, and of its blend.
    constexpr double tolerance = 1e-6;
    tests::Random random(8);
    for (double angle = 1e-4; angle < 3.1; angle *= 1.3) {
        const glm::quat from = random.rotation();
        const glm::quat to = from * glm::angleAxis(static_cast<float>(angle), random.rotation() * glm::vec3(1, 0, 0));
        model::Character character;
        character.skeleton.nodes.resize(1);
        const model::Clip clip{"turn",
                               1,
                               {{0,
                                 model::Path::rotation,
                                 model::Interpolation::linear,
                                 {0, 1},
                                 {from.x, from.y, from.z, from.w, to.x, to.y, to.z, to.w}}}};
        for (const double time : {0.1, 0.25, 0.5, 0.9}) {
            motion::Pose pose;
            motion::evaluate(character, clip, time, pose);
            const Figure expected(character, clip, time);
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 p(0);
                p[axis] = 1;
                EXPECT_LT(glm::distance(glm::dvec3(pose.world[0][axis]), expected.place(0, p)), tolerance) << angle;
            }
        }
    }
}

}  // namespace
