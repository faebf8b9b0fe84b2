// .pts files: what comes back of a model, that it stays so, and that nothing but whole files is read.
#include "pointsample/points_file.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "motion/octahedral.h"
#include "tests/model/folder.h"
#include "tests/pointsample/models.h"

namespace {

using pointsample::PointModel;
using pointsample::PointsFile;

// Octahedral, 8 bits an axis: a step is 1 / 127 of the octahedron's face, widest in its middle.
constexpr float normal_step = 0.017f;  // [rad]

std::string written(const PointModel& model, const std::string& key = "key") {
    std::ostringstream out;
    pointsample::write_pts(out, model, key);
    return out.str();
}

PointModel read_back(const std::string& bytes) {
    const tests::TemporaryFolder folder;
    return PointsFile(folder.write("model.pts", bytes)).unpack();
}

template <typename Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

void expect_same_bits(const PointModel& a, const PointModel& b) {
    EXPECT_TRUE(same_bits(a.surface, b.surface));
    EXPECT_TRUE(same_bits(a.positions, b.positions));
    EXPECT_TRUE(same_bits(a.normals, b.normals));
    EXPECT_TRUE(same_bits(a.colors, b.colors));
    EXPECT_TRUE(same_bits(a.slots, b.slots));
    EXPECT_TRUE(same_bits(a.own_lights, b.own_lights));
    EXPECT_TRUE(same_bits(a.joints, b.joints));
    EXPECT_TRUE(same_bits(a.weights, b.weights));
    EXPECT_TRUE(same_bits(a.spacing, b.spacing));
    EXPECT_TRUE(same_bits(a.coverage, b.coverage));
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(a.hidden_removed, b.hidden_removed);
}

// --- What comes back

TEST(PointsFile, WhatIsExactStaysExact) {
    const PointModel model = tests::random_model(5000, 1), back = read_back(written(model));
    ASSERT_EQ(back.size(), model.size());
    for (std::size_t i = 0; i < model.size(); ++i) ASSERT_EQ(back.surface[i].triangle, model.surface[i].triangle);
    EXPECT_EQ(back.colors, model.colors);
    EXPECT_EQ(back.slots, model.slots);
    EXPECT_EQ(back.joints, model.joints);
    EXPECT_TRUE(same_bits(back.spacing, model.spacing));
    EXPECT_TRUE(same_bits(back.coverage, model.coverage));
    EXPECT_EQ(back.area, model.area);
    EXPECT_EQ(back.hidden_removed, model.hidden_removed);
}

TEST(PointsFile, OwnLightsAreExactAndCostNothingWhereThereAreNone) {
    PointModel model = tests::random_model(500, 4);
    const std::size_t without = written(model).size();
    EXPECT_TRUE(read_back(written(model)).own_lights.empty());
    for (std::size_t i = 0; i < model.size(); ++i) model.own_lights.emplace_back(i, 3 * i, 7 * i, 255 - i);
    EXPECT_EQ(read_back(written(model)).own_lights, model.own_lights);
    EXPECT_LE(written(model).size(), without + 4 * model.size() + 64);
    EXPECT_GE(written(model).size(), without + 4 * model.size());
}

TEST(PointsFile, PositionsAreWithinHalfAStepOfTheBox) {
    for (const float place : {0.0f, 1.0f, -50.0f}) {
        PointModel model = tests::random_model(5000, 2);
        for (glm::vec3& position : model.positions) position += place;
        const PointModel back = read_back(written(model));
        const glm::vec3 size = motion::bounds_of(model.positions).size();
        for (std::size_t i = 0; i < model.size(); ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const float rounding = std::abs(back.positions[i][axis]) * std::numeric_limits<float>::epsilon();
                ASSERT_LE(std::abs(back.positions[i][axis] - model.positions[i][axis]),
                          size[axis] / 131070 * 1.0001f + rounding);
            }
    }
}

TEST(PointsFile, TheOriginIsExact) {
    PointModel model = tests::random_model(20, 5);
    const std::string near = written(model);
    model.origin = {500000.37, -5.8e6, 1e-300};
    EXPECT_EQ(read_back(written(model)).origin, model.origin);
    EXPECT_EQ(pointsample::as_stored(model).origin, model.origin);
    // Files of before it had a meaning have zeros there.
    EXPECT_EQ(near.substr(152, 40), std::string(40, '\0'));
    EXPECT_EQ(read_back(near).origin, glm::dvec3(0.0));
}

TEST(PointsFile, TheBoxIsExact) {
    const PointModel model = tests::random_model(500, 3);
    const tests::TemporaryFolder folder;
    const PointsFile file(folder.write("model.pts", written(model)));
    const motion::Bounds box = motion::bounds_of(model.positions), back = motion::bounds_of(file.unpack().positions);
    EXPECT_EQ(file.box().min, box.min);
    EXPECT_EQ(file.box().max, box.max);
    EXPECT_EQ(back.min, box.min);
    EXPECT_EQ(back.max, box.max);
}

TEST(PointsFile, NormalsAreWithinAStep) {
    const PointModel model = tests::random_model(20000, 4), back = read_back(written(model));
    for (std::size_t i = 0; i < model.size(); ++i) {
        ASSERT_NEAR(glm::length(back.normals[i]), 1.0f, 1e-6f);
        ASSERT_LT(glm::length(glm::cross(back.normals[i], model.normals[i])), normal_step);
        ASSERT_GT(glm::dot(back.normals[i], model.normals[i]), 0.99f);
    }
}

// The point on a triangle moves less than 2^-16 of its longest edge: u and v by at most half of 1 / 65535 each.
TEST(PointsFile, PointsStayOnTheirTriangles) {
    constexpr double most = 0.5 / 65535 * 1.0001;
    PointModel model = tests::random_model(5000, 5);
    model.surface[0] = {0, 0, 0};
    model.surface[1] = {0, 1, 0};
    model.surface[2] = {0, 0, 1};
    model.surface[3] = {0, 0.5f, 0.5f};
    model.surface[4] = {0, 32767.5f / 65535, 32767.5f / 65535};
    for (std::size_t i = 5; i < 1000; ++i)  // on the edge between the second and third corner
        model.surface[i].v = 1.0f - model.surface[i].u;
    const PointModel back = read_back(written(model));
    for (std::size_t i = 0; i < model.size(); ++i) {
        const motion::SurfacePoint &before = model.surface[i], &after = back.surface[i];
        ASSERT_NEAR(after.u, before.u, most) << i;
        ASSERT_NEAR(after.v, before.v, most) << i;
        ASSERT_GE(after.u, 0.0f);
        ASSERT_GE(after.v, 0.0f);
        ASSERT_LE(after.u + after.v, 1.0f);
    }
    for (const std::size_t corner : {0, 1, 2}) {
        EXPECT_EQ(back.surface[corner].u, model.surface[corner].u);
        EXPECT_EQ(back.surface[corner].v, model.surface[corner].v);
    }
}

TEST(PointsFile, WeightsAreWithinAByteAndSumToOne) {
    PointModel model = tests::random_model(5000, 6);
    model.weights[0] = {0.25f, 0.25f, 0.25f, 0.25f};
    model.weights[1] = {0.999f, 0.001f, 0, 0};
    const PointModel back = read_back(written(model));
    for (std::size_t i = 0; i < model.size(); ++i) {
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
            sum += back.weights[i][k];
            ASSERT_NEAR(back.weights[i][k], model.weights[i][k], 1.0f / 255);
            ASSERT_TRUE(model.weights[i][k] > 0.0f || back.weights[i][k] == 0.0f);
        }
        ASSERT_NEAR(sum, 1.0f, 1e-6f);
    }
}

TEST(PointsFile, PointsWithoutWeightsFollowTheirFirstJoint) {
    PointModel model = tests::random_model(1, 7);
    model.weights[0] = glm::vec4(0.0f);
    EXPECT_EQ(read_back(written(model)).weights[0], glm::vec4(1, 0, 0, 0));
}

// --- That it stays so

TEST(PointsFile, AsStoredIsWhatIsReadBack) {
    const PointModel model = tests::random_model(3000, 16);
    expect_same_bits(pointsample::as_stored(model), read_back(written(model)));
}

TEST(PointsFile, WrittenAgainTheBitsAreTheSame) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const std::string once = written(tests::random_model(1 + 400 * seed, seed));
        const std::string twice = written(read_back(once));
        EXPECT_EQ(once.size(), twice.size());
        expect_same_bits(read_back(once), read_back(twice));
    }
}

// Far from the origin floats are as coarse as steps, or coarser.
TEST(PointsFile, WrittenAgainTheBitsAreTheSameWhereverTheModelIs) {
    for (const float place : {1e-30f, 0.015625f, 100.0f, 1000.0f, 1024.0f, 4096.0f, 65536.0f, 1e7f, -1e9f, 1e30f})
        for (const float size : {0.0f, 1e-38f, 1.0f, 1.0f / 3, 1e20f}) {
            PointModel model = tests::random_model(3000, 9);
            for (glm::vec3& position : model.positions) position = position * size + place;
            model.positions[1] = -model.positions[0] * 0.0f;  // -0 among them
            const PointModel once = read_back(written(model));
            SCOPED_TRACE(testing::Message() << place << " " << size);
            expect_same_bits(once, read_back(written(once)));
        }
}

// Every code that packing can give.
TEST(PointsFile, EveryNormalThatIsReadIsReadAgain) {
    std::vector<glm::vec3> normals;
    for (int u = -127; u <= 127; ++u) {
        for (int v = -127; v <= 127; ++v) {
            const motion::OctahedralNormal code{static_cast<std::int8_t>(u), static_cast<std::int8_t>(v)};
            normals.push_back(motion::unpack_normal(code));
        }
    }
    PointModel model = tests::random_model(normals.size(), 9);
    model.normals = normals;
    EXPECT_TRUE(same_bits(read_back(written(model)).normals, normals));
}

TEST(PointsFile, TheSameModelGivesTheSameBytes) {
    EXPECT_TRUE(written(tests::random_model(1000, 10)) == written(tests::random_model(1000, 10)));
}

TEST(PointsFile, SectionsAreAlignedAndAPointTakes37Bytes) {
    PointModel few = tests::random_model(6400, 11), many = tests::random_model(12800, 11);
    many.coverage = few.coverage;
    const std::string small = written(few);
    EXPECT_EQ(written(many).size() - small.size(), 37u * 6400);
    const tests::TemporaryFolder folder;
    const PointsFile file(folder.write("model.pts", small));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(file.points().data()) % 64, 0u);
    EXPECT_EQ(file.points().size(), 6400u);
}

TEST(PointsFile, KeysComeBackWhateverTheyHold) {
    const tests::TemporaryFolder folder;
    for (const std::string& key : {std::string(), std::string("a\0b\n\xff", 5), std::string(65536, 'k')})
        EXPECT_EQ(PointsFile(folder.write("model.pts", written(tests::random_model(3, 12), key))).key(), key);
}

TEST(PointsFile, ModelsWithoutPointsAreFilesToo) {
    const PointModel back = read_back(written(PointModel()));
    EXPECT_EQ(back.size(), 0u);
    EXPECT_TRUE(back.coverage.empty());
}

// --- That nothing else is read

// The message of the refusal; empty if it was read.
std::string refusal(const std::string& bytes) {
    const tests::TemporaryFolder folder;
    try {
        const PointsFile file(folder.write("model.pts", bytes));
        return "";
    } catch (const std::runtime_error& error) {
        const std::string said = error.what();
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        EXPECT_NE(said.find("model.pts: found "), std::string::npos) << said;
        EXPECT_NE(said.find("expected "), std::string::npos) << said;
        return said;
    }
}

TEST(PointsFileRefuses, EveryTruncation) {
    const std::string whole = written(tests::random_model(20, 13));
    for (std::size_t length = 0; length < whole.size(); ++length) ASSERT_NE(refusal(whole.substr(0, length)), "");
    EXPECT_NE(refusal(whole + '\0'), "");
    EXPECT_EQ(refusal(whole), "");
}

TEST(PointsFileRefuses, EveryFlippedBit) {
    const std::string whole = written(tests::random_model(20, 14));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
        ASSERT_NE(refusal(damaged), "") << i;
    }
}

template <typename Value>
std::string patched(std::string bytes, std::size_t at, Value value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    const std::uint64_t sum = XXH3_64bits(bytes.data(), bytes.size() - sizeof(std::uint64_t));
    std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
    return bytes;
}

// Offsets as docs/pts-format.md has them.
TEST(PointsFileRefuses, LiesWithAChecksumThatFits) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string whole = written(tests::random_model(20, 15));
    EXPECT_EQ(refusal(patched(whole, 0, whole[0])), "");
    EXPECT_NE(
        refusal(patched(whole, 160, std::numeric_limits<double>::quiet_NaN())).find("found an origin that is no place"),
        std::string::npos);
    EXPECT_NE(refusal(patched(whole, 8, std::uint32_t{2})).find("found version 2; expected version 1"),
              std::string::npos);
    EXPECT_NE(refusal(patched(whole, 12, std::uint32_t{0x04030201})).find("byte order"), std::string::npos);
    for (const std::size_t place : {16, 24, 32})  // the file's size, points, coverage
        for (const std::uint64_t lie :
             {std::uint64_t{0}, std::uint64_t{19}, std::uint64_t{1} << 32, std::uint64_t{1} << 62, ~std::uint64_t{0}})
            EXPECT_NE(refusal(patched(whole, place, lie)), "") << place << " " << lie;
    EXPECT_NE(refusal(patched(whole, 76, ~std::uint32_t{0})), "");
    for (std::size_t place = 80; place < 152; place += 8)
        for (const std::uint64_t lie : {std::uint64_t{0}, std::uint64_t{1}, whole.size(), ~std::uint64_t{0} - 63})
            EXPECT_NE(refusal(patched(whole, place, lie)), "") << place << " " << lie;
    for (const std::size_t place : {48, 60, 72}) EXPECT_NE(refusal(patched(whole, place, nan)), "") << place;
    EXPECT_NE(refusal(patched(whole, 48, 1e9f)), "");  // the box's least corner
    const auto section = [&](std::size_t index) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, whole.data() + 80 + 8 * index, sizeof offset);
        return static_cast<std::size_t>(offset);
    };
    EXPECT_NE(refusal(patched(whole, section(1) + 11, model::Slot{model::slot_count + 1})), "");
    EXPECT_NE(refusal(patched(whole, section(1) + 6, std::int8_t{-128})), "");
    EXPECT_NE(refusal(patched(whole, section(3), ~std::uint32_t{0})), "");
    EXPECT_NE(refusal(patched(whole, section(5), ~std::uint32_t{0})), "");
    EXPECT_NE(refusal(patched(whole, section(6), nan)), "");
    EXPECT_NE(refusal(patched(whole, section(8), std::uint32_t{0})), "");
    EXPECT_NE(refusal(patched(whole, section(8) + 4, nan)), "");
}

TEST(PointsFileRefuses, WhatIsNoFileOfPoints) {
    EXPECT_NE(refusal("ply\n").find("found 4 bytes; expected a .pts file, of at least"), std::string::npos);
    EXPECT_NE(refusal(std::string(4096, 'x')).find("found a file of another kind"), std::string::npos);
    for (const char* path : {"/dev/zero", "/dev/null", "/tmp", "/no/such/file.pts", ""})
        EXPECT_THROW(PointsFile{path}, std::runtime_error) << path;
}

}  // namespace
