// What simulated renderers cost, what they tell beforehand, and that no decision is better than their optimum.
#include <gtest/gtest.h>

#include <cmath>

#include "sfsm/detail.h"
#include "sfsm/simulate/knob_plant.h"
#include "sfsm/simulate/scenario.h"
#include "sfsm/simulate/work_plant.h"

namespace sfsm::simulate {
namespace {

constexpr double nominal_ms = 1000.0 / 60;
constexpr double rounding = 1e-9;  // relative, of a few operations and 40 bisections

KnobPlant knob_plant(double load, KnobCurve curve = toy_curve, double cpu_ms = 0) {
    KnobModel model;
    model.curve = curve;
    model.load = [=](std::int64_t) { return load; };
    model.cpu_ms = [=](std::int64_t) { return cpu_ms; };
    return KnobPlant(model);
}

constexpr View some_view{.people = 20000,
                         .range = 250,
                         .farness = 3,
                         .theta = 0.1,
                         .triangles_each = 1000,
                         .points_each = 500,
                         .surface_px = 0.1};
constexpr Prices some_prices{2, {1e-4, 1e-6, 1e-6, 5e-4}};

WorkPlant work_plant(double load = 1) {
    return WorkPlant(some_prices, {some_view}, [](std::int64_t) { return std::size_t{0}; },
                     {.load = [=](std::int64_t) { return load; }});
}

TEST(KnobPlant, CostsWhatTheToyCheckSays) {
    const KnobPlant plant = knob_plant(1.6);
    for (const double u : {0.05, 0.2, 0.5, 0.8}) {
        const Decision decision = decision_at(u, plant.range(0));
        EXPECT_NEAR(plant.cost_ms(0, decision), 1.6 * (0.3 + 1.2 * u) * nominal_ms, rounding * nominal_ms);
    }
    EXPECT_NEAR(plant.cost_ms(0, decision_at(0, plant.range(0))), 1.6 * 0.36 * nominal_ms, rounding * nominal_ms)
        << "the knob ends at 0.05";
}

TEST(KnobPlant, ItsOptimumIsTheToyChecksClosedForm) {
    for (const double load : {1.0, 1.3, 1.6}) {
        const KnobPlant plant = knob_plant(load);
        const double u = (1 / load - 0.3) / 1.2;
        EXPECT_NEAR(plant.detail(0, plant.optimum(0, nominal_ms)), u, 1e-9);
    }
}

TEST(KnobPlant, NothingFinerMeetsTheLimitWhateverTheCurve) {
    for (const KnobCurve curve : {toy_curve, wavy_curve, stepped_curve}) {
        const KnobPlant plant = knob_plant(1.1, curve);
        const Decision best = plant.optimum(0, nominal_ms);
        EXPECT_LE(plant.cost_ms(0, best), (1 + rounding) * nominal_ms);
        const double least_gain = 1e-3;  // the search looks at a thousand steps
        for (double u = plant.detail(0, best) + least_gain; u < 1; u += least_gain) {
            EXPECT_GT(plant.cost_ms(0, decision_at(u, plant.range(0))), nominal_ms) << u;
        }
    }
}

TEST(KnobPlant, TakesNoDetailForATimeThatDetailHasNoPowerOver) {
    const double cpu_ms = 1.3 * nominal_ms;
    const KnobPlant plant = knob_plant(1, toy_curve, cpu_ms);
    const Decision best = plant.optimum(0, nominal_ms);
    EXPECT_NEAR(plant.cost_ms(0, best), cpu_ms, rounding * cpu_ms);
    EXPECT_NEAR(plant.detail(0, best), (1.3 - 0.3) / 1.2, 1e-9);
}

TEST(KnobPlant, GivesAllDetailAwayForALimitOutOfReach) {
    const KnobPlant plant = knob_plant(4);
    EXPECT_NEAR(plant.detail(0, plant.optimum(0, nominal_ms)), least_knob, 1e-9);
}

TEST(WavyCurve, FallsSomewhereAndRisesInAll) {
    int falls = 0;
    for (double u = 0.05; u < 0.99; u += 0.01) falls += wavy_curve(u + 0.01) < wavy_curve(u) ? 1 : 0;
    EXPECT_GT(falls, 10);
    EXPECT_GT(wavy_curve(1), wavy_curve(least_knob) + 1);
}

TEST(WorkPlant, CostsPricesTimesWork) {
    const WorkPlant plant = work_plant(1.5);
    for (const Decision& decision : {Decision{}, Decision{State::slowed, 200, 0}, Decision{State::points, 100, 4}}) {
        const Work work = plant.work(0, decision);
        const double ms = some_prices.frame +
                          some_prices[WorkKind::person] * static_cast<double>(work[WorkKind::person]) +
                          some_prices[WorkKind::triangle] * static_cast<double>(work[WorkKind::triangle]) +
                          some_prices[WorkKind::point] * static_cast<double>(work[WorkKind::point]) +
                          some_prices[WorkKind::motion_update] * static_cast<double>(work[WorkKind::motion_update]);
        EXPECT_NEAR(plant.cost_ms(0, decision), 1.5 * ms, rounding * ms);
    }
}

TEST(WorkPlant, WhoMovesInEveryFrameLosesNothing) {
    View view;
    view.theta = 0;  // no rate falls with distance
    const WorkPlant plant(some_prices, {view}, [](std::int64_t) { return std::size_t{0}; });
    for (const double share : {0.9, 0.5, 0.1})
        EXPECT_EQ(plant.detail(0, {State::slowed, share * view.range, 0}), 1) << share;
}

TEST(WorkPlant, ForecastsTheWorkOfEveryPairOfSteps) {
    const WorkPlant plant = work_plant();
    const Forecast& forecast = *plant.forecast(0);
    for (const Step& motion : forecast.motion) {
        for (const Step& splat : forecast.shapes) {
            Decision decision{splat.setting > 0 ? State::points : State::slowed, motion.setting, splat.setting};
            const Work work = plant.work(0, decision);
            EXPECT_EQ(only_on<WorkAxis::frame>(work), forecast.frame);
            EXPECT_EQ(work[WorkKind::motion_update], motion.work[WorkKind::motion_update]);
            EXPECT_EQ(work[WorkKind::triangle], splat.work[WorkKind::triangle]);
            EXPECT_EQ(work[WorkKind::point], splat.work[WorkKind::point]);
            EXPECT_NEAR(plant.detail(0, decision), 1 / (1 + motion.loss_px + splat.loss_px), rounding);
        }
    }
}

TEST(WorkPlant, ForecastsRunFromNoLossToTheMost) {
    for (const std::string_view name : scenario_names()) {
        const Scenario scenario = make_scenario(name);
        for (std::int64_t frame = 0; frame < scenario.frames; frame += 7) {
            const Forecast* forecast = scenario.plant->forecast(frame);
            if (!forecast) continue;
            ASSERT_GE(forecast->motion.size(), 2u);
            ASSERT_GE(forecast->shapes.size(), 2u);
            EXPECT_EQ(forecast->motion.front().loss_px, 0);
            EXPECT_EQ(forecast->motion.front().work[WorkKind::motion_update], forecast->frame[WorkKind::person]);
            EXPECT_EQ(forecast->shapes.front().loss_px, 0);
            EXPECT_EQ(forecast->shapes.front().work[WorkKind::point], 0);
            for (std::size_t i = 1; i < forecast->motion.size(); ++i) {
                const Step &finer = forecast->motion[i - 1], &coarser = forecast->motion[i];
                EXPECT_LT(coarser.setting, finer.setting);
                EXPECT_LE(coarser.work[WorkKind::motion_update], finer.work[WorkKind::motion_update]);
                EXPECT_GE(coarser.loss_px, finer.loss_px);
            }
            for (std::size_t i = 1; i < forecast->shapes.size(); ++i) {
                const Step &finer = forecast->shapes[i - 1], &coarser = forecast->shapes[i];
                EXPECT_GT(coarser.setting, finer.setting);
                EXPECT_LE(coarser.work[WorkKind::triangle], finer.work[WorkKind::triangle]);
                EXPECT_GE(coarser.loss_px, finer.loss_px);
                if (i == 1) continue;  // from triangles to points
                EXPECT_LE(coarser.work[WorkKind::point], finer.work[WorkKind::point]);
            }
        }
    }
}

TEST(WorkPlant, NoDecisionOfAGridBetterThanItsOptimumMeetsTheLimit) {
    const WorkPlant plant = work_plant();
    const double most_ms = plant.cost_ms(0, {});
    // The search tries a hundred distances, the grid lies between them.
    constexpr double least_gain = 2e-3;
    for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
        const double limit_ms = share * most_ms;
        const Decision best = plant.optimum(0, limit_ms);
        // Counts of work are whole numbers.
        EXPECT_LE(plant.cost_ms(0, best), (1 + 1e-6) * limit_ms);
        for (int i = 1; i <= 150; ++i) {
            const double distance = some_view.range * i / 150;
            const auto expect_no_better = [&](const Decision& decision) {
                if (plant.cost_ms(0, decision) > limit_ms) return;
                EXPECT_LE(plant.detail(0, decision), plant.detail(0, best) + least_gain);
            };
            expect_no_better({State::slowed, distance, 0});
            for (int j = 0; j <= 80; ++j) expect_no_better({State::points, distance, 0.2 * std::exp2(j / 11.0)});
        }
    }
}

TEST(WorkPlant, DrawsAllWhereAllFits) {
    const WorkPlant plant = work_plant();
    EXPECT_EQ(plant.optimum(0, plant.cost_ms(0, {})), Decision{});
}

TEST(WorkPlant, AViewHalfWayIsHalfWay) {
    View other = some_view;
    other.people = 30000;
    other.range = 350;
    const View half = between(some_view, other, 0.5);
    EXPECT_DOUBLE_EQ(half.people, 25000);
    EXPECT_DOUBLE_EQ(half.range, 300);
    EXPECT_DOUBLE_EQ(half.farness, some_view.farness);
}

TEST(WorkPlant, AForecastIsOffByTheForesightAndTheWorkIsNot) {
    View misjudged = some_view;
    misjudged.foresight = {.person = 1.5, .triangle = 2, .point = 0.5, .update = 3};
    const auto first = [](std::int64_t) { return std::size_t{0}; };
    const WorkPlant honest(some_prices, {some_view}, first), off(some_prices, {misjudged}, first);
    const Forecast &told = *honest.forecast(0), &mistold = *off.forecast(0);
    const auto ratio = [](const Work& a, const Work& b, WorkKind kind) {
        return static_cast<double>(a[kind]) / static_cast<double>(b[kind]);
    };
    constexpr double whole_counts = 1e-3;
    EXPECT_NEAR(ratio(mistold.frame, told.frame, WorkKind::person), 1.5, whole_counts);
    EXPECT_NEAR(ratio(mistold.shapes[0].work, told.shapes[0].work, WorkKind::triangle), 2, whole_counts);
    EXPECT_NEAR(ratio(mistold.shapes[9].work, told.shapes[9].work, WorkKind::point), 0.5, whole_counts);
    EXPECT_NEAR(ratio(mistold.motion[5].work, told.motion[5].work, WorkKind::motion_update), 3, whole_counts);
    for (const Decision& decision : {Decision{}, Decision{State::points, 100, 4}}) {
        EXPECT_EQ(off.work(0, decision), honest.work(0, decision));
        EXPECT_EQ(off.cost_ms(0, decision), honest.cost_ms(0, decision));
    }
}

TEST(WorkPlant, ASilentOneCountsWorkButForecastsNothing) {
    const WorkPlant plant(some_prices, {some_view}, [](std::int64_t) { return std::size_t{0}; }, {.is_silent = true});
    EXPECT_EQ(plant.forecast(0), nullptr);
    EXPECT_GT(plant.work(0, {})[WorkKind::triangle], 0);
}

TEST(WorkPlant, AnUnpricedCostComesOnTopAndTheOptimumKnowsIt) {
    const WorkPlant plain = work_plant(2);
    const WorkPlant plant(some_prices, {some_view}, [](std::int64_t) { return std::size_t{0}; },
                          {.load = [](std::int64_t) { return 2.0; }, .unpriced_ms = [](std::int64_t) { return 5.0; }});
    EXPECT_DOUBLE_EQ(plant.cost_ms(0, {}), plain.cost_ms(0, {}) + 5);
    EXPECT_EQ(plant.optimum(0, 25), plain.optimum(0, 20));
}

}  // namespace
}  // namespace sfsm::simulate
