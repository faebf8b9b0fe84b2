// What names of clips say, in the spellings of many tools.
#include "scene/clip_words.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace {

using scene::Deed;
using Words = std::vector<std::string>;

TEST(ClipWords, BeginWhereSpellingsChange) {
    EXPECT_EQ(scene::words_of("Sit_Chair_Idle"), (Words{"sit", "chair", "idle"}));
    EXPECT_EQ(scene::words_of("cheer_02"), (Words{"cheer", "02"}));
    EXPECT_EQ(scene::words_of("mixamo.com|Run"), (Words{"mixamo", "com", "run"}));
    EXPECT_EQ(scene::words_of("standingIdle2b"), (Words{"standing", "idle", "2", "b"}));
    EXPECT_EQ(scene::words_of("TRexWALKFast"), (Words{"t", "rex", "walk", "fast"}));
    EXPECT_EQ(scene::words_of("walkcycle"), (Words{"walk", "cycle"}));
    EXPECT_EQ(scene::words_of("catwalk"), (Words{"catwalk"}));
    EXPECT_EQ(scene::words_of(" -_|. "), Words{});
    EXPECT_EQ(scene::words_of(""), Words{});
}

// The first of `names` says the deed best.
void expect_best(Deed deed, const Words& names) {
    const auto best = scene::distance(deed, names.front());
    ASSERT_TRUE(best) << names.front();
    for (std::size_t i = 1; i < names.size(); ++i) {
        const auto other = scene::distance(deed, names[i]);
        EXPECT_TRUE(!other || *other > *best) << names.front() << " against " << names[i];
    }
}

TEST(ClipWords, SayWhatIsDoneInAnySpelling) {
    const std::vector<std::pair<Deed, Words>> all = {
        {Deed::stand,
         {"Idle", "idle_01", "Armature|Idle", "Standing Idle", "CharacterArmature|Idle_Neutral", "breathing"}},
        {Deed::walk,
         {"Walk", "WALK", "walking", "Armature|Walk", "mixamo.com|Walking", "Rig|walk.001", "walkcycle",
          "Armature|Walk|BaseLayer", "HumanWalk"}},
        {Deed::run, {"Run", "mixamo.com|Run", "Running_A", "Gallop", "FastRun", "jog", "sprinting"}},
        {Deed::sit, {"Sit_Chair_Idle", "Sitting", "sit", "SittingIdle", "seated", "sit-pose"}},
        {Deed::cheer, {"cheer_02", "Cheering", "Victory", "Celebrate", "victory_idle"}},
        {Deed::clap, {"Clap", "Sitting Clap", "clapping", "Applause"}},
        {Deed::wave, {"Wave", "waving", "Hello"}}};
    for (const auto& [deed, names] : all)
        for (const std::string& name : names) EXPECT_TRUE(scene::distance(deed, name)) << name;
}

TEST(ClipWords, DontSayWhatOnlySoundsLikeIt) {
    for (const char* name : {"Transition", "Position", "SitUp", "Sit_Chair_Down", "Sit_Chair_StandUp", "StandToSit"})
        EXPECT_FALSE(scene::distance(Deed::sit, name)) << name;
    for (const char* name : {"Sit_Chair_Idle", "Jump_Idle", "Lie_Idle", "Understand", "Idle_To_Walk", "Swim_Idle"})
        EXPECT_FALSE(scene::distance(Deed::stand, name)) << name;
    for (const char* name : {"Crunch", "Prune", "Run_Start", "runner", "WalkToRun"})
        EXPECT_FALSE(scene::distance(Deed::run, name)) << name;
    for (const char* name : {"catwalk", "Walk_Stop", "walker|Idle", "Moonwalker"})
        EXPECT_FALSE(scene::distance(Deed::walk, name)) << name;
    EXPECT_FALSE(scene::distance(Deed::wave, "Shockwave"));
}

TEST(ClipWords, SayItBestWhereTheySayNothingElse) {
    expect_best(Deed::walk,
                {"Walking_A", "Walking_Backwards", "Walk_Left", "Walk_Gun", "Crouch_Walk", "Run", "Walk|Fly"});
    expect_best(Deed::run, {"Run", "Run_Shoot", "Run_Back", "Run_Tall", "Running_Strafe_Left", "Running_2"});
    expect_best(Deed::stand, {"Idle", "2H_Melee_Idle", "Idle_Gun", "Unarmed_Idle", "Idle_2", "Idle_HitReact_Left"});
    expect_best(Deed::sit, {"Sit_Chair_Idle", "Sit_Floor_Idle", "Sit_Chair_Pose", "Sit_Chair_Down", "Sit_Clap"});
    expect_best(Deed::run, {"Man|Run", "Run|Jump"});
}

TEST(ClipWords, KnowSpreadArmsByName) {
    for (const char* name : {"T-Pose", "TPose", "tpose", "Armature|T_Pose", "A-Pose", "BindPose", "bind pose"})
        EXPECT_TRUE(scene::is_bind_pose(name)) << name;
    for (const char* name : {"Pose", "Sit_Chair_Pose", "Idle", "Taposed"})
        EXPECT_FALSE(scene::is_bind_pose(name)) << name;
}

}  // namespace
