#include "scene/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "tests/scene/fake_cast.h"

namespace {

using scene::CameraKey;
using scene::CameraPath;
using scene::CameraPose;
using scene::Crowd;
using scene::StadiumPlan;

constexpr std::int64_t sizes[] = {1, 100, 20000, 60000, 200000, 1'000'000};
constexpr double degree = std::numbers::pi / 180;

CameraPath square_path() {
    CameraPath path;
    path.closed = true;
    path.keys = {{1, {{0, 1, 0}, {5, 0, 5}, 0.8}},
                 {2, {{10, 2, 0}, {5, 1, 5}, 0.9}},
                 {4, {{10, 5, 10}, {5, 0, 5}, 1.0}},
                 {7, {{0, 1, 10}, {5, 2, 5}, 0.7}},
                 {8, {{0, 1, 0}, {5, 0, 5}, 0.8}}};
    return path;
}

double difference(const CameraPose& a, const CameraPose& b) {
    return std::max(
        {glm::distance(a.position, b.position), glm::distance(a.target, b.target), std::abs(a.fov_y - b.fov_y)});
}

TEST(CameraPath, PassesThroughItsKeys) {
    const CameraPath path = square_path();
    for (const CameraKey& key : path.keys) EXPECT_LT(difference(path.at(key.time), key.pose), 1e-9);
}

TEST(CameraPath, AClosedPathRepeatsForEver) {
    const CameraPath path = square_path();
    for (double time = 1; time < 8; time += 0.137) {
        EXPECT_LT(difference(path.at(time), path.at(time + 7 * 1000)), 1e-6);
        EXPECT_LT(difference(path.at(time), path.at(time - 7 * 3)), 1e-6);
    }
}

TEST(CameraPath, AnOpenPathStaysAtItsEnds) {
    CameraPath path = square_path();
    path.closed = false;
    EXPECT_LT(difference(path.at(-100), path.keys.front().pose), 1e-9);
    EXPECT_LT(difference(path.at(100), path.keys.back().pose), 1e-9);
}

TEST(CameraPath, OneKeyIsAStill) {
    const CameraPath path{{{3, {{1, 2, 3}, {4, 5, 6}, 0.5}}}};
    for (const double time : {-1.0, 3.0, 1e6}) EXPECT_LT(difference(path.at(time), path.keys.front().pose), 1e-12);
}

TEST(CameraPath, ACutHoldsThePoseAndJumps) {
    CameraPath path = square_path();
    path.keys[2].cut = true;
    for (const double time : {2.0, 2.5, 3.999}) EXPECT_LT(difference(path.at(time), path.keys[1].pose), 1e-9);
    EXPECT_LT(difference(path.at(4), path.keys[2].pose), 1e-9);
}

TEST(CameraPath, ACutAtTheEndIsShown) {
    CameraPath path = square_path();
    path.closed = false;
    path.keys.back() = {8, {{-3, 2, 1}, {0, 0, 9}, 0.7}, true};
    EXPECT_LT(difference(path.at(7.999), path.keys[3].pose), 1e-9);
    for (const double time : {8.0, 9.0}) EXPECT_LT(difference(path.at(time), path.keys.back().pose), 1e-9);
}

// The shot before a cut is as if nothing came after it, and the shot after as if nothing had been before.
TEST(CameraPath, NothingIsBlendedAcrossACut) {
    CameraPath path = square_path();
    path.closed = false;
    path.keys[2].cut = true;
    const CameraPath before{{path.keys.begin(), path.keys.begin() + 2}};
    CameraPath after{{path.keys.begin() + 2, path.keys.end()}};
    after.keys.front().cut = false;
    for (double time = 0; time < 4; time += 0.05) EXPECT_LT(difference(path.at(time), before.at(time)), 1e-9);
    for (double time = 4; time < 9; time += 0.05) EXPECT_LT(difference(path.at(time), after.at(time)), 1e-9);
}

TEST(CameraPath, AllCutsAreASlideShow) {
    CameraPath path = square_path();
    for (std::size_t i = 1; i < path.keys.size(); ++i) path.keys[i].cut = true;
    for (std::size_t i = 0; i + 1 < path.keys.size(); ++i) {
        const double late = 0.999 * path.keys[i + 1].time + 0.001 * path.keys[i].time;
        EXPECT_LT(difference(path.at(late), path.keys[i].pose), 1e-9);
        EXPECT_LT(difference(path.at(late + 7), path.keys[i].pose), 1e-9);
    }
}

TEST(CameraPath, FieldOfViewStaysBetweenItsKeys) {
    const CameraPath path = square_path();
    for (double time = 1; time < 8; time += 0.01) {
        EXPECT_GE(path.at(time).fov_y, 0.7);
        EXPECT_LE(path.at(time).fov_y, 1.0);
    }
}

TEST(CameraPath, ATargetGivesTheDirectionHoweverNear) {
    const glm::dvec3 look = glm::normalize(glm::dvec3(2, -1, 3));
    for (const double distance : {1e5, 1.0, 1e-3, 1e-9, 1e-160, 1e-300}) {
        const scene::CameraPose pose{{0, 0, 0}, distance * look, 1};
        EXPECT_LT(glm::distance(pose.forward(), look), 1e-12) << distance;
        const CameraPath moving{{{0, pose}, {1, {{0, 0, 0}, 2 * distance * look, 1}}}};
        EXPECT_LT(glm::distance(moving.at(0.4).forward(), look), 1e-12) << distance;
    }
    const scene::CameraPose least{{0, 0, 0}, {0, std::numeric_limits<double>::denorm_min(), 0}, 1};
    EXPECT_EQ(least.forward(), glm::dvec3(0, 1, 0));
}

TEST(CameraPath, LooksSomewhereEvenWhereTargetAndPositionMeet) {
    const CameraPath path{{{0, {{0, 0, 0}, {2, 0, 0}, 1}}, {1, {{2, 0, 0}, {0, 0, 0}, 1}}}};
    const CameraPose middle = path.at(0.5);
    EXPECT_GT(glm::distance(middle.position, middle.target), 0.5);
}

TEST(CameraPath, AnEvenMoveStaysEvenHoweverItsKeysAreSpaced) {
    CameraPath path;
    const glm::dvec3 start(3, 1, -2), velocity(2, 0.5, -1);
    for (const double time : {0.0, 1.0, 1.5, 4.0, 4.2, 9.0})
        path.keys.push_back({time, {start + time * velocity, glm::dvec3(100) + time * velocity, 0.8}});
    for (double time = 0; time <= 9; time += 0.01) {
        ASSERT_LT(glm::distance(path.at(time).position, start + time * velocity), 1e-9);
        ASSERT_LT(glm::distance(path.at(time).target, glm::dvec3(100) + time * velocity), 1e-9);
    }
}

TEST(CameraPath, PassesEachKeyWithTheVelocityBetweenItsNeighbours) {
    constexpr double step = 1e-5;  // [s]
    const CameraPath path = square_path();
    for (std::size_t i = 0; i + 1 < path.keys.size(); ++i) {
        const CameraKey& key = path.keys[i];
        const bool first = i == 0;  // the last key is the first, a lap later
        const CameraKey &before = path.keys[first ? path.keys.size() - 2 : i - 1], &after = path.keys[i + 1];
        const double span = after.time - before.time + (first ? path.keys.back().time - key.time : 0);
        const glm::dvec3 expected = (after.pose.position - before.pose.position) / span;
        const glm::dvec3 measured =
            (path.at(key.time + step).position - path.at(key.time - step).position) / (2 * step);
        EXPECT_LT(glm::distance(measured, expected), 1e-3) << "key " << i;
    }
}

TEST(CameraPath, StaysCloseToItsKeysBetweenThem) {
    const CameraPath path = square_path();
    for (double time = 1; time < 8; time += 0.01) {
        const glm::dvec3 at = path.at(time).position;
        for (const double across : {at.x, at.z}) {
            ASSERT_GT(across, -2.5);
            ASSERT_LT(across, 12.5);
        }
    }
}

// Largest change of velocity over a frame's time, anywhere on the path [m/s].
double largest_jolt(const CameraPath& path, double begin, double end) {
    constexpr double step = 1e-3;  // [s]
    double largest = 0;
    for (double time = begin; time < end; time += 1.0 / 60) {
        for (const auto field : {&CameraPose::position, &CameraPose::target}) {
            const glm::dvec3 before = path.at(time - step).*field, here = path.at(time).*field;
            const glm::dvec3 after = path.at(time + step).*field;
            largest = std::max(largest, glm::length((after - here) - (here - before)) / step);
        }
    }
    return largest;
}

TEST(CameraPath, VelocityIsContinuousAcrossKeysAndTheSeam) {
    constexpr double tolerance = 0.2;  // [m/s] what acceleration makes of 1 ms; a kink would be metres a second
    CameraPath path = square_path();
    EXPECT_LT(largest_jolt(path, 0.5, 16), tolerance);
    for (const std::int64_t people : sizes) {
        const CameraPath roam = scene::aim_cameras(scene::plan_stadium(people)).roam;
        const double size = glm::length(roam.keys.front().pose.position) / 200;  // larger tours fly faster
        EXPECT_LT(largest_jolt(roam, -1, 61), tolerance * std::max(size, 1.0)) << people << " people";
    }
}

TEST(Presets, ThoseThatAreNamedExist) {
    const StadiumPlan plan = scene::plan_stadium(1000);
    for (const char* name : {"still", "close", "medium", "remote", "roam"}) {
        EXPECT_TRUE(scene::is_preset(name));
        EXPECT_FALSE(scene::aim_cameras(plan).named(name).keys.empty());
    }
    EXPECT_FALSE(scene::is_preset("nearby"));
    try {
        scene::aim_cameras(plan).named("nearby");
        FAIL() << "accepted";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("still, close, medium, remote, roam"), std::string::npos);
    }
}

TEST(Presets, RoamIsAClosedTourOfAMinute) {
    const CameraPath roam = scene::aim_cameras(scene::plan_stadium(20000)).roam;
    EXPECT_TRUE(roam.closed);
    EXPECT_EQ(roam.keys.back().time - roam.keys.front().time, 60.0);
    EXPECT_LT(difference(roam.keys.front().pose, roam.keys.back().pose), 1e-12);
}

// Where cameras of all presets are: stills, and the tour frame by frame.
std::vector<CameraPose> all_poses(const StadiumPlan& plan) {
    std::vector<CameraPose> poses;
    for (const char* name : {"still", "close", "medium", "remote"}) {
        poses.push_back(scene::aim_cameras(plan).named(name).at(0));
    }
    const CameraPath roam = scene::aim_cameras(plan).roam;
    for (int frame = 0; frame < 60 * 20; ++frame) poses.push_back(roam.at(frame / 20.0));
    return poses;
}

double distance_to_segment(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b) {
    const double t = std::clamp(glm::dot(point - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(point, glm::mix(a, b, t));
}

double distance_to_triangle(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const bool above = glm::dot(glm::cross(b - a, point - a), normal) >= 0 &&
                       glm::dot(glm::cross(c - b, point - b), normal) >= 0 &&
                       glm::dot(glm::cross(a - c, point - c), normal) >= 0;
    if (above) return std::abs(glm::dot(point - a, normal));
    return std::min(
        {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

TEST(Presets, KeepClearOfWallsRoofAndGround) {
    constexpr double clearance = 0.5;  // [m]
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const scene::StaticMesh mesh = scene::build_structure(plan);
        const std::vector<CameraPose> poses = all_poses(plan);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.vertices[mesh.indices[i]].position);
            const glm::dvec3 b(mesh.vertices[mesh.indices[i + 1]].position);
            const glm::dvec3 c(mesh.vertices[mesh.indices[i + 2]].position);
            const glm::dvec3 low = glm::min(a, glm::min(b, c)) - clearance,
                             high = glm::max(a, glm::max(b, c)) + clearance;
            for (std::size_t p = 0; p < poses.size(); ++p) {
                const glm::dvec3 at = poses[p].position;
                if (glm::clamp(at, low, high) != at) continue;
                ASSERT_GT(distance_to_triangle(at, a, b, c), clearance)
                    << people << " people, pose " << p << " at " << at.x << ' ' << at.y << ' ' << at.z;
            }
        }
    }
}

TEST(Presets, KeepClearOfPeople) {
    constexpr double clearance = 0.6;  // [m] from the axis of a person with arms up: shoulders and a near plane
    constexpr double reach = 1.3;      // of the height
    constexpr double track_width = 8 * 1.22, athletes_reach = 2.8;  // [m]
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        for (const CameraPose& pose : all_poses(plan)) {
            const double offset = plan.oval.offset_of({pose.position.x, pose.position.z});
            if (offset > -1 && offset < track_width + 1) {
                ASSERT_GT(pose.position.y, athletes_reach);
            }
            for (const scene::CrowdBlock& block : crowd.blocks) {
                const glm::dvec3 low = glm::dvec3(block.box.min) - clearance,
                                 high = glm::dvec3(block.box.max) + clearance;
                if (glm::clamp(pose.position, low, high) != pose.position) continue;
                for (std::size_t i = block.first; i < block.first + block.count; ++i) {
                    if (crowd.role[i] == scene::Role::walker || crowd.role[i] == scene::Role::runner) break;
                    const glm::dvec3 feet(crowd.position[i]);
                    const glm::dvec3 hands = feet + glm::dvec3(0, reach * static_cast<double>(crowd.height[i]), 0);
                    ASSERT_GT(distance_to_segment(pose.position, feet, hands), clearance)
                        << people << " people at " << pose.position.x << ' ' << pose.position.y << ' '
                        << pose.position.z;
                }
            }
        }
    }
}

// The share of a crowd whose feet are in a picture of 16:9.
double share_in_view(const CameraPose& pose, const Crowd& crowd, const scene::CastMember& member) {
    const glm::dvec3 forward = glm::normalize(pose.target - pose.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))), up = glm::cross(right, forward);
    const double slope = std::tan(pose.fov_y / 2);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        const glm::dvec3 to = glm::dvec3(scene::place(crowd, i, member, 0).position) - pose.position;
        const double depth = glm::dot(to, forward);
        seen += depth > 0 && std::abs(glm::dot(to, up)) < slope * depth &&
                std::abs(glm::dot(to, right)) < slope * depth * 16 / 9;
    }
    return static_cast<double>(seen) / static_cast<double>(crowd.size());
}

TEST(Presets, RemoteHasEverybodyInView) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        const CameraPose pose = scene::aim_cameras(plan).remote.at(0);
        EXPECT_EQ(share_in_view(pose, crowd, cast.members[0]), 1.0) << people << " people";
        EXPECT_GT(pose.position.y, plan.rim_height);
    }
}

TEST(Presets, StillHasMostOfAFullStadiumInView) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : {std::int64_t{8000}, std::int64_t{20000}, std::int64_t{60000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        EXPECT_GT(share_in_view(scene::aim_cameras(plan).still.at(0), crowd, cast.members[0]), 0.6);
    }
}

TEST(Presets, RemoteIsNoFurtherOffThanItMustBe) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const CameraPose pose = scene::aim_cameras(plan).remote.at(0);
        // The outline of stands and of those who stand around them all but touches the picture's edge.
        const glm::dvec3 forward = glm::normalize(pose.target - pose.position);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))),
                         up = glm::cross(right, forward);
        const double slope = std::tan(pose.fov_y / 2);
        double furthest = 0;  // in half heights or half widths from the picture's middle
        for (int i = 0; i < 360; ++i) {
            for (const auto& [offset, height] :
                 {std::pair(plan.crowd_offset, 0.0f), {plan.outer_offset, plan.rim_height}}) {
                const glm::vec2 xz = plan.oval.position(plan.oval.length(offset) * static_cast<float>(i) / 360, offset);
                const glm::dvec3 to = glm::dvec3(xz.x, height, xz.y) - pose.position;
                const double depth = glm::dot(to, forward);
                furthest = std::max({furthest, std::abs(glm::dot(to, up)) / (slope * depth),
                                     std::abs(glm::dot(to, right)) / (slope * depth * 16 / 9)});
            }
        }
        EXPECT_LE(furthest, 0.98) << "no margin with " << people << " people";
        EXPECT_GE(furthest, 0.93) << people << " people";
        EXPECT_LT(glm::length(pose.target), 1) << "looks at the centre spot";
    }
}

TEST(Presets, SeeAsWideAsCamerasDo) {
    for (const std::int64_t people : sizes) {
        for (const CameraPose& pose : all_poses(scene::plan_stadium(people))) {
            ASSERT_GT(pose.fov_y, 35 * degree);
            ASSERT_LT(pose.fov_y, 65 * degree);
        }
    }
}

TEST(Presets, StillIsInAnAisleHighUpInACorner) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const CameraPose pose = scene::aim_cameras(plan).still.at(0);
        EXPECT_LT(pose.position.x, -0.8 * static_cast<double>(plan.oval.half_straight)) << "beside the pitch";
        EXPECT_GT(pose.position.z, 0.5 * static_cast<double>(plan.oval.radius)) << "behind the goal";
        const double least = plan.rows[plan.rows.size() * 3 / 4].floor;
        EXPECT_GT(pose.position.y, least + 1.0);
        EXPECT_LT(pose.position.y, plan.rows.back().floor + 2.5);
        for (const scene::Seat& seat : plan.seats) {
            const glm::dvec2 away(pose.position.x - static_cast<double>(seat.position.x),
                                  pose.position.z - static_cast<double>(seat.position.z));
            ASSERT_GT(glm::length(away), 0.7) << "on somebody's seat";
        }
        // Towards the pitch, and down.
        const glm::dvec3 ahead = glm::normalize(pose.target - pose.position);
        EXPECT_GT(glm::dot(ahead, glm::normalize(-pose.position)), 0.9);
        EXPECT_LT(ahead.y, -0.05);
    }
}

// Spectators in a picture of 16:9, up to some distance.
int spectators_in_view(const CameraPose& pose, const Crowd& crowd, double up_to) {
    const glm::dvec3 forward = glm::normalize(pose.target - pose.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))), up = glm::cross(right, forward);
    const double slope = std::tan(pose.fov_y / 2);
    int seen = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] != scene::Role::spectator) continue;
        const glm::dvec3 to = glm::dvec3(crowd.position[i]) + glm::dvec3(0, 1, 0) - pose.position;
        const double depth = glm::dot(to, forward);
        seen += depth > 0 && glm::length(to) < up_to && std::abs(glm::dot(to, up)) < slope * depth &&
                std::abs(glm::dot(to, right)) < slope * depth * 16 / 9;
    }
    return seen;
}

TEST(Presets, CloseAndMediumLookAtSpectators) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : {std::int64_t{100}, std::int64_t{20000}, std::int64_t{200000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        const CameraPose close = scene::aim_cameras(plan).close.at(0), medium = scene::aim_cameras(plan).medium.at(0);
        EXPECT_GT(spectators_in_view(close, crowd, 15), 20) << people << " people";
        EXPECT_LT(close.position.y, plan.rows.front().floor + 2.5) << "not from above";
        EXPECT_GT(spectators_in_view(medium, crowd, 80), people == 100 ? 80 : 400) << people << " people";
        const double offset = plan.oval.offset_of({medium.position.x, medium.position.z});
        EXPECT_LT(offset, -5) << "medium is on the infield";
        EXPECT_LT(medium.position.y, 6);
        // Both look along the stand that a small crowd sits in, up into it.
        for (const CameraPose& pose : {close, medium}) {
            EXPECT_GT(pose.target.z, pose.position.z + 1);
            EXPECT_GT(pose.target.z, static_cast<double>(plan.oval.radius + plan.stand_offset));
        }
    }
}

double nearest_spectator(const CameraPose& pose, const Crowd& crowd) {
    constexpr double face_height = 1.2;  // [m] seated
    double nearest = 1e9;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] != scene::Role::spectator) continue;
        const glm::dvec3 face = glm::dvec3(crowd.position[i]) + glm::dvec3(0, face_height, 0);
        nearest = std::min(nearest, glm::distance(face, pose.position));
    }
    return nearest;
}

TEST(Presets, CloseAndMediumAreAsNearAsTheyShould) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : {std::int64_t{100}, std::int64_t{20000}, std::int64_t{200000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        const double close = nearest_spectator(scene::aim_cameras(plan).close.at(0), crowd);
        EXPECT_GT(close, 1.0);
        EXPECT_LT(close, 6.0);
        const double medium = nearest_spectator(scene::aim_cameras(plan).medium.at(0), crowd);
        EXPECT_GT(medium, 20.0);
        EXPECT_LT(medium, 50.0);
    }
}

TEST(Presets, RoamGoesCloseMediumAndRemote) {
    const tests::FakeCast cast = tests::sitters();
    for (const std::int64_t people : {std::int64_t{20000}, std::int64_t{200000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        const CameraPath roam = scene::aim_cameras(plan).roam;
        int close = 0, medium = 0;
        for (int second = 0; second < 60; ++second) {
            const double nearest = nearest_spectator(roam.at(second), crowd);
            close += nearest < 6;
            medium += nearest > 15 && nearest < 50;
        }
        EXPECT_GE(close, 8) << "seconds along the front row";
        EXPECT_GE(medium, 8) << "seconds over the infield";
        EXPECT_EQ(share_in_view(roam.at(0), crowd, cast.members[0]), 1.0);
        EXPECT_EQ(difference(roam.at(0), scene::aim_cameras(plan).remote.at(0)), 0);
    }
}

TEST(Presets, RoamLooksIntoTheStadiumAndNeitherRacesNorSpins) {
    constexpr double frame = 1.0 / 60;
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const CameraPath roam = scene::aim_cameras(plan).roam;
        const double size = glm::length(roam.at(0).position);
        for (double time = 0; time < 60; time += 0.05) {
            const CameraPose here = roam.at(time), next = roam.at(time + frame);
            const glm::dvec3 ahead = glm::normalize(here.target - here.position);
            // What it looks at is pitch or people.
            ASSERT_LT(plan.oval.offset_of({here.target.x, here.target.z}), plan.outer_offset);
            ASSERT_LT(ahead.y, 0.3);
            ASSERT_LT(glm::distance(here.position, next.position) / frame, 15 + 0.4 * size) << "m/s at " << time;
            const double turned =
                std::acos(std::min(1.0, glm::dot(ahead, glm::normalize(next.target - next.position))));
            ASSERT_LT(turned / frame, 60 * degree) << "a second, at " << time;
        }
    }
}

// A file that is there for as long as a test runs.
class File : public testing::Test {
protected:
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) /
        (std::string("camera_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".json");

    void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
    void TearDown() override { std::filesystem::remove(path); }

    std::string complaint() const {
        try {
            scene::load_camera_path(path);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }
};

using CameraFile = File;

TEST_F(CameraFile, LoadsWhatItSays) {
    write(R"({"closed": true, "keys": [
        {"time_s": 0, "position": [1, 2, 3], "target": [4, 5, 6], "fov_deg": 50},
        {"time_s": 2.5, "position": [-1, 2, 3], "target": [4, 5, 6], "fov_deg": 60.5},
        {"time_s": 4, "position": [1, 2, 3], "target": [4, 5, 6], "fov_deg": 50}]})");
    const CameraPath loaded = scene::load_camera_path(path);
    EXPECT_TRUE(loaded.closed);
    ASSERT_EQ(loaded.keys.size(), 3u);
    EXPECT_EQ(loaded.keys[1].time, 2.5);
    EXPECT_EQ(loaded.keys[1].pose.position, glm::dvec3(-1, 2, 3));
    EXPECT_EQ(loaded.keys[1].pose.target, glm::dvec3(4, 5, 6));
    EXPECT_NEAR(loaded.keys[1].pose.fov_y, 60.5 * degree, 1e-12);
}

TEST_F(CameraFile, LoadsCuts) {
    const std::string rest = R"("position": [1, 2, 3], "target": [4, 5, 6], "fov_deg": 50)";
    write(R"({"keys": [{"time_s": 0, )" + rest + R"(}, {"time_s": 1, "cut": true, )" + rest + "}]}");
    EXPECT_FALSE(scene::load_camera_path(path).keys.at(0).cut);
    EXPECT_TRUE(scene::load_camera_path(path).keys.at(1).cut);
    write(R"({"keys": [{"time_s": 0, "cut": true, )" + rest + "}]}");
    EXPECT_NE(complaint().find("keys[0].cut: found true"), std::string::npos) << complaint();
    write(R"({"keys": [{"time_s": 0, "cut": 1, )" + rest + "}]}");
    EXPECT_NE(complaint().find("keys[0].cut: found 1, expected true or false"), std::string::npos) << complaint();
}

TEST_F(CameraFile, IsOpenUnlessItSaysOtherwise) {
    write(R"({"keys": [{"time_s": 7, "position": [1, 2, 3], "target": [4, 5, 6], "fov_deg": 50}]})");
    EXPECT_FALSE(scene::load_camera_path(path).closed);
}

std::string key(const std::string& time, const std::string& position, const std::string& target,
                const std::string& fov) {
    return R"({"time_s":)" + time + R"(,"position":)" + position + R"(,"target":)" + target + R"(,"fov_deg":)" + fov +
           "}";
}

std::string keys(const std::string& list) {
    return R"({"keys":[)" + list + "]}";
}

TEST_F(CameraFile, RefusesBadOnesInOneLineThatNamesFileAndPlace) {
    const std::string good = key("0", "[0,1,0]", "[1,1,1]", "50");
    const std::pair<std::string, std::string> cases[] = {
        {"", "line 1"},
        {"{\n\"keys\": [,]}", "line 2"},
        {"[1e999]", "expected JSON"},
        {"[]", "an object with closed, keys"},
        {"{}", "no member 'keys'"},
        {R"({"keys":{}})", "an array of 1 to"},
        {R"({"keys":[]})", "0 keys"},
        {R"({"keys":[3]})", "keys[0]"},
        {R"({"kees":[]})", "\"kees\""},
        {R"({"closed":1,"keys":[]})", "true or false"},
        {keys(key("\"0\"", "[0,1,0]", "[1,1,1]", "50")), "keys[0].time_s: found \"0\""},
        {keys(key("-1", "[0,1,0]", "[1,1,1]", "50")), "keys[0].time_s: found -1"},
        {keys(key("0", "[0,1]", "[1,1,1]", "50")), "[x, y, z]"},
        {keys(key("0", "[0,1,1e300]", "[1,1,1]", "50")), "keys[0].position"},
        {keys(key("0", "[0,1,null]", "[1,1,1]", "50")), "found null"},
        {keys(key("0", "[1,1,1]", "[1,1,1]", "50")), "found the position's own [1,1,1], expected another point"},
        {keys(key("0", "[0,1,0]", "[1,1,1]", "1")), "fov_deg: found 1,"},
        {keys(key("0", "[0,1,0]", "[1,1,1]", "170")), "fov_deg: found 170,"},
        {keys(key("0", "[0,1,0]", "[1,1,1]", "-20")), "fov_deg: found -20,"},
        {keys(good + "," + good), "keys[1].time_s: found 0"},
        {R"({"closed":true,"keys":[)" + good + "]}", "at least 2"},
        {R"({"closed":true,"keys":[)" + good + "," + key("1", "[0,1,0]", "[1,1,2]", "50") + "]}", "unlike the first"},
        {std::string(100'000, '['), "line 1"},
    };
    for (const auto& [text, expected] : cases) {
        write(text);
        const std::string said = complaint();
        EXPECT_NE(said.find(expected), std::string::npos) << text.substr(0, 200) << " -> " << said;
        EXPECT_EQ(said.find(path.string()), 0u) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        EXPECT_NE(said.find("expected"), std::string::npos) << said;
        EXPECT_LT(said.size(), path.string().size() + 300) << said;
    }
}

TEST_F(CameraFile, TakesEachNumberUpToItsLimitAndNoFurther) {
    const auto accepts = [&](const std::string& list) {
        write(keys(list));
        return complaint().empty();
    };
    const std::string near = "[0,1,0]", there = "[1,1,1]";
    EXPECT_TRUE(accepts(key("0", near, there, "50")));
    EXPECT_TRUE(accepts(key("1e6", near, there, "50")));
    EXPECT_FALSE(accepts(key("1000001", near, there, "50")));
    for (int axis = 0; axis < 3; ++axis) {
        for (const std::string sign : {"", "-"}) {
            const auto at = [&](const std::string& value) {
                std::string text = "[";
                for (int i = 0; i < 3; ++i) text += (i == axis ? sign + value : "2") + std::string(i < 2 ? "," : "]");
                return text;
            };
            EXPECT_TRUE(accepts(key("0", at("100000"), there, "50")));
            EXPECT_FALSE(accepts(key("0", at("100001"), there, "50")));
            EXPECT_FALSE(accepts(key("0", near, at("100001"), "50")));
        }
    }
    EXPECT_TRUE(accepts(key("0", near, there, "1.01")));
    EXPECT_TRUE(accepts(key("0", near, there, "169.9")));
    EXPECT_FALSE(accepts(key("0", near, there, "170.1")));
    for (const std::string distance : {"0.001", "1e-9", "1e-200", "5e-324"})
        EXPECT_TRUE(accepts(key("0", "[0,0,0]", "[0,0," + distance + "]", "50"))) << distance;
    EXPECT_TRUE(accepts(key("0", "[100000,0,0]", "[99999.999999999985,0,0]", "50"))) << "one step of a double away";
    EXPECT_FALSE(accepts(key("0", "[0,0,0]", "[0,0,1e-324]", "50"))) << "is read as 0";
    EXPECT_FALSE(accepts(key("0", "[0,-0.0,0]", "[0,0,0]", "50")));
    EXPECT_TRUE(accepts(key("0", near, there, "50") + "," + key("1e-3", near, there, "50")));
    EXPECT_FALSE(accepts(key("1", near, there, "50") + "," + key("0.5", near, there, "50")));
}

TEST_F(CameraFile, TakesTenThousandKeysAndFourMebibytes) {
    const auto many = [](int count) {
        std::string list;
        for (int i = 0; i < count; ++i) {
            list += (i > 0 ? "," : "") + key(std::to_string(i), "[0,1,0]", "[1,1,1]", "50");
        }
        return keys(list);
    };
    write(many(10'000));
    EXPECT_EQ(scene::load_camera_path(path).keys.size(), 10'000u);
    write(many(10'001));
    EXPECT_NE(complaint().find("10001 keys"), std::string::npos) << complaint();
    std::string padded = many(1);
    padded.resize(4 << 20, ' ');
    write(padded);
    EXPECT_EQ(scene::load_camera_path(path).keys.size(), 1u);
}

TEST_F(CameraFile, RefusesASeamThatWouldJump) {
    const auto closed = [&](const std::string& last) {
        write(R"({"closed":true,"keys":[)" + key("0", "[0,1,0]", "[1,1,1]", "50") + "," + last + "]}");
        return complaint();
    };
    EXPECT_EQ(closed(key("1", "[0,1,0]", "[1,1,1]", "50")), "");
    for (const std::string& last : {key("1", "[0,1,0.5]", "[1,1,1]", "50"), key("1", "[0,1,0]", "[1,1,1.5]", "50"),
                                    key("1", "[0,1,0]", "[1,1,1]", "51")}) {
        EXPECT_NE(closed(last).find("unlike the first"), std::string::npos) << last;
    }
}

TEST_F(CameraFile, NamesMissingAndMisspeltMembersOfAKey) {
    const std::string members[] = {R"("time_s":0)", R"("position":[0,1,0])", R"("target":[1,1,1])", R"("fov_deg":50)"};
    const std::string names[] = {"time_s", "position", "target", "fov_deg"};
    for (std::size_t missing = 0; missing < 4; ++missing) {
        std::string text;
        for (std::size_t i = 0; i < 4; ++i)
            if (i != missing) text += (text.empty() ? "" : ",") + members[i];
        write(keys("{" + text + "}"));
        EXPECT_NE(complaint().find("keys[0]: found no member '" + names[missing] + "'"), std::string::npos)
            << complaint();
    }
    write(keys("{" + members[0] + "," + members[1] + "," + members[2] + "," + members[3] + R"(,"fov":50})"));
    EXPECT_NE(complaint().find("found the member \"fov\", expected time_s, position, target, fov_deg, cut"),
              std::string::npos)
        << complaint();
}

TEST_F(CameraFile, QuotesWhatIsWrongInShort) {
    write(keys(key("\"" + std::string(500, 'x') + "\"", "[0,1,0]", "[1,1,1]", "50")));
    EXPECT_NE(complaint().find("xxx..."), std::string::npos);
    EXPECT_EQ(complaint().find(std::string(50, 'x')), std::string::npos);
    EXPECT_NE(complaint().find(std::string(30, 'x')), std::string::npos);
}

TEST_F(CameraFile, RefusesWhatIsMissingAFolderOrTooLarge) {
    EXPECT_NE(complaint().find("can't be read"), std::string::npos);
    std::filesystem::create_directory(path);
    EXPECT_NE(complaint().find("folder"), std::string::npos);
    std::filesystem::remove(path);
    write(std::string((4 << 20) + 1, ' '));
    EXPECT_NE(complaint().find("bytes"), std::string::npos);
}

}  // namespace
