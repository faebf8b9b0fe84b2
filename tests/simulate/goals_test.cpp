// What the default law is to reach, on fewer seeds than the scorecard has. docs/scorecard.md says how far it is beyond.
#include <gtest/gtest.h>

#include "sfsm/simulate/scorecard.h"

namespace sfsm::simulate {
namespace {

constexpr int some_seeds = 9;

Contestant the_default() {
    const std::string name(law_names().front());
    return {name, [=](const Course&) { return make_controller(name); }, false};
}

Row row_of(const char* scenario, int seeds = some_seeds) {
    ScorecardOptions options;
    options.scenarios = {make_scenario(scenario)};
    options.laws = {the_default()};
    options.reference = the_default();
    options.seeds = seeds;
    return scorecard(options).front();
}

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
    EXPECT_GE(row_of("fallen-load", 30).worst.quality, 0.97);
    EXPECT_GE(row_of("fallen-load-stepped", 30).worst.quality, 0.93) << "a level may lie 7 % below where its cost ends";
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

}  // namespace
}  // namespace sfsm::simulate
