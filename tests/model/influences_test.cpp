// Vertices of more joints than four: all of them count, each once.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "model/io/gltf.h"
#include "model/sides.h"
#include "motion/pose.h"
#include "tests/model/gltf_builder.h"

namespace {

using tests::GltfBuilder;
using tests::json;
using tests::load;

constexpr std::size_t joint_count = 12, vertex_count = 60;

// Influences of each vertex as the file says them, some with no weight.
struct Cloth {
    std::vector<std::vector<std::pair<std::uint8_t, float>>> influences;
    std::vector<glm::vec3> positions;
};

// `least` to `most` joints a vertex, all others than each other.
Cloth cloth_of(std::size_t least, std::size_t most, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return static_cast<float>(low + (high - low) * static_cast<double>(random()) / 4294967296.0);
    };
    Cloth cloth;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        std::vector<std::uint8_t> joints(joint_count);
        for (std::size_t j = 0; j < joint_count; ++j) joints[j] = static_cast<std::uint8_t>(j);
        std::shuffle(joints.begin(), joints.end(), random);
        cloth.influences.emplace_back();
        const std::size_t count = least + random() % (most - least + 1);
        for (std::size_t i = 0; i < count; ++i) cloth.influences.back().emplace_back(joints[i], number(0.1, 1));
        cloth.positions.emplace_back(number(-1, 1), number(0, 2), number(-1, 1));
    }
    return cloth;
}

glm::vec3 place_of_joint(std::size_t joint) {
    return {0.3f * static_cast<float>(joint), 0.5f * static_cast<float>(joint % 3), -0.2f * static_cast<float>(joint)};
}

// In as many sets as the vertex with the most of them needs.
GltfBuilder file_of(const Cloth& cloth) {
    GltfBuilder builder;
    std::size_t most = 0;
    std::vector<float> positions;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        most = std::max(most, cloth.influences[v].size());
        for (int axis = 0; axis < 3; ++axis) positions.push_back(cloth.positions[v][axis]);
    }
    json attributes = {{"POSITION", builder.vec3(positions)},
                       {"NORMAL", builder.vec3(std::vector<float>(3 * vertex_count, 1.0f))}};
    for (std::size_t set = 0; 4 * set < most; ++set) {
        std::vector<std::uint8_t> joints;
        std::vector<float> weights;
        for (const auto& of : cloth.influences)
            for (std::size_t i = 4 * set; i < 4 * set + 4; ++i) {
                joints.push_back(i < of.size() ? of[i].first : std::uint8_t{0});
                weights.push_back(i < of.size() ? of[i].second : 0.0f);
            }
        attributes["JOINTS_" + std::to_string(set)] = builder.add("VEC4", tests::u8, 4, joints);
        attributes["WEIGHTS_" + std::to_string(set)] = builder.vec4(weights);
    }
    builder.add_mesh(attributes);
    builder.node(0) = {{"mesh", 0}, {"skin", 0}};
    json joints = json::array();
    for (std::size_t j = 0; j < joint_count; ++j) {
        const glm::vec3 place = place_of_joint(j);
        builder.node(j + 1) = {{"translation", {place.x, place.y, place.z}}};
        joints.push_back(j + 1);
        builder.document["scenes"][0]["nodes"].push_back(j + 1);
    }
    builder.document["skins"] = {{{"joints", joints}}};
    return builder;
}

std::vector<glm::vec3> posed(const model::Character& character) {
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    std::vector<glm::vec3> positions, normals;
    motion::skin(character.mesh, pose, positions, normals);
    return positions;
}

// The joints only move: a vertex goes the mean of their ways.
glm::dvec3 expected(const Cloth& cloth, std::size_t vertex) {
    glm::dvec3 way(0);
    double sum = 0;
    for (const auto& [joint, weight] : cloth.influences[vertex]) {
        way += static_cast<double>(weight) * glm::dvec3(place_of_joint(joint));
        sum += static_cast<double>(weight);
    }
    return glm::dvec3(cloth.positions[vertex]) + way / sum;
}

void expect_exact(const Cloth& cloth, const std::vector<glm::vec3>& positions) {
    ASSERT_EQ(positions.size(), vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v)
        ASSERT_LT(glm::distance(glm::dvec3(positions[v]), expected(cloth, v)), 1e-5) << v;
}

TEST(Influences, UpToEightAllCount) {
    const Cloth cloth = cloth_of(1, 8, 1);
    const model::Character character = load(file_of(cloth));
    EXPECT_EQ(character.mesh.more_joints.size(), vertex_count);
    EXPECT_TRUE(character.warnings.empty());
    expect_exact(cloth, posed(character));
}

TEST(Influences, FourNeedNoMore) {
    const Cloth cloth = cloth_of(1, 4, 2);
    const model::Character character = load(file_of(cloth));
    EXPECT_TRUE(character.mesh.more_joints.empty());
    EXPECT_TRUE(character.mesh.more_weights.empty());
    expect_exact(cloth, posed(character));
}

TEST(Influences, AJointNamedAgainWeighsMoreAndTakesNoPlace) {
    Cloth cloth = cloth_of(2, 4, 3);
    for (auto& of : cloth.influences)
        for (int round = 0; round < 2; ++round) {
            const auto once = of;
            of.insert(of.end(), once.begin(), once.end());
        }
    const model::Character character = load(file_of(cloth));
    EXPECT_TRUE(character.mesh.more_joints.empty());
    expect_exact(cloth, posed(character));
}

TEST(Influences, OfMoreThanEightTheHeaviestStayAndTheRestIsSaid) {
    Cloth cloth = cloth_of(10, 12, 4);
    const model::Character character = load(file_of(cloth));
    ASSERT_FALSE(character.warnings.empty());
    EXPECT_EQ(character.warnings.begin()->count, vertex_count);
    for (auto& of : cloth.influences) {
        std::sort(of.begin(), of.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
        of.resize(8);
    }
    expect_exact(cloth, posed(character));
}

TEST(Influences, WhatWeighsNextToNothingIsLeftOutSilently) {
    Cloth cloth = cloth_of(8, 8, 5);
    for (auto& of : cloth.influences)
        for (std::uint8_t j = 0; j < 2; ++j) of.emplace_back(j, 1e-6f);
    EXPECT_TRUE(load(file_of(cloth)).warnings.empty());
}

TEST(Influences, WeightsBeyondAnySumAreAsGoodAsOthers) {
    Cloth cloth = cloth_of(1, 8, 7);
    for (auto& of : cloth.influences) {
        for (auto& [joint, weight] : of) weight = 3e38f;
        const auto once = of;
        of.insert(of.end(), once.begin(), once.end());
    }
    expect_exact(cloth, posed(load(file_of(cloth))));
}

TEST(Influences, SecondSidesHangAsTheFirst) {
    const Cloth cloth = cloth_of(5, 8, 6);
    GltfBuilder builder = file_of(cloth);
    builder.document["materials"] = {{{"doubleSided", true}}, json::object()};
    json& primitives = builder.document["meshes"][0]["primitives"];
    primitives[0]["material"] = 1;
    primitives.push_back(primitives[0]);
    primitives[1]["material"] = 0;
    model::Character character = load(builder);
    model::split_sides(character.mesh);
    ASSERT_EQ(character.mesh.more_joints.size(), 3 * vertex_count);
    ASSERT_EQ(character.mesh.more_weights.size(), 3 * vertex_count);
    const std::vector<glm::vec3> positions = posed(character);
    for (std::size_t v = 0; v < 3 * vertex_count; ++v) ASSERT_EQ(positions[v], positions[v % vertex_count]) << v;
}

}  // namespace
