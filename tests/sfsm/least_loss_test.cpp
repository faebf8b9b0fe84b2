// The plan of least loss against brute force over the steps of random forecasts.
#include "sfsm/least_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr double rounding = 1e-9;  // relative, of sums of a few products

// Steps as a renderer makes them: along each list work falls and loss grows.
struct Steps {
    std::vector<MotionStep> motion;
    std::vector<SplatStep> splats;
    WorkPrices prices;

    explicit Steps(std::mt19937_64& random) {
        const int motions = 1 + static_cast<int>(random() % 8), sizes = static_cast<int>(random() % 12);
        std::int64_t updates = 10'000;
        double loss = 0, share = 1;
        for (int i = 0; i < motions; ++i) {
            motion.push_back({i == 0 ? std::numeric_limits<double>::infinity() : share * test_range, updates, loss});
            updates = static_cast<std::int64_t>(uniform(random, 0.3, 1) * static_cast<double>(updates));
            share *= uniform(random, 0.7, 0.99);
            loss += uniform(random, 0, 2);
        }
        splats.push_back({0, 1'000'000, 0, 0});
        std::int64_t points = 800'000;
        double size = 0.5;
        loss = 0;
        for (int i = 0; i < sizes; ++i) {
            loss += uniform(random, 0, 2);
            splats.push_back({size, points / 4, points, loss});
            points = static_cast<std::int64_t>(uniform(random, 0.5, 1) * static_cast<double>(points));
            size *= std::exp2(0.25);
        }
        // Points that cost more than the triangles they stand for are in no renderer's list.
        const double point = uniform(random, 0, 1e-5);
        prices = {uniform(random, 0, 5), point + uniform(random, 0, 1e-5), point, uniform(random, 0, 1e-3)};
    }
    Forecast forecast() const { return {1000, motion, splats}; }

    double ms(const MotionStep& m, const SplatStep& s) const {
        return prices.frame + prices.motion_update * static_cast<double>(m.updates) +
               prices.triangle * static_cast<double>(s.triangles) + prices.point * static_cast<double>(s.points);
    }
};

TEST(LeastLoss, NoPairOfStepsThatFitsLosesLess) {
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Steps steps(random);
        const double least = steps.ms(steps.motion.back(), steps.splats.back());
        const double most = steps.ms(steps.motion.front(), steps.splats.front());
        const double budget = uniform(random, 0.9 * least, 1.1 * most);
        const Plan plan = least_loss_plan(steps.forecast(), test_range, steps.prices, budget);
        if (budget >= least) {
            ASSERT_LE(plan_ms(plan, steps.prices), budget * (1 + rounding)) << trial;
        } else {
            ASSERT_EQ(plan.loss_px, cheapest_plan(steps.forecast(), test_range).loss_px) << trial;
        }
        for (const MotionStep& m : steps.motion) {
            for (const SplatStep& s : steps.splats) {
                if (steps.ms(m, s) > budget) continue;
                ASSERT_LE(plan.loss_px, m.loss_px + s.loss_px + rounding) << trial;
            }
        }
    }
}

TEST(LeastLoss, MoreTimeNeverLosesMore) {
    std::mt19937_64 random(2);
    for (int trial = 0; trial < 200; ++trial) {
        const Steps steps(random);
        double before = std::numeric_limits<double>::infinity();
        for (double budget = 0; budget < 60; budget += 0.5) {
            const double loss = least_loss_plan(steps.forecast(), test_range, steps.prices, budget).loss_px;
            ASSERT_LE(loss, before + rounding) << trial << " at " << budget << " ms";
            before = loss;
        }
        ASSERT_EQ(before, 0) << "everything fits";
    }
}

// Between two steps all of the time is used, but where there is no between: from triangles to the finest points, and
// down from a distance without end.
TEST(LeastLoss, ABudgetBetweenTwoSplatSizesIsMetBetweenThem) {
    const std::vector<MotionStep> motion = {{test_range, 0, 0}};
    const std::vector<SplatStep> splats = {{0, 1000, 0, 0}, {1, 0, 800, 2}, {2, 0, 400, 4}};
    const Forecast forecast{100, motion, splats};
    const WorkPrices prices{1, 0.01, 0.01, 0};
    const Plan middle = least_loss_plan(forecast, test_range, prices, 1 + 6);
    EXPECT_NEAR(middle.loss_px, 3, rounding);
    EXPECT_NEAR(middle.size, std::sqrt(2), rounding) << "logarithms over logarithms";
    EXPECT_NEAR(middle.points, std::sqrt(800 * 400), 1e-6);
    const Plan above = least_loss_plan(forecast, test_range, prices, 1 + 9);
    EXPECT_EQ(above.size, 1) << "no splat is between none and the finest";
    EXPECT_EQ(above.triangles, 0);
}

TEST(LeastLoss, ABudgetBetweenTwoDistancesIsMetBetweenThem) {
    const std::vector<MotionStep> motion = {
        {std::numeric_limits<double>::infinity(), 1000, 0}, {120, 600, 1}, {60, 200, 3}};
    const std::vector<SplatStep> splats = {{0, 0, 0, 0}};
    const Forecast forecast{1000, motion, splats};
    const WorkPrices prices{2, 0, 0, 0.01};
    const Plan low = least_loss_plan(forecast, test_range, prices, 2 + 4);
    EXPECT_NEAR(low.distance, 90, rounding);
    EXPECT_NEAR(low.motion_updates, 400, rounding);
    EXPECT_NEAR(low.loss_px, 2, rounding);
    const Plan high = least_loss_plan(forecast, test_range, prices, 2 + 8);
    EXPECT_NEAR(high.distance, 160, rounding) << "everybody moving is D = L";
    EXPECT_NEAR(high.loss_px, 0.5, rounding);
}

TEST(PlanAt, IsTheStepAtAStepAndTheEndBeyondTheEnds) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 300; ++trial) {
        const Steps steps(random);
        const Forecast forecast = steps.forecast();
        for (const MotionStep& m : steps.motion) {
            for (const SplatStep& s : steps.splats) {
                const Plan plan = plan_at(forecast, test_range, std::min(m.distance, test_range), s.size);
                ASSERT_NEAR(plan.motion_updates, static_cast<double>(m.updates), rounding * 1e4);
                ASSERT_NEAR(plan.triangles, static_cast<double>(s.triangles), rounding * 1e6);
                ASSERT_NEAR(plan.points, static_cast<double>(s.points), rounding * 1e6);
                ASSERT_NEAR(plan.loss_px, m.loss_px + s.loss_px, rounding);
            }
        }
        const Plan cheapest = plan_at(forecast, test_range, 0, 1e9);
        ASSERT_EQ(cheapest.loss_px, cheapest_plan(forecast, test_range).loss_px);
        ASSERT_EQ(plan_at(forecast, test_range, 1e9, 0).loss_px, 0);
    }
}

TEST(PlanAt, GivesBackEveryPlanOfLeastLoss) {
    std::mt19937_64 random(4);
    for (int trial = 0; trial < 500; ++trial) {
        const Steps steps(random);
        const Plan plan = least_loss_plan(steps.forecast(), test_range, steps.prices, uniform(random, 0, 40));
        const Plan again = plan_at(steps.forecast(), test_range, plan.distance, plan.size);
        // Sizes and counts lie on curves through both ends; the way back is as straight as a quarter octave is.
        ASSERT_NEAR(again.loss_px, plan.loss_px, 0.02 * (1 + plan.loss_px)) << trial;
        ASSERT_NEAR(again.points, plan.points, 0.01 * plan.points + 1) << trial;
        ASSERT_NEAR(again.motion_updates, plan.motion_updates, 1) << trial;
    }
}

TEST(SlowerPlan, HasTheFirstStepWithNoMoreThanThatShareOfTheMotion) {
    std::mt19937_64 random(5);
    for (int trial = 0; trial < 500; ++trial) {
        const Steps steps(random);
        const Forecast forecast = steps.forecast();
        const Plan plan = plan_at(forecast, test_range, test_range, steps.splats.back().size);
        for (const double share : {0.9, 0.5, 0.1}) {
            const Plan slower = slower_plan(forecast, test_range, plan, share);
            double expected = static_cast<double>(steps.motion.back().updates);
            for (const MotionStep& step : steps.motion) {
                const auto updates = static_cast<double>(step.updates);
                if (updates <= share * plan.motion_updates) expected = std::max(expected, updates);
            }
            ASSERT_EQ(slower.motion_updates, expected) << trial;
            ASSERT_EQ(slower.size, plan.size);
            ASSERT_EQ(slower.points, plan.points);
        }
    }
}

}  // namespace
}  // namespace sfsm
