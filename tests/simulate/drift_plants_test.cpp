// The default law where the load never rests, beside the best rival there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sfsm/rivals/laws.h"
#include "sfsm/simulate/knob_scenarios.h"
#include "tests/simulate/default_row.h"

namespace sfsm::simulate {
namespace {

Scenario swinging(double period, double height, int delay) {
    const OverFrames load = [=](std::int64_t frame) {
        return 1 + height * (1 - std::cos(2 * std::numbers::pi * static_cast<double>(frame) / period)) / 2;
    };
    Scenario scenario = knob_scenario("swinging", model_of(load), 0.03, 3600);
    scenario.delay = delay;
    return scenario;
}

TEST(DefaultLaw, HoldsALoadThatSwingsBetterThanTheBestRival) {
    struct Case {
        double period, height;
        int delay;
    };
    for (const auto& [period, height, delay] :
         {Case{80, 0.33, 2}, Case{150, 0.33, 2}, Case{150, 0.5, 1}, Case{250, 0.4, 4}, Case{300, 0.33, 2}}) {
        ScorecardOptions options;
        options.scenarios = {swinging(period, height, delay)};
        options.laws = {the_default(), {"robust-mpc", [](const Course&) { return make_robust_mpc(); }, true}};
        options.reference = the_default();
        options.seeds = some_seeds;
        const std::vector<Row> rows = scorecard(options);
        const Row &ours = rows.front(), &theirs = rows.back();
        ASSERT_EQ(theirs.tuning, Tuning::equal_miss);
        EXPECT_LE(ours.median.over_5pct, 0.075) << period;
        EXPECT_GT(ours.median.quality, theirs.median.quality) << period << " frames, height " << height;
        EXPECT_GT(ours.worst.quality, 0.94) << period;
    }
}

}  // namespace
}  // namespace sfsm::simulate
