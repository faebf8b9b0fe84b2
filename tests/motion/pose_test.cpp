#include "motion/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/motion/tentacle.h"

namespace {

using model::Channel;
using model::Interpolation;
using model::Path;

// One node with one channel; what its local matrix becomes.
glm::mat4 world_of(const Channel& channel, double time, const model::Node& node = {}) {
    model::Character character;
    character.skeleton.nodes = {node};
    motion::Pose pose;
    motion::evaluate(character, {"one", 1.0, {channel}}, time, pose);
    return pose.world[0];
}

glm::vec3 translation_of(const Channel& channel, double time) {
    return glm::vec3(world_of(channel, time)[3]);
}

float largest_difference(const glm::mat4& a, const glm::mat4& b) {
    float largest = 0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    return largest;
}

constexpr float rounding = 1e-6f;  // of a handful of float operations on numbers about 1

TEST(Pose, QuaternionSignDoesNotChangeTheWay) {
    const float quarter = std::sqrt(0.5f);
    // From no turn to a quarter turn about y, and the same with the second key's sign flipped.
    const Channel plain{0, Path::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, quarter, 0, quarter}};
    Channel flipped = plain;
    for (std::size_t i = 4; i < 8; ++i) flipped.values[i] = -flipped.values[i];
    for (float time = 0; time <= 1; time += 0.125f) {
        EXPECT_LT(largest_difference(world_of(plain, time), world_of(flipped, time)), rounding) << time;
        const float angle = time * 1.57079633f;
        EXPECT_NEAR(world_of(flipped, time)[0].x, std::cos(angle), rounding) << time;
        EXPECT_NEAR(world_of(flipped, time)[0].z, -std::sin(angle), rounding) << time;
    }
}

TEST(Pose, RotationSpeedIsEvenAlongTheArc) {
    const float a = std::sin(1.4f), b = std::cos(1.4f);  // 2.8 rad: a straight blend of quaternions is far off here
    const Channel channel{0, Path::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, a, b}};
    for (float time = 0; time <= 1; time += 0.1f) {
        const glm::mat4 world = world_of(channel, time);
        EXPECT_NEAR(std::atan2(world[0].y, world[0].x), 2.8f * time, 2 * rounding) << time;
    }
}

TEST(Pose, TheMeanOfAClipIsEachChannelsOverItsTime) {
    const float a = std::sin(0.5f), b = std::cos(0.5f);  // 1 rad about y, and 1 rad the other way with its sign flipped
    const model::Clip clip{"turn",
                           2,
                           {{0, Path::translation, Interpolation::linear, {0, 2}, {0, 0, 0, 4, 2, -2}},
                            {0, Path::rotation, Interpolation::step, {0, 1}, {0, a, 0, b, 0, a, 0, -b}},
                            {0, Path::scale, Interpolation::linear, {}, {}}}};
    const model::Clip mean = motion::mean_of(clip);
    EXPECT_EQ(mean.duration, 0);
    ASSERT_EQ(mean.channels.size(), 2u) << "a channel without keys says nothing";
    const std::vector<float>& way = mean.channels[0].values;
    EXPECT_LT(glm::distance(glm::vec3(way.at(0), way.at(1), way.at(2)), glm::vec3(2, 1, -1)), 0.1f);
    const std::vector<float>& turn = mean.channels[1].values;
    EXPECT_NEAR(turn.at(1), 0, 1e-5f);
    EXPECT_NEAR(turn.at(3), b, 1e-5f);
}

TEST(Pose, TimesOutsideTheKeysAreClamped) {
    const Channel channel{0, Path::translation, Interpolation::linear, {0.25f, 0.75f}, {1, 2, 3, 4, 5, 6}};
    EXPECT_EQ(translation_of(channel, -5), glm::vec3(1, 2, 3));
    EXPECT_EQ(translation_of(channel, 0.25), glm::vec3(1, 2, 3));
    EXPECT_EQ(translation_of(channel, 0.75), glm::vec3(4, 5, 6));
    EXPECT_EQ(translation_of(channel, 1e9), glm::vec3(4, 5, 6));
}

TEST(Pose, StepHoldsTheKeyBefore) {
    const Channel channel{0, Path::translation, Interpolation::step, {0, 1, 2}, {1, 0, 0, 2, 0, 0, 3, 0, 0}};
    EXPECT_EQ(translation_of(channel, 0.999).x, 1);
    EXPECT_EQ(translation_of(channel, 1.0).x, 2);
    EXPECT_EQ(translation_of(channel, 1.999).x, 2);
    EXPECT_EQ(translation_of(channel, 2.0).x, 3);
}

TEST(Pose, CubicSplineReproducesACubic) {
    const auto f = [](double t) { return 2 - t + 3 * t * t - 0.5 * t * t * t; };
    const auto slope = [](double t) { return -1 + 6 * t - 1.5 * t * t; };
    Channel channel{0, Path::translation, Interpolation::cubic_spline, {}, {}};
    for (const double t : {0.0, 0.5, 2.0, 2.25}) {
        channel.times.push_back(static_cast<float>(t));
        for (const double value : {slope(t), f(t), slope(t)})
            for (int axis = 0; axis < 3; ++axis) channel.values.push_back(static_cast<float>(value));
    }
    for (double t = 0; t <= 2.25; t += 0.0625) {
        EXPECT_NEAR(translation_of(channel, t).y, f(t), 8 * rounding) << t;  // values up to 10
    }
}

TEST(Pose, CubicSplineRotationsStayUnit) {
    Channel channel{0, Path::rotation, Interpolation::cubic_spline, {0, 1}, std::vector<float>(24, 0.3f)};
    const glm::mat4 world = world_of(channel, 0.4);
    EXPECT_NEAR(glm::determinant(glm::mat3(world)), 1.0f, 4 * rounding);
}

TEST(Pose, DegenerateQuaternionsTurnNothing) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {0.0f, nan, infinity}) {
        const Channel channel{
            0, Path::rotation, Interpolation::linear, {0, 1}, {bad, bad, bad, bad, bad, bad, bad, bad}};
        for (const double time : {0.0, 0.5, 1.0})
            EXPECT_EQ(largest_difference(world_of(channel, time), glm::mat4(1.0f)), 0.0f) << bad << " at " << time;
    }
}

TEST(Pose, EqualTimesGiveTheLaterKey) {
    const Channel channel{
        0, Path::translation, Interpolation::linear, {0, 1, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}};
    EXPECT_NEAR(translation_of(channel, 0.999).x, 0.999f, rounding);
    EXPECT_EQ(translation_of(channel, 1.0).x, 5);
}

TEST(Pose, ChannelsWithoutWholeKeysLeaveTheRest) {
    model::Node node;
    node.rest.translation = {7, 8, 9};
    node.rest_matrix = tests::matrix_of(node.rest);
    for (const Channel& channel : {Channel{0, Path::translation, Interpolation::linear, {}, {}},
                                   Channel{0, Path::translation, Interpolation::linear, {0, 1}, {1, 2}},
                                   Channel{0, Path::scale, Interpolation::cubic_spline, {0}, {1, 1, 1, 2, 2, 2}}})
        EXPECT_EQ(world_of(channel, 0.5, node), node.rest_matrix);
}

TEST(Pose, ShearedNodesStayShearedUnlessDriven) {
    model::Node node;
    node.rest_matrix[1].x = 0.5f;
    const Channel drives_nothing{0, Path::morph_weights, Interpolation::linear, {0}, {1}};
    EXPECT_EQ(world_of(drives_nothing, 0, node)[1].x, 0.5f);
    model::Character character;
    character.skeleton.nodes = {node};
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    EXPECT_EQ(pose.world[0][1].x, 0.5f);
}

TEST(Pose, ADeepChainNeedsNoStack) {
    model::Character character;
    character.skeleton.nodes.resize(200'000);
    for (std::size_t i = 0; i < character.skeleton.nodes.size(); ++i) {
        character.skeleton.nodes[i].parent = static_cast<std::int32_t>(i) - 1;
        character.skeleton.nodes[i].rest_matrix[3].x = 1.0f;
    }
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    EXPECT_EQ(pose.world.back()[3].x, 200'000.0f);  // whole numbers below 2^24: exact
}

TEST(Bounds, AreTightAroundWhatIsFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec3> positions{{1, -2, 3}, {nan, 90, 90}, {-4, 5, 0}, {90, infinity, 90}};
    const motion::Bounds bounds = motion::bounds_of(positions);
    EXPECT_EQ(bounds.min, glm::vec3(-4, -2, 0));
    EXPECT_EQ(bounds.max, glm::vec3(1, 5, 3));
    EXPECT_EQ(bounds.size(), glm::vec3(5, 7, 3));
    EXPECT_EQ(motion::bounds_of({}).max, glm::vec3(0));
    EXPECT_EQ(motion::bounds_of(std::vector<glm::vec3>{{nan, 1, 1}}).min, glm::vec3(0));
}

}  // namespace
