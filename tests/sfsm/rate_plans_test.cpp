// Plans by rate against brute force over many places of random lists.
#include "sfsm/rate_plans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sfsm/pair_plans.h"
#include "tests/sfsm/rate_scene.h"
#include "tests/sfsm/simulation.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

constexpr double rounding = 1e-9;
constexpr double unused = 1e-3;  // of a budget, that a place between two steps may leave

// Work falls and loss grows along the rates; at the prices the time may still rise. Some steps are leaps.
struct Rates {
    std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), 1000, 0)};
    std::vector<Step> shapes = {shape_step(0, 1000, 0, 0), shape_step(1, 0, 500, 1)};
    std::vector<RateStep> rates;
    Prices prices;

    explicit Rates(std::mt19937_64& random) {
        const int steps = 1 + static_cast<int>(random() % 34);
        double rate = uniform(random, 1e-9, 1e-6), loss = 0, points = 1e7, updates = 20'000, triangles = 1e6;
        for (int i = 0; i < steps; ++i) {
            rates.push_back(rate_step(rate, std::llround(points), std::llround(updates), loss));
            rates.back().work[WorkKind::triangle] = std::llround(triangles);
            rate *= random() % 6 == 0 ? 1.002 : uniform(random, 1.1, 2);
            loss += random() % 4 == 0 ? 0 : uniform(random, 0, 0.02);
            points *= uniform(random, 0.5, 1.05);
            updates *= uniform(random, 0.7, 1);
            triangles *= random() % 8 == 0 ? 0 : uniform(random, 0.4, 1);
        }
        prices = {uniform(random, 0, 3), {1e-4, uniform(random, 0, 1e-5), uniform(random, 0, 1e-6), 1e-4}};
    }
    Forecast forecast() const { return {Work{1000}, motion, shapes, rates}; }
};

// A place by the same formulas, from its two ends.
Plan between(const RateStep& a, const RateStep& b, double share) {
    Plan plan;
    for (std::size_t i = 0; i < work_kinds; ++i) {
        const auto from = static_cast<double>(a.work.counts[i]), to = static_cast<double>(b.work.counts[i]);
        plan.counts[i] = to == 0     ? std::expm1((1 - share) * std::log1p(from))
                         : from == 0 ? share * to
                                     : std::exp((1 - share) * std::log(from) + share * std::log(to));
    }
    plan.counts[index_of(WorkKind::person)] = 1000;
    plan.loss = ((1 - share) * a.loss + share * b.loss) / 0.05;
    return plan;
}

bool is_leap(const std::vector<RateStep>& rates, std::size_t at) {
    return rates[at].rate < 1.004 * rates[at - 1].rate;
}

std::vector<Plan> many_places(const std::vector<RateStep>& rates) {
    constexpr int between_two = 500;
    std::vector<Plan> all = {between(rates[0], rates[0], 1)};
    for (std::size_t i = 1; i < rates.size(); ++i)
        for (int k = is_leap(rates, i) ? between_two : 1; k <= between_two; ++k)
            all.push_back(between(rates[i - 1], rates[i], static_cast<double>(k) / between_two));
    return all;
}

bool are_alike(const Plan& a, const Plan& b) {
    return std::ranges::equal(a.counts, b.counts,
                              [](double one, double other) { return std::abs(one - other) <= rounding * other; });
}

double most_ms(const Rates& rates) {
    double most = 0;
    for (const RateStep& step : rates.rates) most = std::max(most, plan_ms(between(step, step, 1), rates.prices));
    return most;
}

TEST(RatePlans, NoStepThatFitsLosesLess) {
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Rates rates(random);
        const Forecast forecast = rates.forecast();
        const RatePlans plans(forecast, test_range);
        const double least_ms = plan_ms(plans.cheapest(rates.prices), rates.prices);
        const double budget_ms = uniform(random, 0.9 * least_ms, 1.1 * most_ms(rates));
        const Plan plan = plans.least_loss(rates.prices, budget_ms);
        const double ms = plan_ms(plan, rates.prices);
        ASSERT_LE(ms, std::max(budget_ms, least_ms) * (1 + rounding)) << trial;
        for (const RateStep& each : rates.rates) {
            const Plan step = between(each, each, 1);
            const double step_ms = plan_ms(step, rates.prices);
            ASSERT_GE(step_ms, least_ms * (1 - rounding)) << trial;
            if (step_ms > budget_ms) continue;
            ASSERT_LE(plan.loss, step.loss + rounding) << trial;
            ASSERT_TRUE(step.loss != plan.loss || ms <= step_ms * (1 + rounding)) << trial << ", of equal losses";
        }
    }
}

// Where time falls along the list, as work does by what is believed of prices.
TEST(RatePlans, NoPlaceBetweenStepsThatFitsLosesLess) {
    std::mt19937_64 random(2);
    int between_steps = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Rates rates(random);
        for (std::size_t i = 1; i < rates.rates.size(); ++i) {
            std::int64_t& points = rates.rates[i].work[WorkKind::point];
            points = std::min(points, rates.rates[i - 1].work[WorkKind::point]);
        }
        const Forecast forecast = rates.forecast();
        const RatePlans plans(forecast, test_range);
        const double least_ms = plan_ms(plans.cheapest(rates.prices), rates.prices);
        const double budget_ms = uniform(random, least_ms, 1.1 * most_ms(rates));
        const Plan plan = plans.least_loss(rates.prices, budget_ms);
        const bool is_step = std::ranges::any_of(
            rates.rates, [&](const RateStep& step) { return std::abs(step.loss / 0.05 - plan.loss) < rounding; });
        between_steps += is_step ? 0 : 1;
        for (const Plan& place : many_places(rates.rates)) {
            if (plan_ms(place, rates.prices) > budget_ms * (1 - unused)) continue;
            ASSERT_LE(plan.loss, place.loss + rounding) << trial;
        }
    }
    EXPECT_GT(between_steps, 50);
}

// What is drawn changes at once there: a rate in a leap comes to what is drawn below it, and no time is filled by one.
TEST(RatePlans, NothingIsInsideALeap) {
    std::mt19937_64 random(7);
    int leaps = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Rates rates(random);
        const Forecast forecast = rates.forecast();
        const RatePlans plans(forecast, test_range);
        for (std::size_t i = 1; i < rates.rates.size(); ++i) {
            if (!is_leap(rates.rates, i)) continue;
            ++leaps;
            const RateStep &below = rates.rates[i - 1], &above = rates.rates[i];
            Decision inside;
            inside.rate = std::lerp(below.rate, above.rate, uniform(random, 0, 0.99));
            EXPECT_TRUE(are_alike(plans.at(inside), between(below, below, 1)));
            inside.rate = above.rate;
            EXPECT_TRUE(are_alike(plans.at(inside), between(above, above, 1)));
            const double low_ms = plan_ms(between(above, above, 1), rates.prices);
            const double high_ms = plan_ms(between(below, below, 1), rates.prices);
            if (!(low_ms < high_ms)) continue;
            const double rate = plans.least_loss(rates.prices, std::lerp(low_ms, high_ms, 0.5)).rate;
            EXPECT_FALSE(rate > below.rate * (1 + rounding) && rate < above.rate * (1 - rounding)) << trial;
        }
    }
    EXPECT_GT(leaps, 300);
}

TEST(RatePlans, MoreTimeNeverLosesMore) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const Rates rates(random);
        const Forecast forecast = rates.forecast();
        const RatePlans plans(forecast, test_range);
        const double least_ms = plan_ms(plans.cheapest(rates.prices), rates.prices);
        double before = std::numeric_limits<double>::infinity();
        for (double budget_ms = least_ms; budget_ms < 1.2 * most_ms(rates); budget_ms *= 1.03) {
            const double loss = plans.least_loss(rates.prices, budget_ms).loss;
            ASSERT_LE(loss, before + rounding) << trial << " at " << budget_ms << " ms";
            before = loss;
        }
        ASSERT_EQ(plans.least_loss(rates.prices, 2 * most_ms(rates)).loss, 0);
    }
}

// A FLIP of a twentieth is where loss begins to weigh as much as time.
TEST(RatePlans, OfStepsThatFitNoneHasCheaperDetailThanTheWorthwhile) {
    std::mt19937_64 random(4);
    int coarser = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Rates rates(random);
        const Forecast forecast = rates.forecast();
        const RatePlans plans(forecast, test_range);
        const double least_ms = plan_ms(plans.cheapest(rates.prices), rates.prices);
        const double budget_ms = uniform(random, least_ms, 3 * least_ms);
        const Plan plan = plans.worthwhile(rates.prices, budget_ms);
        const double ms = plan_ms(plan, rates.prices);
        ASSERT_LE(ms, budget_ms * (1 + rounding)) << trial;
        coarser += plan.loss > plans.least_loss(rates.prices, budget_ms).loss ? 1 : 0;
        for (const RateStep& step : rates.rates) {
            const double step_ms = plan_ms(between(step, step, 1), rates.prices);
            if (step_ms > budget_ms) continue;
            ASSERT_LE(ms * (0.05 + 0.05 * plan.loss), step_ms * (0.05 + step.loss) * (1 + rounding)) << trial;
        }
    }
    EXPECT_GT(coarser, 100);
}

TEST(RatePlans, ADecisionComesToThePlanItWasMadeOf) {
    std::mt19937_64 random(5);
    for (int trial = 0; trial < 500; ++trial) {
        const Rates rates(random);
        const Forecast forecast = rates.forecast();
        const RatePlans plans(forecast, test_range);
        const Plan plan = plans.least_loss(rates.prices, uniform(random, 0, 1.1 * most_ms(rates)));
        const Decision decision = plans.decision_of(plan);
        EXPECT_EQ(decision.rate, plan.rate);
        const Plan again = plans.at(decision);
        ASSERT_NEAR(again.loss, plan.loss, rounding);
        for (std::size_t i = 0; i < work_kinds; ++i)
            ASSERT_NEAR(again.counts[i], plan.counts[i], 1e-6 * plan.counts[i] + rounding) << trial;
        EXPECT_EQ(plans.renewed(decision).rate, decision.rate) << "to the bit";
    }
}

// Decided by D and S, what a place comes to in them comes to that place.
TEST(RatePlans, ADecisionByDistanceAndSizeLosesWhatTheRateOfAsManyPixelsLoses) {
    const std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), 9, 0),
                                      motion_step(100, 5, 0.25)};
    const std::vector<Step> shapes = {shape_step(0, 9, 0, 0), shape_step(1, 0, 8, 0.5), shape_step(2, 0, 4, 1)};
    std::vector<RateStep> rates = {rate_step(1, 0, 9, 0), rate_step(2, 0, 5, 0.01), rate_step(4, 8, 5, 0.02),
                                   rate_step(8, 4, 5, 0.06)};
    const double sizes[] = {0, 0, 1, 2};
    for (std::size_t i = 0; i < rates.size(); ++i) {
        rates[i].state = i == 0 ? State::original : i == 1 ? State::slowed : State::points;
        rates[i].motion_distance = i == 0 ? std::numeric_limits<double>::infinity() : 100;
        rates[i].splat_size = sizes[i];
    }
    const Forecast forecast{{}, motion, shapes, rates};
    const RatePlans plans(forecast, test_range);
    const auto loss = [&](const Decision& decision) { return 0.05 * plans.at(decision).loss; };
    EXPECT_EQ(loss({}), 0);
    EXPECT_NEAR(loss({State::slowed, 100, 0}), 0.01, rounding);
    EXPECT_NEAR(loss({State::points, 100, 1}), 0.02, rounding);
    EXPECT_NEAR(loss({State::points, test_range, 1}), 0.015, rounding) << "half a pixel lies between 1/4 and 3/4";
    EXPECT_NEAR(loss({State::points, 100, 2}), 0.06, rounding);
    EXPECT_NEAR(loss({State::points, 1, 32}), 0.06, rounding) << "the end of the list";
    EXPECT_EQ(plans.renewed({State::points, 100, 2}), (Decision{State::points, 100, 2, 8}));
    EXPECT_EQ(PairPlans(forecast, test_range).renewed({State::points, 100, 2, 8}), (Decision{State::points, 100, 2}));
}

TEST(RatePlans, DistanceAndSizeStayInTheirRanges) {
    std::vector<RateStep> rates = {rate_step(1, 0, 9, 0), rate_step(2, 5, 8, 0.01), rate_step(4, 4, 7, 0.02),
                                   rate_step(8, 0, 6, 0.03)};
    rates[0].state = State::original;
    rates[0].motion_distance = std::numeric_limits<double>::infinity();
    rates[0].splat_size = 0;
    rates[1].motion_distance = std::numeric_limits<double>::infinity();
    rates[2].motion_distance = 1e4, rates[2].splat_size = 99;
    rates[3].splat_size = 0;  // nobody is drawn by points, nor by a mesh
    const std::vector<Step> motion = {motion_step(test_range, 9, 0)}, shapes = {shape_step(0, 9, 0, 0)};
    const Forecast forecast{{}, motion, shapes, rates};
    const RatePlans plans(forecast, test_range);
    const auto decided = [&](double rate) {
        Decision decision;
        decision.rate = rate;
        return plans.renewed(decision);
    };
    EXPECT_EQ(decided(1), (Decision{State::original, std::numeric_limits<double>::infinity(), 0, 1}));
    EXPECT_EQ(decided(2), (Decision{State::points, test_range, 1, 2})) << "everybody moves";
    EXPECT_EQ(decided(4), (Decision{State::points, test_range, max_splat_size, 4}));
    EXPECT_EQ(decided(8), (Decision{State::points, 100, max_splat_size, 8}));
    EXPECT_EQ(decided(1.5), (Decision{State::points, test_range, 1, 1.5})) << "between two it is the coarser's state";
}

}  // namespace
// However much of a small loss is saved, hardly any of the picture's detail is.
TEST(RatePlans, ALossThatIsHardlySeenIsNotWorthAChange) {
    constexpr double tenth = 0.1;
    const Forecast none;
    const RatePlans plans(none, 100);
    const auto losing = [](double flip) {
        Plan plan;
        plan.loss = flip / flip_of_a_pixel;
        return plan;
    };
    EXPECT_FALSE(plans.is_better(losing(0), losing(0.004), tenth));
    EXPECT_TRUE(plans.is_better(losing(0), losing(0.007), tenth));
    EXPECT_FALSE(plans.is_better(losing(0.1), losing(0.11), tenth));
    EXPECT_TRUE(plans.is_better(losing(0.1), losing(0.12), tenth));
    EXPECT_FALSE(plans.is_better(losing(0.12), losing(0.1), tenth));
}

}  // namespace sfsm
