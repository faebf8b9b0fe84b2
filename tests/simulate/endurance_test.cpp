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

struct Enduring {
    const char* scenario;
    double least_gain, most_gain;  // the toy's load itself swings by 1.6
    double least_quality, most_over;
};

TEST(DefaultLaw, HoldsGainAndQualityOverTwoMillionFrames) {
    for (const Enduring& expected :
         {Enduring{"toy", 0.5, 2, 0.975, 0.05}, Enduring{"quiet-noisy", 0.95, 1.05, 0.985, 0.001},
          Enduring{"camera-cut", 0.9, 1.1, 0.985, 0.04}, Enduring{"heavy-tail", 0.9, 1.1, 0.955, 0.04}}) {
        const Course course = make_course(make_scenario(expected.scenario));
        for (const Stretch& stretch : endure(course, *make_controller("predictive"), 1, 2'000'000, 20)) {
            EXPECT_GE(stretch.gain, expected.least_gain) << expected.scenario << " " << stretch.end;
            EXPECT_LE(stretch.gain, expected.most_gain) << expected.scenario << " " << stretch.end;
            EXPECT_GE(stretch.quality, expected.least_quality) << expected.scenario << " " << stretch.end;
            EXPECT_LE(stretch.over_5pct, expected.most_over) << expected.scenario << " " << stretch.end;
        }
    }
}

}  // namespace
}  // namespace sfsm::simulate
