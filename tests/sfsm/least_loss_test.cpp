// The plan of least loss against brute force over the steps of random forecasts.
#include "sfsm/least_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/sfsm/simulation.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

constexpr double rounding = 1e-9;  // relative, of sums of a few products

// Steps as a renderer makes them: along each list work falls and loss grows.
struct Steps {
    std::vector<Step> motion, shapes;
    Prices prices;

    explicit Steps(std::mt19937_64& random) {
        const int motions = 1 + static_cast<int>(random() % 8), sizes = static_cast<int>(random() % 12);
        std::int64_t updates = 10'000;
        double loss = 0, share = 1;
        for (int i = 0; i < motions; ++i) {
            motion.push_back(
                motion_step(i == 0 ? std::numeric_limits<double>::infinity() : share * test_range, updates, loss));
            updates = static_cast<std::int64_t>(uniform(random, 0.3, 1) * static_cast<double>(updates));
            share *= uniform(random, 0.7, 0.99);
            loss += uniform(random, 0, 2);
        }
        shapes.push_back(shape_step(0, 1'000'000, 0, 0));
        std::int64_t points = 800'000;
        double size = 0.5;
        loss = 0;
        for (int i = 0; i < sizes; ++i) {
            loss += uniform(random, 0, 2);
            shapes.push_back(shape_step(size, points / 4, points, loss));
            points = static_cast<std::int64_t>(uniform(random, 0.5, 1) * static_cast<double>(points));
            size *= std::exp2(0.25);
        }
        // Points that cost more than the triangles they stand for are in no renderer's list.
        const double point = uniform(random, 0, 1e-5);
        prices = {uniform(random, 0, 5), {0, point + uniform(random, 0, 1e-5), point, uniform(random, 0, 1e-3)}};
    }
    Forecast forecast() const { return {Work{1000}, motion, shapes}; }

    double ms(const Step& m, const Step& s) const {
        double ms = prices.frame;
        for (std::size_t i = 0; i < work_kinds; ++i)
            ms += prices.each[i] * static_cast<double>(m.work.counts[i] + s.work.counts[i]);
        return ms;
    }
};

TEST(LeastLoss, NoPairOfStepsThatFitsLosesLess) {
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Steps steps(random);
        const double least = steps.ms(steps.motion.back(), steps.shapes.back());
        const double most = steps.ms(steps.motion.front(), steps.shapes.front());
        const double budget = uniform(random, 0.9 * least, 1.1 * most);
        const Plan plan = least_loss_plan(steps.forecast(), test_range, steps.prices, budget);
        if (budget >= least) {
            ASSERT_LE(plan_ms(plan, steps.prices), budget * (1 + rounding)) << trial;
        } else {
            ASSERT_EQ(plan.loss, cheapest_plan(steps.forecast(), test_range).loss) << trial;
        }
        for (const Step& m : steps.motion) {
            for (const Step& s : steps.shapes) {
                if (steps.ms(m, s) > budget) continue;
                ASSERT_LE(plan.loss, m.loss_px + s.loss_px + rounding) << trial;
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
            const double loss = least_loss_plan(steps.forecast(), test_range, steps.prices, budget).loss;
            ASSERT_LE(loss, before + rounding) << trial << " at " << budget << " ms";
            before = loss;
        }
        ASSERT_EQ(before, 0) << "everything fits";
    }
}

// Natively splats below half a pixel gain nothing, and where nobody is excited a shorter D loses nothing.
TEST(LeastLoss, OfEqualLossesTheCheapestIsTaken) {
    const std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), 1000, 0),
                                      motion_step(120, 600, 0), motion_step(60, 200, 3)};
    const std::vector<Step> shapes = {shape_step(0, 90'000, 0, 0), shape_step(0.25, 0, 3200, 1),
                                      shape_step(0.35, 0, 1600, 1), shape_step(0.5, 0, 800, 1),
                                      shape_step(1, 0, 400, 2)};
    const Forecast forecast{Work{100}, motion, shapes};
    const Prices prices{1, {0, 0.01, 0.01, 0.01}};
    for (const double budget : {1 + 6 + 8.001, 1 + 6 + 12.0, 1 + 10 + 17.0, 1 + 10 + 500.0}) {
        const Plan plan = least_loss_plan(forecast, test_range, prices, budget);
        EXPECT_EQ(plan.size, 0.5) << budget;
        EXPECT_EQ(plan.distance, 120) << budget;
        EXPECT_EQ(plan.loss, 1) << budget;
    }
    EXPECT_EQ(least_loss_plan(forecast, test_range, prices, 1 + 6 + 900.0).size, 0) << "triangles lose less";
}

TEST(LeastLoss, NoPairOfStepsLosesAsLittleForLess) {
    std::mt19937_64 random(6);
    for (int trial = 0; trial < 1000; ++trial) {
        Steps steps(random);
        for (std::size_t i = 1; i < steps.motion.size(); ++i)
            if (random() % 2) steps.motion[i].loss_px = steps.motion[i - 1].loss_px;
        for (std::size_t i = 2; i < steps.shapes.size(); ++i)
            if (random() % 2) steps.shapes[i].loss_px = steps.shapes[i - 1].loss_px;
        const double most = steps.ms(steps.motion.front(), steps.shapes.front());
        const Plan plan = least_loss_plan(steps.forecast(), test_range, steps.prices, uniform(random, 0, 1.1 * most));
        for (const Step& m : steps.motion)
            for (const Step& s : steps.shapes)
                if (m.loss_px + s.loss_px == plan.loss) {
                    ASSERT_LE(plan_ms(plan, steps.prices), steps.ms(m, s) * (1 + rounding)) << trial;
                }
    }
}

TEST(LeastLoss, OfPlansThatFitNoPairOfStepsHasCheaperDetailThanTheWorthwhile) {
    std::mt19937_64 random(7);
    int coarser = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Steps steps(random);
        const double cheapest = steps.ms(steps.motion.back(), steps.shapes.back());
        const double budget = uniform(random, 0.9, 3) * cheapest;
        const Plan plan = worthwhile_plan(steps.forecast(), test_range, steps.prices, budget);
        const Plan finest = least_loss_plan(steps.forecast(), test_range, steps.prices, budget);
        const double ms = plan_ms(plan, steps.prices);
        ASSERT_LE(ms, std::max(budget, cheapest) * (1 + rounding)) << trial;
        ASSERT_LE(ms_of_detail(plan, ms), ms_of_detail(finest, plan_ms(finest, steps.prices)) * (1 + rounding));
        coarser += plan.loss > finest.loss;
        for (const Step& m : steps.motion)
            for (const Step& s : steps.shapes) {
                if (steps.ms(m, s) > budget) continue;
                ASSERT_LE(ms_of_detail(plan, ms), steps.ms(m, s) * (1 + m.loss_px + s.loss_px) * (1 + rounding))
                    << trial;
            }
    }
    EXPECT_GT(coarser, 100);
}

TEST(LeastLoss, CountsAllThatIsKnownBeforehand) {
    const std::vector<Step> motion = {motion_step(test_range, 0, 0)};
    const std::vector<Step> shapes = {shape_step(0, 1000, 0, 0), shape_step(1, 0, 800, 2), shape_step(2, 0, 400, 4)};
    const Prices prices{1, {0.01, 0.01, 0.01, 0, 0.001, 0.0001}};
    const Forecast bare{Work{100}, motion, shapes}, around{Work{100, 0, 0, 0, 3000, 10'000}, motion, shapes};
    for (const double rest : {4.0, 6.0, 8.0, 10.0}) {
        const Plan plan = least_loss_plan(bare, test_range, prices, 1 + 1 + rest);
        const Plan same = least_loss_plan(around, test_range, prices, 1 + 1 + 3 + 1 + rest);
        EXPECT_NEAR(same.size, plan.size, rounding);
        EXPECT_NEAR(plan_ms(same, prices), plan_ms(plan, prices) + 4, rounding);
        EXPECT_EQ(same[WorkKind::structure_triangle], 3000);
        EXPECT_EQ(same[WorkKind::pixel], 10'000);
    }
}

// Between two steps all of the time is used, but where there is no between: from triangles to the finest points, and
// down from a distance without end.
TEST(LeastLoss, ABudgetBetweenTwoSplatSizesIsMetBetweenThem) {
    const std::vector<Step> motion = {motion_step(test_range, 0, 0)};
    const std::vector<Step> shapes = {shape_step(0, 1000, 0, 0), shape_step(1, 0, 800, 2), shape_step(2, 0, 400, 4)};
    const Forecast forecast{Work{100}, motion, shapes};
    const Prices prices{1, {0, 0.01, 0.01, 0}};
    const Plan middle = least_loss_plan(forecast, test_range, prices, 1 + 6);
    EXPECT_NEAR(middle.loss, 3, rounding);
    EXPECT_NEAR(middle.size, std::sqrt(2), rounding) << "logarithms over logarithms";
    EXPECT_NEAR(middle[WorkKind::point], std::sqrt(800 * 400), 1e-6);
    const Plan above = least_loss_plan(forecast, test_range, prices, 1 + 9);
    EXPECT_EQ(above.size, 1) << "no splat is between none and the finest";
    EXPECT_EQ(above[WorkKind::triangle], 0);
}

TEST(LeastLoss, ABudgetBetweenTwoDistancesIsMetBetweenThem) {
    const std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), 1000, 0),
                                      motion_step(120, 600, 1), motion_step(60, 200, 3)};
    const std::vector<Step> shapes = {shape_step(0, 0, 0, 0)};
    const Forecast forecast{Work{1000}, motion, shapes};
    const Prices prices{2, {0, 0, 0, 0.01}};
    const Plan low = least_loss_plan(forecast, test_range, prices, 2 + 4);
    EXPECT_NEAR(low.distance, 90, rounding);
    EXPECT_NEAR(low[WorkKind::motion_update], 400, rounding);
    EXPECT_NEAR(low.loss, 2, rounding);
    const Plan high = least_loss_plan(forecast, test_range, prices, 2 + 8);
    EXPECT_NEAR(high.distance, 160, rounding) << "everybody moving is D = L";
    EXPECT_NEAR(high.loss, 0.5, rounding);
}

TEST(PlanAt, IsTheStepAtAStepAndTheEndBeyondTheEnds) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 300; ++trial) {
        const Steps steps(random);
        const Forecast forecast = steps.forecast();
        for (const Step& m : steps.motion) {
            for (const Step& s : steps.shapes) {
                const Plan plan = plan_at(forecast, test_range, std::min(m.setting, test_range), s.setting);
                ASSERT_NEAR(plan[WorkKind::motion_update], static_cast<double>(m.work[WorkKind::motion_update]),
                            rounding * 1e4);
                ASSERT_NEAR(plan[WorkKind::triangle], static_cast<double>(s.work[WorkKind::triangle]), rounding * 1e6);
                ASSERT_NEAR(plan[WorkKind::point], static_cast<double>(s.work[WorkKind::point]), rounding * 1e6);
                ASSERT_NEAR(plan.loss, m.loss_px + s.loss_px, rounding);
            }
        }
        const Plan cheapest = plan_at(forecast, test_range, 0, 1e9);
        ASSERT_EQ(cheapest.loss, cheapest_plan(forecast, test_range).loss);
        ASSERT_EQ(plan_at(forecast, test_range, 1e9, 0).loss, 0);
    }
}

TEST(PlanAt, GivesBackEveryPlanOfLeastLoss) {
    std::mt19937_64 random(4);
    for (int trial = 0; trial < 500; ++trial) {
        const Steps steps(random);
        const Plan plan = least_loss_plan(steps.forecast(), test_range, steps.prices, uniform(random, 0, 40));
        const Plan again = plan_at(steps.forecast(), test_range, plan.distance, plan.size);
        // Sizes and counts lie on curves through both ends; the way back is as straight as a quarter octave is.
        ASSERT_NEAR(again.loss, plan.loss, 0.02 * (1 + plan.loss)) << trial;
        ASSERT_NEAR(again[WorkKind::point], plan[WorkKind::point], 0.01 * plan[WorkKind::point] + 1) << trial;
        ASSERT_NEAR(again[WorkKind::motion_update], plan[WorkKind::motion_update], 1) << trial;
    }
}

TEST(SlowerPlan, HasTheFirstStepWithNoMoreThanThatShareOfTheMotion) {
    std::mt19937_64 random(5);
    for (int trial = 0; trial < 500; ++trial) {
        const Steps steps(random);
        const Forecast forecast = steps.forecast();
        const Plan plan = plan_at(forecast, test_range, test_range, steps.shapes.back().setting);
        for (const double share : {0.9, 0.5, 0.1}) {
            const Plan slower = slower_plan(forecast, test_range, plan, share);
            double expected = static_cast<double>(steps.motion.back().work[WorkKind::motion_update]);
            for (const Step& step : steps.motion) {
                const auto updates = static_cast<double>(step.work[WorkKind::motion_update]);
                if (updates <= share * plan[WorkKind::motion_update]) expected = std::max(expected, updates);
            }
            ASSERT_EQ(slower[WorkKind::motion_update], expected) << trial;
            ASSERT_EQ(slower.size, plan.size);
            ASSERT_EQ(slower[WorkKind::point], plan[WorkKind::point]);
        }
    }
}

}  // namespace
}  // namespace sfsm
