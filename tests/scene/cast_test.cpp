#include "scene/cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/person.h"
#include "tests/scene/fake_cast.h"
#include "tests/scene/stick.h"

namespace {

using scene::Role;

model::Character with_clips(std::initializer_list<const char*> names) {
    model::Character character;
    for (const char* name : names) character.clips.push_back({name, 1.0, {}});
    return character;
}

// The clip that a role plays while calm.
model::Clip calm(const model::Character& character, Role role, std::span<const scene::ActWish> wishes = {}) {
    const scene::Casting casting = scene::cast(character, wishes);
    model::Character with_stills = character;
    scene::add_stills(with_stills, casting);
    const std::uint8_t baked = casting.member.acts[static_cast<int>(role)].calm.at(0);
    return with_stills.clips.at(casting.clips.at(baked));
}

std::string calm_clip(const model::Character& character, Role role, std::span<const scene::ActWish> wishes = {}) {
    return calm(character, role, wishes).name;
}

bool is_mean(const model::Clip& clip) {
    return clip.name.find(", its mean pose") != std::string::npos;
}

bool is_held(const model::Clip& clip) {
    return clip.duration == 0 && (clip.name.find(", held at ") != std::string::npos || is_mean(clip));
}

TEST(Cast, PersonSitsInTheStandsAndStandsElsewhere) {
    const model::Character person = scene::make_person();
    EXPECT_TRUE(scene::cast(person).member.sits);
    EXPECT_EQ(calm_clip(person, Role::spectator), "sit");
    EXPECT_EQ(calm_clip(person, Role::standing), "stand");
    EXPECT_EQ(calm_clip(person, Role::walker), "walk");
    EXPECT_EQ(calm_clip(person, Role::runner), "run");
}

TEST(Cast, MexicanWaveIsArmsUp) {
    const model::Character person = scene::make_person();
    const scene::Casting casting = scene::cast(person);
    const auto& excited = casting.member.acts[static_cast<int>(Role::spectator)].excited;
    EXPECT_EQ(excited.size(), 3u);
    EXPECT_EQ(person.clips.at(casting.clips.at(excited.at(0))).name, "cheer");
}

TEST(Cast, FindsClipsInAnyCaseAndWithPrefixes) {
    const auto robot = with_clips({"Robot_Dance", "Robot_WalkJump", "Robot_Walking", "Robot_Running", "Robot_Sitting"});
    EXPECT_EQ(calm_clip(robot, Role::spectator), "Robot_Sitting");
    EXPECT_EQ(calm_clip(robot, Role::walker), "Robot_Walking");
    EXPECT_EQ(calm_clip(robot, Role::runner), "Robot_Running");
    EXPECT_TRUE(scene::cast(robot).member.sits);
    const auto horse = with_clips({"AnimalArmature|Idle", "AnimalArmature|WALK"});
    EXPECT_EQ(calm_clip(horse, Role::walker), "AnimalArmature|WALK");
    EXPECT_EQ(calm_clip(horse, Role::runner), "AnimalArmature|WALK");
}

// The names of the clips that spectators play while excited, in order.
std::vector<std::string> excited_clips(const model::Character& character) {
    const scene::Casting casting = scene::cast(character);
    std::vector<std::string> names;
    for (const std::uint8_t baked : casting.member.acts[static_cast<int>(Role::spectator)].excited)
        names.push_back(character.clips.at(casting.clips.at(baked)).name);
    return names;
}

TEST(Cast, WalkersWalkAndRunnersRunIfTheyCanElseTheOtherElseTheyFly) {
    const auto all = with_clips({"Fly", "Run", "Walk"});
    EXPECT_EQ(calm_clip(all, Role::walker), "Walk");
    EXPECT_EQ(calm_clip(all, Role::runner), "Run");
    for (const Role role : {Role::spectator, Role::standing})
        EXPECT_TRUE(is_held(calm(all, role))) << "walks, runs or flies on the spot";
    const auto no_walk = with_clips({"Idle", "Fly", "Run"});
    for (const Role role : {Role::walker, Role::runner}) EXPECT_EQ(calm_clip(no_walk, role), "Run");
    const auto bird = with_clips({"Idle", "Fly"});
    for (const Role role : {Role::walker, Role::runner}) EXPECT_EQ(calm_clip(bird, role), "Fly");
}

TEST(Cast, SittersStandElseIdleElseWaitWhereThereIsNoSeat) {
    EXPECT_EQ(calm_clip(with_clips({"walk", "idle", "stand", "sit"}), Role::standing), "stand");
    EXPECT_EQ(calm_clip(with_clips({"walk", "idle", "sit"}), Role::standing), "idle");
    EXPECT_EQ(calm_clip(with_clips({"walk", "wait", "sit"}), Role::standing), "wait");
    EXPECT_EQ(calm_clip(with_clips({"walk", "idle", "stand", "Sit"}), Role::spectator), "Sit");
}

TEST(Cast, SpectatorsCheerClapAndWaveInThatOrderAsFarAsTheyCan) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(excited_clips(with_clips({"Wave", "Walk", "Clap", "Cheer"})), (Names{"Cheer", "Clap", "Wave"}));
    EXPECT_EQ(excited_clips(with_clips({"Robot_Wave", "Robot_Walking"})), (Names{"Robot_Wave"}));
    EXPECT_EQ(excited_clips(with_clips({"sit", "walk"})), Names{});
}

TEST(Cast, PlaysWhatSaysTheLeastElse) {
    EXPECT_EQ(calm_clip(with_clips({"WalkJump", "Walking", "WalkHolding"}), Role::walker), "Walking");
    EXPECT_EQ(calm_clip(with_clips({"Catwalk", "Walk", "walk"}), Role::walker), "Walk");
}

TEST(Cast, BakesFirstWhatStandsUprightSinceHeightsAreMeasuredInIt) {
    for (const model::Character& character :
         {scene::make_person(), with_clips({"sit", "cheer", "run", "walk", "stand"}), with_clips({"Run", "Walk"})}) {
        const scene::Casting casting = scene::cast(character);
        EXPECT_EQ(casting.member.acts[static_cast<int>(Role::standing)].calm.at(0), 0);
    }
}

TEST(Cast, HasItsCharactersNameAndThePersonsSpeeds) {
    model::Character character = with_clips({"walk"});
    character.name = "fox";
    const scene::CastMember member = scene::cast(character).member;
    EXPECT_EQ(member.name, "fox");
    EXPECT_EQ(member.gait_speed[static_cast<int>(Role::walker)], scene::walk_speed);
    EXPECT_EQ(member.gait_speed[static_cast<int>(Role::runner)], scene::run_speed);
    EXPECT_EQ(member.gait_speed[static_cast<int>(Role::spectator)], 0);
    EXPECT_EQ(member.gait_speed[static_cast<int>(Role::standing)], 0);
}

TEST(Cast, PlaysTheFirstClipWhereNoNameFits) {
    const auto unnamed = with_clips({"", "Take 001"});
    for (const Role role : {Role::spectator, Role::standing, Role::walker, Role::runner})
        EXPECT_EQ(calm_clip(unnamed, role), "");
}

TEST(Cast, BakesEachClipOnceAndOnlyWhatIsPlayed) {
    const auto character = with_clips({"Death", "Walk", "Idle", "Run", "Cheer", "Jump"});
    EXPECT_EQ(scene::cast(character).clips.size(), 4u);
}

TEST(Cast, StatueHasOnePoseForEveryRole) {
    const scene::Casting casting = scene::cast(with_clips({}));
    EXPECT_TRUE(casting.clips.empty());
    for (const scene::Acts& acts : casting.member.acts) EXPECT_EQ(acts.calm, (std::vector<std::uint8_t>{0}));
}

// The largest distance between where any vertex is in two poses [m].
float apart(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    float farthest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) farthest = std::max(farthest, glm::distance(a[i], b[i]));
    return farthest;
}

TEST(Cast, SpectatorsStandInTheCalmestClipWhereNoneIsNamed) {
    model::Character stick = tests::make_stick();
    tests::add_gait(stick, "01", 1, 0.5f, {0, 0, 1.5f});
    tests::add_sway(stick, "02", 0.3f);
    tests::add_sway(stick, "03", 0.05f);
    tests::add_sway(stick, "04", 0.2f);
    for (const Role role : {Role::spectator, Role::standing}) EXPECT_EQ(calm_clip(stick, role), "03");
    for (const Role role : {Role::walker, Role::runner}) EXPECT_EQ(calm_clip(stick, role), "01") << "it goes";
    EXPECT_TRUE(scene::cast(stick).warnings.empty());
}

TEST(Cast, NobodyRunsOnTheSpotWhateverTheClipIsCalled) {
    for (const char* name : {"Run", "mixamo.com", ""}) {
        model::Character stick = tests::make_stick();
        tests::add_gait(stick, name, 1, 0.6f, {0, 0, 3});
        for (const Role role : {Role::spectator, Role::standing}) {
            EXPECT_TRUE(is_held(calm(stick, role))) << name;
        }
        EXPECT_EQ(calm_clip(stick, Role::walker), name);
        EXPECT_FALSE(scene::cast(stick).warnings.empty()) << "nobody is told";
    }
}

// As a walker of whom one foot is always off the ground.
TEST(Cast, WhoOnlyWalksStandsUprightOnBothFeet) {
    model::Character stick = tests::make_stick();
    tests::add_clip(stick, "Walk", 1, [](float s) {
        const float swing = 0.6f * tests::wave_of(s), lift = tests::wave_of(s + 0.25f) > 0 ? 0.5f : -0.5f;
        return tests::StickPose{{0, 0, 2 * s}, swing + lift, -swing - lift, -1.4f + 0.3f * tests::wave_of(s)};
    });
    const model::Clip clip = calm(stick, Role::spectator);
    ASSERT_TRUE(is_mean(clip)) << clip.name;
    const std::vector<glm::vec3> posed = tests::posed(stick, &clip, 0);
    const motion::Bounds box = motion::bounds_of(posed);
    EXPECT_NEAR(box.size().y, tests::stick_height, 0.02f);
    EXPECT_LT(box.size().z, 0.4f) << "in mid-stride";
    const auto lowest = [&](std::size_t first) { return motion::bounds_of({posed.data() + first, 8}).min.y; };
    EXPECT_NEAR(lowest(8), lowest(16), 0.02f) << "a foot is up";
}

TEST(Cast, NobodyStandsWithArmsSpreadWhileThereIsAnythingElse) {
    for (const char* name : {"T-Pose", "TPose", "Take 001", "Idle"}) {
        model::Character stick = tests::make_stick();
        tests::add_t_pose(stick, name);
        const float wide = motion::bounds_of(tests::posed(stick, &stick.clips[0], 0)).size().x;
        EXPECT_EQ(calm_clip(stick, Role::spectator), name) << "there is nothing else";
        tests::add_gait(stick, "Run", 1, 0.6f);
        tests::export_as(stick, 100, {3, 0, 0});
        for (const Role role : {Role::spectator, Role::standing, Role::walker, Role::runner}) {
            const model::Clip clip = calm(stick, role);
            EXPECT_LT(motion::bounds_of(tests::posed(stick, &clip, 0)).size().x, 100 * 0.6f * wide) << name;
        }
    }
}

TEST(Cast, HoldsTheEndOfAClipThatOnlySitsDown) {
    model::Character stick = tests::make_stick();
    tests::add_sitting(stick, "Robot_Sitting", true);
    tests::add_sway(stick, "Robot_Idle", 0.02f);
    EXPECT_TRUE(scene::cast(stick).member.sits);
    const model::Clip clip = calm(stick, Role::spectator);
    ASSERT_TRUE(is_held(clip));
    EXPECT_LT(apart(tests::posed(stick, &clip, 0), tests::posed(stick, &stick.clips[0], 1)), 1e-3f);
    tests::add_sitting(stick, "Robot_Sit", false);
    EXPECT_EQ(calm_clip(stick, Role::spectator), "Robot_Sit");
}

TEST(Cast, DoesWhatItsUserWants) {
    const auto character = with_clips({"Idle", "Walk", "Run", "Dance", "Cheer", "Sit"});
    const std::vector<scene::ActWish> wishes{{scene::Deed::walk, "Dance"},
                                             {scene::Deed::sit, "Cheer"},
                                             {scene::Deed::clap, "Run"},
                                             {scene::Deed::stand, "Walk"}};
    EXPECT_EQ(calm_clip(character, Role::walker, wishes), "Dance");
    EXPECT_EQ(calm_clip(character, Role::spectator, wishes), "Cheer");
    EXPECT_EQ(calm_clip(character, Role::standing, wishes), "Walk") << "even what moves on";
    EXPECT_EQ(calm_clip(character, Role::runner, wishes), "Run");
    EXPECT_EQ(scene::cast(character, wishes).member.acts[static_cast<int>(Role::spectator)].excited.size(), 2u);
    try {
        scene::cast(character, std::vector<scene::ActWish>{{scene::Deed::sit, "Lounge"}});
        ADD_FAILURE() << "took a clip that isn't there";
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        for (const char* part : {"'Lounge'", "sit", "'Idle'", "'Dance'"})
            EXPECT_NE(text.find(part), std::string::npos) << text;
        EXPECT_LT(text.size(), 200u);
    }
    EXPECT_THROW(scene::cast(with_clips({}), std::vector<scene::ActWish>{{scene::Deed::sit, "Sit"}}),
                 std::runtime_error);
}

constexpr motion::Bounds seated_person{{-0.3f, 0, -0.2f}, {0.3f, 1.4f, 0.5f}};  // [m]

TEST(Room, SittersTakeSeats) {
    tests::FakeCast cast = tests::sitters();
    cast.poses[0].clip_boxes[tests::clip_sit] = seated_person;
    const scene::Room room = scene::room_for(cast.members, cast.poses);
    EXPECT_TRUE(room.seats);
    EXPECT_EQ(room.width, scene::Room{}.width);
}

TEST(Room, SeatsAreAsWideAsWhoIsMuchWiderThanAPerson) {
    tests::FakeCast cast = tests::sitters();
    const std::size_t calm = cast.members[0].acts[static_cast<int>(Role::spectator)].calm.front();
    cast.poses[0].clip_boxes[calm] = {{-0.4f, 0, -0.3f}, {0.4f, 1.2f, 0.6f}};
    EXPECT_EQ(scene::room_for(cast.members, cast.poses).width, scene::Room{}.width) << "elbows";
    cast.poses[0].clip_boxes[calm] = {{-0.7f, 0, -0.5f}, {0.7f, 1.2f, 0.7f}};
    const scene::Room room = scene::room_for(cast.members, cast.poses);
    EXPECT_TRUE(room.seats);
    EXPECT_NEAR(room.width, 1.4f * 1.7f / 1.75f, 1e-5f);
    EXPECT_NEAR(room.depth, 1.2f * 1.7f / 1.75f, 1e-5f);
}

TEST(Room, TerracesAreAsWideAndDeepAsTheirCast) {
    tests::FakeCast cast;
    tests::add_stander(cast);  // 1.1 m wide and 1.2 m deep at 1.75 m
    const scene::Room room = scene::room_for(cast.members, cast.poses);
    EXPECT_FALSE(room.seats);
    EXPECT_NEAR(room.width, 1.1f * 1.7f / 1.75f, 1e-5f);
    EXPECT_NEAR(room.depth, 1.2f * 1.7f / 1.75f, 1e-5f);
    const scene::StadiumPlan plan = scene::plan_stadium(5000, room);
    for (std::size_t i = 1; i < plan.seats.size(); ++i) {
        if (plan.seats[i].row != plan.seats[i - 1].row) continue;
        EXPECT_GT(glm::distance(plan.seats[i].position, plan.seats[i - 1].position), room.width - 1e-3f);
    }
    for (std::size_t row = 1; row < plan.rows.size(); ++row)
        EXPECT_GT(plan.rows[row].offset - plan.rows[row - 1].offset, room.depth - 1e-3f);
}

TEST(Room, IsWhatTheWidestAndTheDeepestNeedWhileTheyWatch) {
    constexpr float average = 1.7f;  // [m]
    tests::FakeCast cast = tests::sitters();
    cast.poses[0].clip_boxes[tests::clip_sit] = seated_person;
    for (int i = 0; i < 3; ++i) tests::add_stander(cast);
    const motion::Bounds slim{{-0.2f, 0, -0.2f}, {0.2f, 2, 0.2f}}, wide{{-0.6f, 0, -0.3f}, {0.6f, 2, 0.3f}},
        deep{{-0.3f, 0, -0.9f}, {0.3f, 2, 0.9f}}, huge{{-9, 0, -9}, {9, 2, 9}};
    for (std::size_t i = 1; i < cast.poses.size(); ++i) {
        cast.poses[i].box = huge;  // as it is in clips that nobody watches in
        cast.poses[i].rest_height = 2;
        cast.poses[i].clip_boxes = {i == 1 ? wide : i == 2 ? deep : slim, huge};
    }
    const scene::Room room = scene::room_for(cast.members, cast.poses);
    EXPECT_FALSE(room.seats);
    EXPECT_NEAR(room.width, 1.2f * average / 2, 1e-5f);
    EXPECT_NEAR(room.depth, 1.8f * average / 2, 1e-5f);
}

TEST(Room, IsNeverLessThanASeatNorMoreThanATerraceMayBe) {
    tests::FakeCast cast;
    tests::add_stander(cast);
    cast.poses[0].clip_boxes[0] = {{-0.1f, 0, -0.1f}, {0.1f, 2, 0.1f}};
    EXPECT_EQ(scene::room_for(cast.members, cast.poses).width, scene::Room{}.width);
    EXPECT_EQ(scene::room_for(cast.members, cast.poses).depth, scene::Room{}.depth);
    cast.poses[0].clip_boxes[0] = {{-9, 0, -9}, {9, 2, 9}};
    EXPECT_NEAR(scene::room_for(cast.members, cast.poses).width, 1.5f, 1e-6f);
    EXPECT_NEAR(scene::room_for(cast.members, cast.poses).depth, 2.4f, 1e-6f);
}

TEST(Room, GiantsDoNotBreakTheStadium) {
    tests::FakeCast cast;
    tests::add_stander(cast);
    cast.poses[0].clip_boxes[0] = {{-50, 0, -80}, {50, 1, 80}};
    const scene::Room room = scene::room_for(cast.members, cast.poses);
    EXPECT_LE(room.width, 3);
    EXPECT_LE(room.depth, 3);
    EXPECT_EQ(scene::populate(scene::plan_stadium(3000, room), {3000, cast.members, cast.poses, 1}).size(), 3000u);
}

TEST(Crowd, StandsOnTheGroundWhateverItsModelsOrigin) {
    tests::FakeCast cast;
    tests::add_stander(cast);
    cast.poses[0].floor = -0.7f;  // the origin is in the model's middle
    const scene::StadiumPlan plan = scene::plan_stadium(2000);
    const scene::Crowd crowd = scene::populate(plan, {2000, cast.members, cast.poses, 1});
    const scene::Crowd level = [&] {
        cast.poses[0].floor = 0;
        return scene::populate(plan, {2000, cast.members, cast.poses, 1});
    }();
    for (std::size_t person = 0; person < crowd.size(); ++person) {
        const float lowest = scene::place(crowd, person, cast.members[0], 77).position.y +
                             crowd.height[person] / cast.poses[0].rest_height * -0.7f;
        EXPECT_NEAR(lowest, scene::place(level, person, cast.members[0], 77).position.y, 1e-5f);
    }
}

}  // namespace
