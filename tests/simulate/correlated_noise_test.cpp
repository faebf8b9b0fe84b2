// The default law under noise that remembers.
#include <gtest/gtest.h>

#include "tests/simulate/default_row.h"

namespace sfsm::simulate {
namespace {

TEST(DefaultLaw, HoldsStillUnderNoiseThatRemembers) {
    for (const char* name : {"correlated", "correlated-forecast"}) {
        for (const double correlation : {0.8, 0.9, 0.95}) {
            Scenario scenario = make_scenario(name);
            scenario.correlation = correlation;
            const Row row = row_of(scenario);
            EXPECT_LE(row.median.reversals_per_1000, 4) << name << ' ' << correlation;
            EXPECT_GE(row.median.quality, 0.96) << name << ' ' << correlation;
            EXPECT_LE(row.median.over_5pct, row.oracle_over_5pct + 0.01) << name << ' ' << correlation;
        }
    }
}

TEST(DefaultLaw, AnswersAStepUnderNoiseThatRemembers) {
    for (const char* name : {"toy", "throttled"}) {
        Scenario scenario = make_scenario(name);
        scenario.correlation = 0.9;
        const Row row = row_of(scenario);
        ASSERT_TRUE(row.median.settle_down) << name;
        EXPECT_LE(*row.median.settle_down, 20) << name;
        EXPECT_GE(row.median.quality, 0.95) << name;
    }
}

}  // namespace
}  // namespace sfsm::simulate
