#include "motion/pose_table.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "motion/octahedral.h"
#include "motion/schedule.h"
#include "tests/motion/rig.h"

namespace {

constexpr std::size_t plenty = std::size_t{1} << 30;  // [bytes]

// Octahedral signed bytes: at worst 1/127 of the square off, which the folding stretches to a little over a degree.
constexpr float normal_cosine = 0.9997f;

struct Surface {
    std::vector<glm::vec3> positions, normals;
};

Surface skinned(const model::Character& character, int clip, double time) {
    motion::Pose pose;
    Surface surface;
    motion::evaluate(character, character.clips[static_cast<std::size_t>(clip)], time, pose);
    motion::skin(character.mesh, pose, surface.positions, surface.normals);
    return surface;
}

// Half a step of 16 bits over the box, and a rounding of float at the box's size.
glm::vec3 step_of(const motion::PoseTable& table) {
    return table.box.size() * (0.5f / 65535.0f + 4e-7f);
}

std::vector<motion::SurfacePoint> scatter(const model::Mesh& mesh, int count) {
    tests::Random random(77);
    std::vector<motion::SurfacePoint> points;
    for (int i = 0; i < count; ++i) {
        const auto triangle = static_cast<std::uint32_t>(random(0.0f, static_cast<float>(mesh.triangle_count())));
        const float u = random(0.0f, 1.0f);
        points.push_back({triangle, u, random(0.0f, 1.0f) * (1.0f - u)});
    }
    return points;
}

model::Character two_clips() {
    model::Character character = tests::make_tentacle(11, 5, 0.5f);
    character.clips.push_back(tests::make_tentacle(12, 5, 0.8f).clips[0]);
    return character;
}

TEST(PoseTable, HoldsWhatSkinningGives) {
    const model::Character character = two_clips();
    const std::vector<int> clips{1, 0};
    const motion::PoseTable table = motion::bake_poses(character, clips, {}, plenty);
    ASSERT_EQ(table.clips.size(), 2u);
    EXPECT_EQ(table.clips[0].pose_count, 48);  // 0.8 s at 60 Hz
    EXPECT_EQ(table.clips[1].pose_count, 30);
    const glm::vec3 step = step_of(table);
    for (std::size_t slot = 0; slot < clips.size(); ++slot) {
        for (int i = 0; i < table.clips[slot].pose_count; ++i) {
            const Surface expected = skinned(character, clips[slot], i / 60.0);
            const std::size_t first = static_cast<std::size_t>((table.clips[slot].first_pose + i) * table.vertex_count);
            for (std::size_t v = 0; v < expected.positions.size(); ++v) {
                const glm::vec3 got = motion::unpack_position(table.vertices[first + v], table.box);
                ASSERT_TRUE(glm::all(glm::lessThanEqual(glm::abs(got - expected.positions[v]), step)));
                ASSERT_GT(glm::dot(motion::unpack_normal(table.vertices[first + v]), expected.normals[v]),
                          normal_cosine);
            }
        }
    }
}

TEST(PoseTable, PointsStayOnTheirTriangles) {
    const model::Character character = two_clips();
    const std::vector<motion::SurfacePoint> points = scatter(character.mesh, 500);
    const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0}, points, plenty);
    const float reach = 2.0f * glm::length(step_of(table));
    for (int pose = 0; pose < table.pose_count; ++pose) {
        const Surface surface = skinned(character, 0, pose / 60.0);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 got =
                motion::unpack_position(table.points[static_cast<std::size_t>(pose) * points.size() + i], table.box);
            const std::uint32_t* corner = &character.mesh.indices[points[i].triangle * 3];
            const glm::vec3 a = surface.positions[corner[0]], b = surface.positions[corner[1]],
                            c = surface.positions[corner[2]];
            const glm::vec3 normal = glm::cross(b - a, c - a);
            ASSERT_LT(std::abs(glm::dot(got - a, glm::normalize(normal))), reach);
            // Inside: the three sub-triangles wind the same way, up to the quantisation of one corner.
            const float slack = reach * (glm::length(b - a) + glm::length(c - a)) * glm::length(normal);
            ASSERT_GT(glm::dot(glm::cross(b - a, got - a), normal), -slack);
            ASSERT_GT(glm::dot(glm::cross(c - b, got - b), normal), -slack);
            ASSERT_GT(glm::dot(glm::cross(a - c, got - c), normal), -slack);
        }
    }
}

TEST(PoseTable, BoxesHoldEveryPose) {
    const model::Character character = two_clips();
    const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0, 1}, {}, plenty);
    for (int clip = 0; clip < 2; ++clip) {
        glm::vec3 low(1e9f), high(-1e9f);
        for (int i = 0; i < table.clips[static_cast<std::size_t>(clip)].pose_count; ++i) {
            const motion::Bounds box = motion::bounds_of(skinned(character, clip, i / 60.0).positions);
            low = glm::min(low, box.min);
            high = glm::max(high, box.max);
            if (clip == 0 && i == 0) {
                EXPECT_EQ(table.rest_height, box.size().y);
            }
        }
        EXPECT_EQ(table.clip_boxes[static_cast<std::size_t>(clip)].min, low);  // tight, too
        EXPECT_EQ(table.clip_boxes[static_cast<std::size_t>(clip)].max, high);
    }
    EXPECT_EQ(table.box.min, glm::min(table.clip_boxes[0].min, table.clip_boxes[1].min));
    EXPECT_EQ(table.box.max, glm::max(table.clip_boxes[0].max, table.clip_boxes[1].max));
}

TEST(PoseTable, TakesTheDensestRateThatFits) {
    const model::Character character = two_clips();
    const std::vector<int> clips{0, 1};
    const std::size_t bytes =
        motion::bake_poses(character, clips, {}, plenty).vertices.size() * sizeof(motion::PosedVertex);
    for (int spacing = 2; spacing <= 10; ++spacing) {
        const motion::PoseTable table =
            motion::bake_poses(character, clips, {}, bytes / static_cast<std::size_t>(spacing));
        ASSERT_LE(table.vertices.size() * sizeof(motion::PosedVertex), bytes / static_cast<std::size_t>(spacing));
        // Rounding a clip to whole poses may cost one step of the rate, never more.
        ASSERT_GE(table.clips[0].ticks_per_pose, spacing - 1);
        ASSERT_LE(table.clips[0].ticks_per_pose, spacing + 1);
        for (const motion::ClipPoses& clip : table.clips) ASSERT_EQ(clip.ticks_per_pose, table.clips[0].ticks_per_pose);
    }
}

TEST(PoseTable, RefusesABudgetBelowOnePoseAClip) {
    const model::Character character = two_clips();
    const std::size_t one_pose = character.mesh.vertex_count() * sizeof(motion::PosedVertex);
    EXPECT_NO_THROW(motion::bake_poses(character, std::vector<int>{0, 1}, {}, 2 * one_pose));
    EXPECT_THROW(motion::bake_poses(character, std::vector<int>{0, 1}, {}, 2 * one_pose - 1), std::runtime_error);
    EXPECT_THROW(motion::bake_poses(character, std::vector<int>{0}, {}, 0), std::runtime_error);
}

TEST(PoseTable, RefusesSurfacesWithoutArea) {
    model::Character flat = two_clips();
    for (glm::vec3& position : flat.mesh.positions) position = glm::vec3(1, 2, 3);
    for (auto& joints : flat.mesh.joints) joints = {};
    for (auto& weights : flat.mesh.weights) weights = {1, 0, 0, 0};
    EXPECT_THROW(motion::bake_poses(flat, std::vector<int>{0}, {}, plenty), std::runtime_error);
    EXPECT_THROW(motion::bake_poses(model::Character{}, {}, {}, plenty), std::runtime_error);
}

TEST(PoseTable, WithoutClipsHoldsTheRestPose) {
    const model::Character character = two_clips();
    const motion::PoseTable table = motion::bake_poses(character, {}, {}, plenty);
    ASSERT_EQ(table.pose_count, 1);
    ASSERT_EQ(table.clips.size(), 1u);
    EXPECT_EQ(table.clips[0].ticks(), 1);
    motion::Pose pose;
    Surface rest;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, rest.positions, rest.normals);
    for (std::size_t i = 0; i < rest.positions.size(); ++i)
        ASSERT_LT(glm::distance(motion::unpack_position(table.vertices[i], table.box), rest.positions[i]),
                  2 * glm::length(step_of(table)));
}

TEST(PoseTable, LoopsWithoutRepeatingAPose) {
    const model::Character character = two_clips();
    const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0, 1}, {}, plenty);
    EXPECT_EQ(table.pose_at(0, 0), 0);
    EXPECT_EQ(table.pose_at(0, 29), 29);
    EXPECT_EQ(table.pose_at(0, 30), 0);
    EXPECT_EQ(table.pose_at(0, -1), 29);
    EXPECT_EQ(table.pose_at(1, 0), 30);
    EXPECT_EQ(table.pose_at(1, 48'000'000'000 + 47), 77);
    motion::PoseTable sparse = table;
    sparse.clips[0] = {0, 10, 3};
    EXPECT_EQ(sparse.pose_at(0, 2), 0);
    EXPECT_EQ(sparse.pose_at(0, 3), 1);
    EXPECT_EQ(sparse.pose_at(0, 29), 9);
    EXPECT_EQ(sparse.pose_at(0, 30), 0);
}

TEST(PoseTable, AbsurdDurationsFitTheBudgetToo) {
    model::Character character = two_clips();
    for (const double duration : {-1.0, 0.0, 1e-9, 1e30, std::nan(""), std::numeric_limits<double>::infinity()}) {
        character.clips[0].duration = duration;
        const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0}, {}, 1'000'000);
        EXPECT_GE(table.pose_count, 1) << duration;
        EXPECT_GE(table.clips[0].ticks(), 1) << duration;
        EXPECT_LE(table.vertices.size() * sizeof(motion::PosedVertex), 1'000'000u) << duration;
    }
}

TEST(PoseTable, IsTheSameBitsOnAnyThreadCount) {
    const model::Character character = two_clips();
    const std::vector<motion::SurfacePoint> points = scatter(character.mesh, 100);
    const auto bake = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return motion::bake_poses(character, std::vector<int>{0, 1}, points, plenty);
    };
    const motion::PoseTable one = bake(1), four = bake(4);
    ASSERT_EQ(one.vertices.size(), four.vertices.size());
    EXPECT_EQ(std::memcmp(one.vertices.data(), four.vertices.data(), one.vertices.size() * sizeof(motion::PosedVertex)),
              0);
    EXPECT_EQ(std::memcmp(one.points.data(), four.points.data(), one.points.size() * sizeof(motion::PosedVertex)), 0);
    EXPECT_EQ(one.area, four.area);
}

TEST(PoseTable, ProgressOnlyRisesAndEndsAtOne) {
    double last = 0;
    int calls = 0;
    motion::bake_poses(two_clips(), std::vector<int>{0, 1}, {}, plenty, [&](double fraction) {
        EXPECT_GT(fraction, last);
        last = fraction;
        ++calls;
    });
    EXPECT_EQ(last, 1.0);
    EXPECT_GT(calls, 10);
}

TEST(PoseTable, AreaIsTheLargestOverThePoses) {
    const model::Character character = two_clips();
    const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0}, {}, plenty);
    double largest = 0;
    for (int i = 0; i < table.pose_count; ++i) {
        const Surface surface = skinned(character, 0, i / 60.0);
        double area = 0;
        for (std::size_t t = 0; t < character.mesh.indices.size(); t += 3) {
            const auto at = [&](std::size_t k) { return glm::dvec3(surface.positions[character.mesh.indices[t + k]]); };
            area += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        }
        largest = std::max(largest, area);
    }
    EXPECT_NEAR(table.area, largest, 1e-5 * largest);
}

// Three clips of different lengths, asked for out of order.
model::Character three_clips() {
    model::Character character = tests::make_rig(5, 3);
    const double lengths[] = {0.61, 1.0 / 60, 1.3};  // [s] neither is whole at every rate
    for (std::size_t i = 0; i < 3; ++i) character.clips[i].duration = lengths[i];
    return character;
}

const std::vector<int> out_of_order{2, 0, 1};

// Which tick of its own a person is at, seen from anywhere in time.
std::int64_t wrapped(std::int64_t tick, std::int64_t period) {
    while (tick < 0) tick += period;
    while (tick >= period) tick -= period;
    return tick;
}

TEST(PoseTable, EveryTickFindsThePoseOfItsTimeAtAnySpacing) {
    const model::Character character = three_clips();
    const std::vector<motion::SurfacePoint> points = scatter(character.mesh, 40);
    const std::size_t bytes_per_pose = (character.mesh.vertex_count() + points.size()) * sizeof(motion::PosedVertex);
    for (const std::size_t most : {1000u, 70u, 31u, 9u, 3u}) {
        const motion::PoseTable table = motion::bake_poses(character, out_of_order, points, most * bytes_per_pose);
        ASSERT_LE(static_cast<std::size_t>(table.pose_count), most);
        const glm::vec3 step = 1.1f * step_of(table);
        for (int clip = 0; clip < 3; ++clip) {
            const motion::ClipPoses& poses = table.clips[static_cast<std::size_t>(clip)];
            for (std::int64_t tick = -2 * poses.ticks() - 1; tick <= 2 * poses.ticks(); ++tick) {
                SCOPED_TRACE(testing::Message() << most << " poses, clip " << clip << ", tick " << tick);
                const std::int64_t held = wrapped(tick, poses.ticks()) / poses.ticks_per_pose * poses.ticks_per_pose;
                const Surface expected = skinned(character, out_of_order[static_cast<std::size_t>(clip)],
                                                 static_cast<double>(held) / motion::ticks_per_second);
                const auto pose = static_cast<std::size_t>(table.pose_at(clip, tick));
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const std::uint32_t* corner = &character.mesh.indices[3 * points[i].triangle];
                    const float u = points[i].u, v = points[i].v;
                    const auto blended = [&](const std::vector<glm::vec3>& of) {
                        return of[corner[0]] + u * (of[corner[1]] - of[corner[0]]) +
                               v * (of[corner[2]] - of[corner[0]]);
                    };
                    const motion::PosedVertex& got = table.points[pose * points.size() + i];
                    const glm::vec3 off =
                        glm::abs(motion::unpack_position(got, table.box) - blended(expected.positions));
                    ASSERT_TRUE(glm::all(glm::lessThanEqual(off, step)));
                    const glm::vec3 normal = blended(expected.normals);
                    if (glm::length(normal) < 0.1f) continue;  // the corners' cancel out
                    ASSERT_GT(glm::dot(motion::unpack_normal(got), glm::normalize(normal)), normal_cosine);
                }
            }
        }
    }
}

TEST(PoseTable, AClipsPeriodIsItsDurationToHalfAPose) {
    const model::Character character = three_clips();
    const std::size_t bytes_per_pose = character.mesh.vertex_count() * sizeof(motion::PosedVertex);
    for (const std::size_t most : {1000u, 70u, 31u, 9u}) {
        const motion::PoseTable table = motion::bake_poses(character, out_of_order, {}, most * bytes_per_pose);
        int next = 0;
        for (std::size_t slot = 0; slot < 3; ++slot) {
            const motion::ClipPoses& poses = table.clips[slot];
            const double duration = character.clips[static_cast<std::size_t>(out_of_order[slot])].duration;
            EXPECT_EQ(poses.first_pose, next);
            next += poses.pose_count;
            if (poses.pose_count == 1) {
                EXPECT_LE(poses.ticks_per_pose, std::max(1.0, duration * motion::ticks_per_second + 0.5));
            } else {
                // Rounded to ticks, and these to poses.
                const double off = 0.5 + (poses.ticks_per_pose > 1 ? 0.5 * poses.ticks_per_pose : 0.0);
                EXPECT_NEAR(poses.ticks(), duration * motion::ticks_per_second, off);
            }
        }
        EXPECT_EQ(table.pose_count, next);
    }
}

TEST(PoseTable, PointsCountAgainstTheBudgetToo) {
    const model::Character character = two_clips();
    const std::vector<motion::SurfacePoint> points = scatter(character.mesh, 777);
    for (const std::size_t budget : {std::size_t{40'000}, std::size_t{200'000}}) {
        const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0, 1}, points, budget);
        EXPECT_LE((table.vertices.size() + table.points.size()) * sizeof(motion::PosedVertex), budget);
    }
}

TEST(PoseTable, HeightAndFloorAreThoseOfTheFirstPoseAlone) {
    model::Character character = two_clips();
    for (const int clip : {0, 1}) {
        const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{clip, 1 - clip}, {}, plenty);
        const motion::Bounds first = motion::bounds_of(skinned(character, clip, 0).positions);
        EXPECT_EQ(table.rest_height, first.size().y);
        EXPECT_EQ(table.floor, first.min.y);
        EXPECT_LT(table.box.min.y, table.floor);  // some pose reaches lower
        EXPECT_GT(table.box.size().y, table.rest_height);
    }
}

TEST(PoseTable, OfAFlatPoseTheLongestSideStandsForTheHeight) {
    for (const glm::vec3 sides : {glm::vec3(3, 0, 1), glm::vec3(1, 0, 3)}) {
        model::Character sheet;
        sheet.skeleton.nodes.resize(1);
        sheet.skeleton.palette.push_back({0, glm::mat4(1.0f)});
        sheet.mesh.positions = {{0, 2, 0}, {sides.x, 2, 0}, {0, 2, sides.z}};
        sheet.mesh.normals.assign(3, glm::vec3(0, 1, 0));
        sheet.mesh.joints.resize(3);
        sheet.mesh.weights.assign(3, glm::vec4(1, 0, 0, 0));
        sheet.mesh.indices = {0, 2, 1};
        const motion::PoseTable table = motion::bake_poses(sheet, {}, {}, plenty);
        EXPECT_EQ(table.rest_height, 3.0f);
        EXPECT_EQ(table.floor, 2.0f);
        // Without any height, all is on the box's one level.
        EXPECT_EQ(motion::unpack_position(table.vertices[1], table.box), sheet.mesh.positions[1]);
    }
}

TEST(PoseTable, TheBoxesCornersAreExact) {
    const model::Character character = two_clips();
    const motion::PoseTable table = motion::bake_poses(character, std::vector<int>{0, 1}, {}, plenty);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const motion::PosedVertex& vertex : table.vertices) {
        low = glm::min(low, motion::unpack_position(vertex, table.box));
        high = glm::max(high, motion::unpack_position(vertex, table.box));
    }
    constexpr float rounding = 1e-6f;  // of min + (max - min)
    EXPECT_EQ(low, table.box.min);
    EXPECT_LT(glm::distance(high, table.box.max), rounding);
}

TEST(PoseTable, AreaIsTheLargestOfAnyClip) {
    model::Character character = two_clips();
    const float first = motion::bake_poses(character, std::vector<int>{0}, {}, plenty).area,
                second = motion::bake_poses(character, std::vector<int>{1}, {}, plenty).area;
    EXPECT_NE(first, second);
    for (const std::vector<int>& order : {std::vector<int>{0, 1}, {1, 0}})
        EXPECT_EQ(motion::bake_poses(character, order, {}, plenty).area, std::max(first, second));
}

TEST(PackedNormal, EveryCodeUnpacksToAUnitVector) {
    for (int u = -127; u <= 127; ++u) {
        for (int v = -127; v <= 127; ++v) {
            const auto code = motion::OctahedralNormal{static_cast<std::int8_t>(u), static_cast<std::int8_t>(v)};
            ASSERT_NEAR(glm::length(motion::unpack_normal(code)), 1.0f, 1e-5f);
            ASSERT_EQ(motion::unpack_normal(code), motion::unpack_normal({0, 0, 0, code.u, code.v}));
        }
    }
}

// Octants, the rims between them and the axes are where a fold goes wrong.
std::vector<glm::vec3> directions_of_every_kind() {
    std::vector<glm::vec3> directions;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
    tests::Random random(21);
    for (int i = 0; i < 100'000; ++i) directions.push_back(random.rotation() * glm::vec3(0, 0, 1));
    for (int i = 0; i < 1000; ++i) {  // a hair off a rim
        glm::vec3 near = directions[static_cast<std::size_t>(30 + i)];
        near[i % 3] = random(-1e-6f, 1e-6f);
        directions.push_back(near);
    }
    return directions;
}

TEST(PackedNormal, ComesBackWithinAStepAllOverTheSphere) {
    // Half a step, 1 / 254, in both of the square's axes is sqrt(6) / 254 on the octahedron's face, whose middle is
    // 1 / sqrt(3) from the origin.
    constexpr double promised = 0.0168;  // [rad]
    for (const glm::vec3& direction : directions_of_every_kind()) {
        const glm::dvec3 got = motion::unpack_normal(motion::pack_normal(direction)),
                         wanted = glm::normalize(glm::dvec3(direction));
        ASSERT_LT(std::atan2(glm::length(glm::cross(got, wanted)), glm::dot(got, wanted)), promised)
            << direction.x << ' ' << direction.y << ' ' << direction.z;
    }
}

TEST(PackedNormal, LengthDoesNotMatterAndAxesAreExact) {
    for (const glm::vec3& direction : directions_of_every_kind()) {
        const motion::OctahedralNormal unit = motion::pack_normal(glm::normalize(direction)),
                                       longer = motion::pack_normal(1024.0f * glm::normalize(direction));
        ASSERT_EQ(std::pair(unit.u, unit.v), std::pair(longer.u, longer.v));
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 normal(0);
            normal[axis] = sign;
            EXPECT_EQ(motion::unpack_normal(motion::pack_normal(normal)), normal);
        }
    }
}

TEST(PackedNormal, WhatHasNoDirectionIsUp) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    for (const glm::vec3& none :
         {glm::vec3(0), glm::vec3(nan, 1, 0), glm::vec3(0, 0, -infinity), glm::vec3(1, nan, -1)})
        EXPECT_EQ(motion::unpack_normal(motion::pack_normal(none)), glm::vec3(0, 0, 1));
}

}  // namespace
