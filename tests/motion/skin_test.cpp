#include <gtest/gtest.h>

#include <cmath>

#include "motion/pose.h"
#include "tests/motion/tentacle.h"

namespace {

// Directions spread over the sphere, as the vertices of a unit ball on one joint with matrix `world`.
model::Character make_ball(const glm::mat4& world) {
    model::Character character;
    character.skeleton.nodes.resize(1);
    character.skeleton.nodes[0].rest_matrix = world;
    character.skeleton.palette.push_back({0, glm::mat4(1.0f)});
    tests::Random random(9);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 direction = random.rotation() * glm::vec3(0, 0, 1);
        character.mesh.positions.push_back(direction);
        character.mesh.normals.push_back(direction);
        character.mesh.joints.push_back({});
        character.mesh.weights.push_back({1, 0, 0, 0});
    }
    return character;
}

void pose_rest(const model::Character& character, std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals) {
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, positions, normals);
}

// The unit ball under an affine map is an ellipsoid, whose outward normal at p is the gradient of |A^-1 p|^2.
void expect_ellipsoid_normals(const glm::mat4& world) {
    const model::Character ball = make_ball(world);
    std::vector<glm::vec3> positions, normals;
    pose_rest(ball, positions, normals);
    const glm::mat3 inverse = glm::inverse(glm::mat3(world));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 outward =
            glm::normalize(glm::transpose(inverse) * (inverse * (positions[i] - glm::vec3(world[3]))));
        ASSERT_GT(glm::dot(normals[i], outward), 1.0f - 1e-5f);
        ASSERT_NEAR(glm::length(normals[i]), 1.0f, 1e-6f);
    }
}

TEST(Skin, NormalsFollowUnevenScale) {
    tests::Random random(3);
    expect_ellipsoid_normals(tests::matrix_of({{1, 2, 3}, random.rotation(), {0.1f, 2.0f, 5.0f}}));
}

TEST(Skin, NormalsStayOutwardUnderMirrors) {
    tests::Random random(4);
    expect_ellipsoid_normals(tests::matrix_of({{1, 2, 3}, random.rotation(), {-1.0f, 1.0f, 1.0f}}));
    expect_ellipsoid_normals(tests::matrix_of({{1, 2, 3}, random.rotation(), {-0.5f, -2.0f, -1.0f}}));
}

TEST(Skin, CollapsedJointsKeepUnitNormals) {
    for (const glm::vec3 scale : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0)}) {
        const model::Character ball = make_ball(tests::matrix_of({{}, glm::quat(1, 0, 0, 0), scale}));
        std::vector<glm::vec3> positions, normals;
        pose_rest(ball, positions, normals);
        for (const glm::vec3& normal : normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-6f);
    }
}

TEST(Skin, CollapsedJointsKeepTheUnposedNormalUnderMorphsToo) {
    model::Character ball = make_ball(glm::mat4(0.0f));
    const std::size_t count = ball.mesh.vertex_count();
    ball.mesh.morphs.push_back(
        {0, 0, 1.0f, 0, std::vector<glm::vec3>(count), std::vector<glm::vec3>(count, glm::vec3(3, 0, 0))});
    std::vector<glm::vec3> positions, normals;
    pose_rest(ball, positions, normals);
    EXPECT_EQ(normals, ball.mesh.normals);
}

TEST(Skin, PaletteOfIdentitiesChangesNothing) {
    model::Character tentacle = tests::make_tentacle(5);
    motion::Pose pose;
    pose.palette.assign(tentacle.skeleton.palette.size(), glm::mat4(1.0f));
    std::vector<glm::vec3> positions, normals;
    motion::skin(tentacle.mesh, pose, positions, normals);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        ASSERT_LT(glm::distance(positions[i], tentacle.mesh.positions[i]), 2e-6f);  // weights sum to 1 up to rounding
        ASSERT_LT(glm::distance(normals[i], tentacle.mesh.normals[i]), 2e-6f);
    }
}

TEST(Skin, MorphsAddTheirWeightsToTheirVerticesOnly) {
    model::Character ball = make_ball(glm::mat4(1.0f));
    ball.mesh.morphs.push_back({0, 0, 0.25f, 10, std::vector<glm::vec3>(5, glm::vec3(4, 0, 0)), {}});
    ball.mesh.morphs.push_back({0, 1, 0.5f, 12, std::vector<glm::vec3>(1, glm::vec3(0, 2, 0)), {}});
    std::vector<glm::vec3> positions, normals;
    pose_rest(ball, positions, normals);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 moved((i >= 10 && i < 15) ? 1.0f : 0.0f, i == 12 ? 1.0f : 0.0f, 0.0f);
        ASSERT_EQ(positions[i], ball.mesh.positions[i] + moved) << i;
    }
}

TEST(Skin, MorphWeightsFollowTheClip) {
    model::Character ball = make_ball(glm::mat4(1.0f));
    ball.mesh.morphs.push_back({0, 0, 0.0f, 0, {glm::vec3(1, 0, 0)}, {}});
    ball.mesh.morphs.push_back({0, 1, 0.0f, 0, {glm::vec3(0, 1, 0)}, {}});
    ball.mesh.morphs.push_back({0, 2, 0.125f, 0, {glm::vec3(0, 0, 1)}, {}});  // a slot that the clip lacks
    const model::Channel weights{0, model::Path::morph_weights, model::Interpolation::linear, {0, 2}, {0, 1, 1, 3}};
    motion::Pose pose;
    motion::evaluate(ball, {"morph", 2.0, {weights}}, 0.5, pose);
    EXPECT_FLOAT_EQ(pose.morph_weights[0], 0.25f);
    EXPECT_FLOAT_EQ(pose.morph_weights[1], 1.5f);
    EXPECT_FLOAT_EQ(pose.morph_weights[2], 0.125f);
}

}  // namespace
