// glTF whose nodes stand in a country's coordinates, with centimetres at five million metres.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/io/gltf.h"
#include "motion/pose.h"
#include "tests/model/gltf_builder.h"

namespace {

using tests::GltfBuilder;
using tests::load;

const glm::dvec3 far_place(5123456.78, 312.34, -4987654.32);

std::vector<double> list_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

std::vector<glm::vec3> posed(const model::Character& character, double time = -1) {
    motion::Pose pose;
    if (time < 0)
        motion::evaluate_rest(character, pose);
    else
        motion::evaluate(character, character.clips.at(0), time, pose);
    std::vector<glm::vec3> positions, normals;
    motion::skin(character.mesh, pose, positions, normals);
    return positions;
}

// `far` is `near`, moved by `place`.
void expect_moved(const model::Character& near, const model::Character& far, const glm::dvec3& place, double time = -1,
                  double tolerance = 1e-6) {  // of a shape of about 1
    const std::vector<glm::vec3> here = posed(near, time), there = posed(far, time);
    ASSERT_EQ(near.mesh.origin, glm::dvec3(0.0));
    ASSERT_NE(far.mesh.origin, glm::dvec3(0.0));
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t v = 0; v < here.size(); ++v) {
        const glm::dvec3 found = far.mesh.origin - place + glm::dvec3(there[v]);
        ASSERT_LT(glm::distance(found, glm::dvec3(here[v])), tolerance) << v;
    }
}

TEST(GltfFar, ARigidPartStandsToItsMicrometres) {
    GltfBuilder near = tests::make_square(), far = tests::make_square();
    far.node(0)["translation"] = list_of(far_place);
    expect_moved(load(near), load(far), far_place);
}

// A table or a room away, as parts of scenes are.
TEST(GltfFar, AFewSizesAwayAreExactToo) {
    for (const double away : {1.6, 3.3, 17.7, 101.9}) {
        GltfBuilder near = tests::make_square(), far = tests::make_square();
        near.node(0)["scale"] = far.node(0)["scale"] = {1, 0.7, 1};
        far.node(0)["translation"] = {away, away / 3, -away / 7};
        expect_moved(load(near), load(far), {away, away / 3, -away / 7}, -1, 1.5e-7);
    }
}

TEST(GltfFar, WhoStandsOnZeroKeepsItAsTheirOrigin) {
    GltfBuilder standing = tests::make_square();
    standing.node(0) = {{"mesh", 0}, {"scale", {0.3, 1.8, 1}}, {"translation", {-0.15, 0, 0}}};
    EXPECT_EQ(load(standing).mesh.origin, glm::dvec3(0.0));
}

TEST(GltfFar, SmallPlacesUnderFarParentsAreKept) {
    const auto scene = [](const glm::dvec3& place) {
        GltfBuilder builder = tests::make_square();
        builder.document["scenes"][0]["nodes"] = {1};
        builder.node(1) = {{"children", {2}}, {"rotation", {std::sqrt(0.5), 0, 0, -std::sqrt(0.5)}}};
        // Turned by -90 degrees about x: y is what the root has as z, backwards.
        builder.node(2) = {{"children", {0, 3}}, {"translation", {place.x, -place.z, place.y}}};
        builder.node(0)["translation"] = {0.01, 0.02, 0.03};
        builder.node(3) = {{"mesh", 0}, {"translation", {0.4, -0.3, 0.2}}, {"scale", {0.5, 2, 1}}};
        return load(builder);
    };
    expect_moved(scene({0, 0, 0}), scene(far_place), far_place);
}

TEST(GltfFar, VerticesFarInTheirNodeAreAsTheFileHasThem) {
    const float far = 4194304.0f;  // floats have halves there
    const auto square = [](float x) {
        GltfBuilder builder;
        builder.add_mesh({{"POSITION", builder.vec3({x, 0, 0, x + 1, 0, 0, x + 1, 1.1f, 0})}});
        builder.node(0) = {{"mesh", 0}};
        return builder;
    };
    expect_moved(load(square(0)), load(square(far)), {far, 0, 0});
    GltfBuilder back = square(far);  // and its node brings it back
    back.node(0)["translation"] = {0.25 - static_cast<double>(far), 0, 0};
    const model::Character character = load(back);
    EXPECT_EQ(character.mesh.origin, glm::dvec3(0.0));
}

// A skin whose joints stand under a far node; a clip moves and turns them.
GltfBuilder skinned(const glm::dvec3& place) {
    GltfBuilder builder = tests::make_everything();
    builder.document["scenes"][0]["nodes"] = {0, 3};
    builder.node(3) = {{"children", {1}}, {"translation", list_of(place)}};
    const int times = builder.scalars({0, 2});
    auto& animation = builder.document["animations"][0];
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", 1}, {"path", "rotation"}}}});
    animation["samplers"].push_back({{"input", times}, {"output", builder.vec4({0, 0, 0, 1, 0, 0, 1, 0})}});
    return builder;
}

TEST(GltfFar, SkinsAndTheirClipsStandThere) {
    const model::Character near = load(skinned({0, 0, 0})), far = load(skinned(far_place));
    expect_moved(near, far, far_place);
    for (const double time : {0.0, 0.3, 1.1, 2.0}) expect_moved(near, far, far_place, time);
}

TEST(GltfFar, KeysOfAFarRootMoveWithIt) {
    const glm::vec3 place(4194304, 0, 8388608);  // whole in floats, as keys are floats in files
    const auto walk = [&](const glm::vec3& at) {
        GltfBuilder builder = tests::make_square();
        builder.node(0)["translation"] = list_of(at);
        const int times = builder.scalars({0, 1});
        const int keys = builder.vec3({at.x, at.y, at.z, at.x + 2, at.y + 0.7f, at.z});
        builder.document["animations"] = {
            {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
             {"samplers", {{{"input", times}, {"output", keys}}}}}};
        return load(builder);
    };
    const model::Character near = walk({0, 0, 0}), far = walk(place);
    for (const double time : {0.0, 0.37, 1.0}) expect_moved(near, far, place, time);
}

TEST(GltfFar, WhatIsNearStaysAsItIs) {
    const model::Character character = load(tests::make_everything());
    EXPECT_EQ(character.mesh.origin, glm::dvec3(0.0));
    EXPECT_EQ(character.mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(character.skeleton.nodes[character.skeleton.nodes.size() - 1].rest_matrix[3], glm::vec4(0, 2, 0, 1));
}

}  // namespace
