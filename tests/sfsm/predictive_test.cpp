// The closed loop of the default law, with and without a forecast.
#include "sfsm/predictive.h"

#include <gtest/gtest.h>

#include "sfsm/detail.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr int most_delay = 4;
constexpr double target_ms = 1000.0 / 60;

TEST(PredictiveLaw, MeetsALinearPlantWithinAFewAnswers) {
    for (int delay = 0; delay <= most_delay; ++delay) {
        const Time time = [](std::int64_t, const Decision& decision) {
            return target_ms * (0.3 + 1.2 * detail_of(decision, test_range));
        };
        PredictiveLaw law;
        const auto rows = run(law, {time, constant(target_ms), 200, delay});
        for (const TraceRow& row : rows) {
            if (row.frame < 3 * (delay + 2)) continue;
            EXPECT_NEAR(row.frame_ms, target_ms, 0.05 * target_ms) << "delay " << delay << " frame " << row.frame;
        }
    }
}

}  // namespace
}  // namespace sfsm
