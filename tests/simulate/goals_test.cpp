// What the default law is to reach, on fewer seeds than the scorecard has. docs/scorecard.md says how far it is beyond.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "sfsm/simulate/metrics.h"
#include "sfsm/simulate/work_plant.h"
#include "sfsm/simulate/work_scenarios.h"
#include "tests/simulate/default_row.h"

namespace sfsm::simulate {
namespace {

TEST(DefaultLaw, ReachesTheToysGoals) {
    const Row row = row_of("toy");
    EXPECT_LE(row.median.over_5pct, row.oracle_over_5pct + 0.01);
    EXPECT_GE(row.median.quality, 0.985);
    ASSERT_TRUE(row.median.settle_down);
    ASSERT_TRUE(row.median.settle_up);
    EXPECT_LE(*row.median.settle_down, 4);
    EXPECT_LE(*row.median.settle_up, 10);
    EXPECT_LE(row.median.reversals_per_1000, 2);
}

TEST(DefaultLaw, IsInBandOnTheFirstFrameOfWhatAForecastSays) {
    for (const char* scenario : {"camera-cut", "crowd-pours-in", "target-step-forecast"}) {
        const Row row = row_of(scenario);
        EXPECT_EQ(row.median.cost_settle_down, 0) << scenario;
        EXPECT_EQ(row.median.cost_settle_up, 0) << scenario;
    }
}

TEST(DefaultLaw, ChangesNothingInTheQuiet) {
    for (const char* scenario : {"quiet", "quiet-noisy", "quiet-forecast"}) {
        EXPECT_EQ(row_of(scenario).median.changes_per_1000, 0) << scenario;
    }
}

TEST(DefaultLaw, HoldsAHeavyTailBelowFivePercentOver) {
    const Row row = row_of("heavy-tail");
    EXPECT_LE(row.median.over_5pct, 0.035);
    EXPECT_GE(row.oracle_over_5pct, 0.1) << "and it is heavy";
    EXPECT_GE(row.median.quality, 0.96);
    EXPECT_LE(row.median.reversals_per_1000, 2);
}

TEST(DefaultLaw, IsBackAfterEveryInterruption) {
    for (const char* scenario : {"hitch", "pause", "loading"}) {
        const Row row = row_of(scenario);
        ASSERT_TRUE(row.median.recovery) << scenario;
        EXPECT_LE(*row.median.recovery, 30) << scenario;
    }
}

TEST(DefaultLaw, TakesWaitingForACapForNoLoad) {
    for (const char* scenario : {"frame-cap-2", "frame-cap-5", "frame-cap-10"}) {
        const Row row = row_of(scenario);
        ASSERT_TRUE(row.worst.regain) << scenario;
        EXPECT_LE(*row.worst.regain, 120) << scenario;
    }
}

TEST(DefaultLaw, IsStuckInNoSeedAfterACpuBoundEpisode) {
    for (const char* scenario : {"cpu-bound", "cpu-bound-long"})
        EXPECT_EQ(row_of(scenario, 80).stuck_seeds, 0) << scenario;
}

TEST(DefaultLaw, KeepsItsDetailUnderHeavyTailsInEverySeed) {
    EXPECT_GE(row_of("heavy-tail-knob").worst.quality, 0.97);
}

TEST(DefaultLaw, RegainsItsDetailWhenALoadHasFallen) {
    for (const char* scenario : {"fallen-load", "fallen-load-stepped"}) {
        const Row row = row_of(scenario, 30);
        ASSERT_TRUE(row.worst.regain) << scenario;
        EXPECT_LE(*row.worst.regain, 100) << scenario;
    }
    for (const char* scenario : {"fallen-load", "fallen-load-stepped"})
        EXPECT_GE(row_of(scenario, 30).worst.quality, 0.97) << scenario;
}

TEST(DefaultLaw, SettlesWithinTwentyFramesOfAnUntoldCutInEverySeed) {
    const Row row = row_of("untold-cut", 30);
    ASSERT_TRUE(row.worst.cost_settle_down);
    ASSERT_TRUE(row.worst.cost_settle_up);
    EXPECT_LE(*row.worst.cost_settle_down, 20);
    EXPECT_LE(*row.worst.cost_settle_up, 20);
}

TEST(DefaultLaw, TakesTwiceATargetInReachInNoneOfTheFirstTenFrames) {
    for (const char* scenario : {"toy", "fallen-load", "camera-cut", "heavy-tail", "untold-cut", "slow-machine"})
        EXPECT_LE(row_of(scenario, 30).worst.first_over, 2) << scenario;
}

TEST(DefaultLaw, TurnsInNoSeedOfASteadyView) {
    EXPECT_LE(row_of("camera-cut", 80).worst.reversals_per_1000, 5);
}

// Machines whose kinds of work compare otherwise than is believed at first, each kind's price up to 50 times another's.
TEST(DefaultLaw, LeapsNotIntoTheDarkOnAnyMachine) {
    std::mt19937_64 random(1);
    const auto between = [&](double least, double most) {
        return least * std::pow(most / least, static_cast<double>(random() >> 11) * 0x1p-53);
    };
    int leaps = 0;
    for (int i = 0; i < 100; ++i) {
        const Prices prices{between(0.5, 3),
                            {between(2e-6, 5e-5), between(2e-7, 1e-5), between(2e-7, 1e-5), between(5e-5, 2e-3)}};
        Scenario scenario = work_scenario("a machine", {wide}, only_view, {});
        scenario.plant = std::make_shared<WorkPlant>(prices, std::vector<View>{wide}, only_view, Unforeseen{});
        scenario.frames = 10;
        scenario.steady = {};
        const Course course = make_course(scenario);
        std::vector<Outcome> outcomes;
        run(course, *make_controller("predictive"), {.seed = 1, .target_factor = 1, .now_us = {}}, outcomes);
        leaps += measure(course, outcomes).first_over > 2 ? 1 : 0;
    }
    EXPECT_LE(leaps, 1);
}

// By the plant's own prices the least is 301 ms, and the rule about detail that is worth its time says 351, with the
// noise 353 in the mean.
TEST(DefaultLaw, OutOfReachNoRunIsFarFromWhatDetailIsWorth) {
    const Row row = row_of("out-of-reach", 30);
    EXPECT_GE(row.least_mean_ms, 0.9 * 353);
    EXPECT_LE(row.worst.mean_ms, 1.1 * 353);
}

TEST(DefaultLaw, HoldsAHiddenCostThatMoves) {
    const Row row = row_of("hidden-cost");
    EXPECT_GE(row.median.quality, 0.95);
    EXPECT_LE(row.median.over_5pct, 0.08);
}

TEST(DefaultLaw, HoldsThePapersTargetsBetterThanThePaper) {
    EXPECT_GE(row_of("paper-1").median.control_rate, 0.99);
    EXPECT_GE(row_of("paper-2").median.control_rate, 0.99);
    EXPECT_LE(row_of("paper-1").median.cost_settle_down, 3);
}

TEST(SafeguardedLaw, TakesNoBurstForAJumpInCost) {
    const Row row = row_of(make_scenario("bursts"), 30, contestant("safeguarded"));
    EXPECT_GE(row.worst.quality, 0.9);
}

}  // namespace
}  // namespace sfsm::simulate
