// Whatever a file's units, origin and gait: its character stands where the scene puts people, as large as they are.
#include "scene/settle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "scene/body_motion.h"
#include "scene/person.h"
#include "tests/scene/stick.h"

namespace {

using scene::Role;

constexpr float millimetre = 1e-3f;

struct Settled {
    model::Character character;
    scene::Casting casting;

    explicit Settled(model::Character from, double turn = 0)
        : character(std::move(from)), casting(scene::cast(character)) {
        scene::settle(character, casting, turn);
    }

    // A role's clip; null of a statue.
    const model::Clip* clip(Role role) const {
        if (casting.clips.empty()) return nullptr;
        const std::uint8_t baked = casting.member.acts[static_cast<int>(role)].calm.at(0);
        return &character.clips.at(casting.clips.at(baked));
    }

    std::vector<glm::vec3> at(Role role, double share) const {
        const model::Clip* of = clip(role);
        return tests::posed(character, of, of ? share * of->duration : 0);
    }
    motion::Bounds box(Role role, double share) const { return motion::bounds_of(at(role, share)); }
};

void expect_stands(const motion::Bounds& box, const std::string& who) {
    EXPECT_NEAR(box.size().y, scene::settled_height, millimetre) << who;
    EXPECT_NEAR(box.min.y, 0, millimetre) << who;
    constexpr float middle = 5e-3f;  // [m] as far as areas in cells tell
    EXPECT_NEAR(box.center().x, 0, middle) << who;
    EXPECT_NEAR(box.center().z, 0, middle) << who;
}

model::Character idler() {
    model::Character stick = tests::make_stick();
    tests::add_sway(stick, "Idle", 0);
    tests::add_gait(stick, "Walk", 1, 0.4f);
    return stick;
}

TEST(Settle, StandsOnTheGroundOverItsPlaceInAnyUnits) {
    for (const float units : {1e-9f, 1e-3f, 1.0f, 100.0f, 1e6f}) {
        model::Character stick = idler();
        tests::export_as(stick, units, {12, -3, 7});
        const Settled settled(stick);
        for (const Role role : {Role::spectator, Role::standing})
            expect_stands(settled.box(role, 0.3), std::to_string(units));
        EXPECT_NEAR(settled.box(Role::walker, 0.3).min.y, 0, 0.02f);
    }
}

TEST(Settle, StatuesStandToo) {
    for (const float units : {1e-3f, 1.0f, 100.0f}) {
        model::Character stick = tests::make_stick();
        tests::export_as(stick, units, {-4, 9, 2});
        expect_stands(Settled(stick).box(Role::spectator, 0), std::to_string(units));
    }
}

TEST(Settle, TheUnposedMeshIsAboutAsLarge) {
    model::Character stick = idler();
    tests::export_as(stick, 100, {0, 0, 0});
    const Settled settled(stick);
    EXPECT_NEAR(motion::bounds_of(settled.character.mesh.positions).size().y, scene::settled_height, millimetre);
}

TEST(Settle, RootMotionBecomesTheGaitsSpeed) {
    model::Character stick = idler();
    stick.clips.pop_back();
    tests::add_gait(stick, "Walk", 4, 0.5f, {0, 0, 6});
    tests::add_gait(stick, "Run", 2, 0.6f, {0, 0, 9});
    tests::export_as(stick, 100, {1, 0, 0});
    const Settled settled(stick);
    for (const Role role : {Role::walker, Role::runner})
        for (const double share : {0.0, 0.2, 0.5, 0.77, 1.0})
            EXPECT_LT(glm::length(glm::vec2(settled.box(role, share).center().x, settled.box(role, share).center().z)),
                      0.05f);
    EXPECT_NEAR(settled.casting.member.gait_speed[static_cast<int>(Role::walker)], 1.5f, 0.01f);
    EXPECT_NEAR(settled.casting.member.gait_speed[static_cast<int>(Role::runner)], 4.5f, 0.01f);
}

TEST(Settle, FeetOnTheGroundTellTheSpeedOfWhoStays) {
    const Settled person(scene::make_person());
    EXPECT_NEAR(person.casting.member.gait_speed[static_cast<int>(Role::walker)], scene::walk_speed, 0.1f);
    EXPECT_NEAR(person.casting.member.gait_speed[static_cast<int>(Role::runner)], scene::run_speed, 0.2f);
    model::Character glider = tests::make_stick();
    tests::add_sway(glider, "Idle", 0);
    tests::add_sway(glider, "Walk", 0.01f);
    EXPECT_EQ(Settled(glider).casting.member.gait_speed[static_cast<int>(Role::walker)], scene::walk_speed)
        << "its feet tell nothing";
}

TEST(Settle, RunnersWhoOnlyWalkGoAtTheirWalksSpeed) {
    model::Character stick = tests::make_stick();
    tests::add_gait(stick, "Walk", 4, 0.5f, {0, 0, 4});
    EXPECT_NEAR(Settled(stick).casting.member.gait_speed[static_cast<int>(Role::runner)], 1, 0.01f);
}

// Each foot goes back for half the time, as fast as the ground does, and is high while it comes forward.
model::Character stepper(float step, double duration) {
    model::Character stick = tests::make_stick();
    for (const auto joint : {tests::stick_leg_l, tests::stick_leg_r}) {
        const float x = joint == tests::stick_leg_l ? 0.02f : -0.18f;
        tests::add_box(stick.mesh, {x, 0, -0.08f}, {x + 0.16f, 0.01f, 0.08f}, joint);  // a sole
    }
    tests::add_sway(stick, "Idle", 0);
    tests::add_clip(stick, "Walk", duration, [step](float s) {
        const auto leg = [step](float share) {
            share -= std::floor(share);
            return share < 0.5f ? std::asin(step * (1 - 4 * share) / 2 / tests::stick_hip_height) : 1.3f;
        };
        const float down = std::min(std::fabs(leg(s)), std::fabs(leg(s + 0.5f)));
        return tests::StickPose{{0, -tests::stick_hip_height * (1 - std::cos(down)), 0}, leg(s), leg(s + 0.5f)};
    });
    return stick;
}

float walking_speed(const model::Character& character) {
    return Settled(character).casting.member.gait_speed[static_cast<int>(Role::walker)];
}

TEST(Settle, WhatHangsDownDoesntSlowTheFeet) {
    model::Character walker = stepper(0.5f, 1);
    EXPECT_NEAR(walking_speed(walker), 1, 0.05f);
    tests::add_box(walker.mesh, {-0.3f, 0.01f, -0.2f}, {0.3f, 1.4f, -0.15f}, tests::stick_hips);  // a cape
    EXPECT_NEAR(walking_speed(walker), 1, 0.05f) << "with a cape";
}

TEST(Settle, AWalkIsNoRun) {
    model::Character stick = idler();
    stick.clips.pop_back();
    tests::add_gait(stick, "Walk", 1, 0.4f, {0, 0, 5});
    model::Channel& hips = stick.clips.back().channels.front();
    hips.interpolation = model::Interpolation::cubic_spline;
    hips.times = {0, 1};
    hips.values = {0, 0, 0, 0, 0.9f, 0, 0, 1, 9, 0, 1, 1, 0, 0.9f, 5, 0, 0, 0};
    const Settled fast(stick);
    EXPECT_FLOAT_EQ(fast.casting.member.gait_speed[static_cast<int>(Role::walker)], 2.2f);
    EXPECT_NEAR(fast.clip(Role::walker)->duration, 5 / 2.2, 0.02) << "feet slide";
    EXPECT_NEAR(fast.casting.member.gait_speed[static_cast<int>(Role::runner)], 5, 0.03f) << "who runs may";
    for (const double share : {0.1, 0.25, 0.6, 0.9}) {
        const std::vector<glm::vec3> slow = fast.at(Role::walker, share), quick = fast.at(Role::runner, share);
        for (std::size_t i = 0; i < slow.size(); ++i)
            EXPECT_LT(glm::distance(slow[i], quick[i]), 0.03f) << "another motion at " << share;
    }
    stick.clips.back().name = "Run";
    EXPECT_NEAR(walking_speed(stick), 5, 0.03f) << "who has only a run runs";
}

TEST(Settle, ALegThatDipsBelowTheGroundForAMomentLiftsNobody) {
    model::Character stick = tests::make_stick();
    tests::add_clip(stick, "Idle", 2, [](float s) {
        return tests::StickPose{{0, s > 0.4f && s < 0.5f ? -0.3f : 0, 0}};
    });
    for (const double share : {0.1, 0.3, 0.7})
        EXPECT_NEAR(Settled(stick).box(Role::spectator, share).min.y, 0, millimetre) << share;
}

TEST(Settle, WhoWandersAboutStaysAtHome) {
    model::Character stick = tests::make_stick();
    tests::add_sway(stick, "Idle", 5);
    const Settled settled(stick);
    for (const double share : {0.0, 0.1, 0.25, 0.5, 0.7})
        EXPECT_LT(std::abs(settled.box(Role::spectator, share).center().x), 0.6f) << share;
}

TEST(Settle, SwayingIsNoWandering) {
    model::Character stick = tests::make_stick();
    tests::add_sway(stick, "Idle", 0.2f);
    const Settled settled(stick);
    EXPECT_NEAR(settled.box(Role::spectator, 0.25).center().x, 0.2f, 0.01f);
    EXPECT_NEAR(settled.box(Role::spectator, 0.75).center().x, -0.2f, 0.01f);
}

TEST(Settle, SizeIsThatOfStandingOverTime) {
    model::Character stick = tests::make_stick();
    tests::add_clip(stick, "Idle", 4, [](float s) {
        return tests::StickPose{{}, 0, 0, s < 0.1f || s > 0.95f ? 1.5f : -1.4f};
    });
    const Settled settled(stick);
    EXPECT_NEAR(settled.box(Role::spectator, 0.5).size().y, scene::settled_height, millimetre);
    EXPECT_GT(settled.box(Role::spectator, 0).size().y, 1.1f * scene::settled_height) << "its arms are up at first";
}

TEST(Settle, WhoLiesIsAsLongAsAPerson) {
    for (const float thick : {0.0f, 0.3f}) {
        model::Character slab;
        slab.mesh.materials.emplace_back();
        tests::add_box(slab.mesh, {1, 5, -100}, {30, 5 + 100 * thick, 75}, 0);
        tests::add_joint(slab.skeleton, -1, {0, 0, 0}, {0, 0, 0});
        const motion::Bounds box = Settled(slab).box(Role::standing, 0);
        EXPECT_NEAR(box.size().z, scene::settled_height, millimetre);
        EXPECT_NEAR(box.min.y, 0, millimetre);
        EXPECT_NEAR(box.center().z, 0, millimetre);
    }
}

TEST(Settle, TurnsAsItsUserWants) {
    model::Character stick = tests::make_stick();
    tests::add_box(stick.mesh, {0.1f, 1.6f, -0.02f}, {0.4f, 1.65f, 0.02f}, tests::stick_hips);  // a nose towards +x
    const std::size_t tip = stick.mesh.positions.size() - 1;
    for (const auto& [turn, towards] : {std::pair<double, glm::vec3>{0, {1, 0, 0}},
                                        {-90, {0, 0, 1}},
                                        {90, {0, 0, -1}},
                                        {180, {-1, 0, 0}},
                                        {-450, {0, 0, 1}}}) {
        const glm::vec3 nose = Settled(stick, turn).at(Role::standing, 0)[tip];
        EXPECT_GT(glm::dot(nose, towards), 0.35f) << turn;
    }
}

TEST(Settle, SittersRestOnTheSeat) {
    for (const bool sits_down : {false, true}) {
        model::Character stick = tests::make_stick();
        tests::add_sway(stick, "Idle", 0);
        tests::add_sitting(stick, "Sit_Floor", sits_down);
        tests::add_sway(stick, "Cheer", 0.01f);
        tests::export_as(stick, 100, {5, 5, 5});
        const Settled settled(stick);
        ASSERT_TRUE(settled.casting.member.sits);
        const motion::Bounds box = settled.box(Role::spectator, 0.5);
        std::vector<glm::vec3> hind = settled.at(Role::spectator, 0.5);
        hind.resize(24);  // trunk and legs
        std::erase_if(hind, [](glm::vec3 position) { return position.z > 0.2f; });
        EXPECT_NEAR(motion::bounds_of(hind).min.y, scene::seat_height, 0.06f);
        EXPECT_NEAR(box.min.z, -0.17f, 0.1f) << "its back is at the seat's";
        EXPECT_GT(box.max.z, 0.5f) << "its legs are ahead";
        const std::uint8_t cheer = settled.casting.member.acts[static_cast<int>(Role::spectator)].excited.at(0);
        const motion::Bounds up = motion::bounds_of(
            tests::posed(settled.character, &settled.character.clips.at(settled.casting.clips.at(cheer)), 0));
        EXPECT_NEAR(up.min.y, 0, millimetre) << "jumps to its feet";
        EXPECT_NEAR(up.center().z, 0.37f, 0.02f) << "before the seat";
    }
}

TEST(Settle, RefusesWhatIsInOnePoint) {
    model::Character point;
    point.mesh.materials.emplace_back();
    tests::add_box(point.mesh, {1, 1, 1}, {1, 1, 1}, 0);
    tests::add_joint(point.skeleton, -1, {0, 0, 0}, {0, 0, 0});
    EXPECT_THROW(Settled{point}, std::runtime_error);
}

TEST(BodyMotion, ThinPartsDontMoveTheMiddle) {
    model::Character knight = tests::make_stick();
    const glm::vec2 without = scene::middle_of(knight.mesh, tests::posed(knight, nullptr, 0));
    tests::add_box(knight.mesh, {0, 1.2f, 0.1f}, {0.02f, 1.25f, 2.0f}, tests::stick_hips);  // a sword
    EXPECT_NEAR(scene::middle_of(knight.mesh, tests::posed(knight, nullptr, 0)).y, without.y, 0.05f);
}

}  // namespace
