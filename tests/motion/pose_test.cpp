#include "motion/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/motion/tentacle.h"

namespace {

using motion::Channel;
using motion::Interpolation;
using motion::Path;

// An evaluator of its own, in double: no matrices, rotations by the sandwich product, arcs by axis and angle.
struct Turn {
    double x, y, z, w;
};

Turn times(const Turn& a, const Turn& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

Turn inverse(const Turn& q) {
    return {-q.x, -q.y, -q.z, q.w};
}

glm::dvec3 turned(const Turn& q, const glm::dvec3& v) {
    const Turn r = times(times(q, {v.x, v.y, v.z, 0}), inverse(q));
    return {r.x, r.y, r.z};
}

// a * (a^-1 b)^s, over the shorter way.
Turn between(const Turn& a, const Turn& b, double s) {
    Turn step = times(inverse(a), b);
    if (step.w < 0) step = {-step.x, -step.y, -step.z, -step.w};
    const double sine = std::sqrt(step.x * step.x + step.y * step.y + step.z * step.z);
    if (sine < 1e-12) return a;
    const double angle = std::atan2(sine, step.w) * s;
    const double scale = std::sin(angle) / sine;
    return times(a, {step.x * scale, step.y * scale, step.z * scale, std::cos(angle)});
}

struct Keys {
    std::size_t key;
    double s;
};

Keys locate(const Channel& channel, double time) {
    std::size_t key = 0;
    while (key + 2 < channel.times.size() && channel.times[key + 1] <= time) ++key;
    return {key, (time - channel.times[key]) / (static_cast<double>(channel.times[key + 1]) - channel.times[key])};
}

glm::dvec3 reference_vector(const Channel& channel, double time) {
    const auto [key, s] = locate(channel, time);
    const float* v = &channel.values[key * 3];
    return glm::dvec3(v[0], v[1], v[2]) * (1 - s) + glm::dvec3(v[3], v[4], v[5]) * s;
}

Turn reference_turn(const Channel& channel, double time) {
    const auto [key, s] = locate(channel, time);
    const float* v = &channel.values[key * 4];
    return between({v[0], v[1], v[2], v[3]}, {v[4], v[5], v[6], v[7]}, s);
}

// make_tentacle gives three channels a node, in the order translation, rotation, scale.
glm::dvec3 reference_position(const motion::Character& character, double time, std::size_t vertex) {
    const motion::Mesh& mesh = character.mesh;
    glm::dvec3 sum(0);
    for (int i = 0; i < 4; ++i) {
        const motion::PaletteEntry& entry = character.skeleton.palette[mesh.joints[vertex][i]];
        glm::dvec3 p = glm::dvec3(glm::dmat4(entry.inverse_bind) * glm::dvec4(mesh.positions[vertex], 1));
        for (int node = entry.node; node >= 0; node = character.skeleton.nodes[static_cast<std::size_t>(node)].parent) {
            const Channel* channels = &character.clips[0].channels[static_cast<std::size_t>(node) * 3];
            p = turned(reference_turn(channels[1], time), p * reference_vector(channels[2], time)) +
                reference_vector(channels[0], time);
        }
        sum += p * static_cast<double>(mesh.weights[vertex][i]);
    }
    return sum;
}

TEST(Pose, MatchesADoublePrecisionReference) {
    // Five levels of float matrices on coordinates of about 3: some tens of roundings of 2^-23.
    constexpr double tolerance = 2e-5;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const motion::Character character = tests::make_tentacle(seed);
        for (const double time : {0.0, 0.07, 0.3, 0.77, 1.2345, 1.5}) {
            motion::Pose pose;
            std::vector<glm::vec3> positions, normals;
            motion::evaluate(character, character.clips[0], time, pose);
            motion::skin(character.mesh, pose, positions, normals);
            for (std::size_t i = 0; i < positions.size(); ++i) {
                const glm::dvec3 expected = reference_position(character, time, i);
                ASSERT_LT(glm::distance(glm::dvec3(positions[i]), expected), tolerance)
                    << "seed " << seed << " time " << time;
            }
        }
    }
}

// One node with one channel; what its local matrix becomes.
glm::mat4 world_of(const Channel& channel, double time, const motion::Node& node = {}) {
    motion::Character character;
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
    motion::Node node;
    node.rest.translation = {7, 8, 9};
    node.rest_matrix = tests::matrix_of(node.rest);
    for (const Channel& channel : {Channel{0, Path::translation, Interpolation::linear, {}, {}},
                                   Channel{0, Path::translation, Interpolation::linear, {0, 1}, {1, 2}},
                                   Channel{0, Path::scale, Interpolation::cubic_spline, {0}, {1, 1, 1, 2, 2, 2}}})
        EXPECT_EQ(world_of(channel, 0.5, node), node.rest_matrix);
}

TEST(Pose, ShearedNodesStayShearedUnlessDriven) {
    motion::Node node;
    node.rest_matrix[1].x = 0.5f;
    const Channel drives_nothing{0, Path::morph_weights, Interpolation::linear, {0}, {1}};
    EXPECT_EQ(world_of(drives_nothing, 0, node)[1].x, 0.5f);
    motion::Character character;
    character.skeleton.nodes = {node};
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    EXPECT_EQ(pose.world[0][1].x, 0.5f);
}

TEST(Pose, ADeepChainNeedsNoStack) {
    motion::Character character;
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
