// Long runs: the same as short ones, in stretches, and what creeps in them.
#include "sfsm/simulate/endurance.h"

#include <gtest/gtest.h>

#include "sfsm/simulate/metrics.h"

namespace sfsm::simulate {
namespace {

TEST(Endurance, OneLapIsTheRunOfTheScenario) {
    for (const char* name : {"quiet-noisy", "camera-cut"}) {
        Scenario scenario = make_scenario(name);
        scenario.statistics_from = 0;
        const Course course = make_course(scenario);
        std::vector<Outcome> outcomes;
        run(course, *make_controller("predictive"), {.seed = 3, .target_factor = 1, .now_us = {}}, outcomes);
        const Metrics metrics = measure(course, outcomes);
        const std::vector<Stretch> stretches = endure(course, *make_controller("predictive"), 3, scenario.frames, 1);
        ASSERT_EQ(stretches.size(), 1u);
        EXPECT_EQ(stretches[0].end, scenario.frames);
        EXPECT_NEAR(stretches[0].over_5pct, metrics.over_5pct, 1e-12) << name;
        EXPECT_NEAR(stretches[0].quality, metrics.quality, 1e-12) << name;
    }
}

TEST(Endurance, StretchesAreEqualButTheLast) {
    const Course course = make_course(make_scenario("quiet"));
    const std::vector<Stretch> stretches = endure(course, *make_controller("paper"), 1, 10'001, 4);
    ASSERT_EQ(stretches.size(), 4u);
    EXPECT_EQ(stretches[0].end, 2501);
    EXPECT_EQ(stretches[2].end, 7503);
    EXPECT_EQ(stretches[3].end, 10'001);
}

// The gain itself creeps (docs/scorecard.md); what is drawn must not show it.
TEST(DefaultLaw, HoldsItsQualityOverTwoMillionFrames) {
    const Course course = make_course(make_scenario("toy"));
    for (const Stretch& stretch : endure(course, *make_controller("predictive"), 1, 2'000'000, 20)) {
        EXPECT_GE(stretch.quality, 0.975) << stretch.end;
        EXPECT_LE(stretch.over_5pct, 0.05) << stretch.end;
    }
}

}  // namespace
}  // namespace sfsm::simulate
