// The closed loop of the default law where the renderer knows rates.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "sfsm/pair_plans.h"
#include "sfsm/predictive.h"
#include "sfsm/rate_plans.h"
#include "tests/sfsm/normal.h"
#include "tests/sfsm/rate_scene.h"
#include "tests/sfsm/simulation.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

constexpr double target_ms = 1000.0 / 60;
constexpr int most_delay = 4;

struct RateLoop {
    std::function<const RateScene&(std::int64_t frame)> scene;
    Target target = constant(target_ms);
    std::int64_t frames = 600;
    int delay = 2;
    double noise = 0.01;
    std::uint64_t seed = 1;
    bool has_rates = true;  // else the same crowd by D and S
};

Work work_of(const RateScene& scene, const Decision& decision) {
    if (decision.rate > 0) return scene.work(decision);
    const Plan plan = PairPlans(scene.forecast, test_range).at(decision);
    Work work;
    for (std::size_t i = 0; i < work_kinds; ++i) work.counts[i] = std::llround(plan.counts[i]);
    return work;
}

std::vector<TraceRow> run(Controller& law, const RateLoop& loop) {
    std::mt19937_64 random(loop.seed);
    return run_frames(law, loop.frames, loop.delay, loop.target, test_range, [&](TraceRow& row) {
        const RateScene& scene = loop.scene(row.frame);
        Forecast forecast = scene.forecast;
        if (!loop.has_rates) forecast.rates = {};
        row.decision = law.decide({row.target_ms, test_range, &forecast});
        row.work = work_of(scene, row.decision);
        row.frame_ms = scene.ms(row.work) * std::exp(loop.noise * normal(random));
    });
}

RateLoop always(const RateScene& scene) {
    return {[&scene](std::int64_t) -> const RateScene& { return scene; }};
}

int changes(const std::vector<TraceRow>& rows, std::size_t from) {
    int count = 0;
    for (std::size_t i = from + 1; i < rows.size(); ++i) count += rows[i].decision != rows[i - 1].decision ? 1 : 0;
    return count;
}

TEST(RateLaw, MeetsTheTargetWithinAFewTimesWhateverPricesAre) {
    constexpr double lowest_aim = 0.91;  // where the first surprises are taken for a heavy tail
    constexpr std::int64_t settled = 100;
    constexpr int few = 6;  // answers: each takes delay + 1 frames, and the first two are waited for
    constexpr int trials = 100;
    double met = 0;  // trials, after the few
    std::mt19937_64 random(1);
    for (int trial = 0; trial < trials; ++trial) {
        Prices prices = desktop_prices;
        for (double& ms : prices.each) ms *= std::exp(uniform(random, -1, 1));
        const RateScene scene = bowl(20'000, prices);
        const double least_ms = scene.ms(scene.rates.back()), most_ms = scene.ms(scene.rates.front());
        const double target = least_ms + uniform(random, 0.1, 0.9) * (most_ms - least_ms);
        RateLoop loop = always(scene);
        loop.target = constant(target);
        loop.delay = trial % (most_delay + 1);
        loop.noise = 0;
        PredictiveLaw law(PredictiveOptions{}, trial % 2 ? Drawing::native : Drawing::opengl);
        const auto rows = run(law, loop);
        int fast = 0;
        for (const TraceRow& row : rows) {
            ASSERT_GT(row.decision.rate, 0);
            const double share = row.frame_ms / target;
            const auto since = static_cast<double>(row.frame - 1) / (loop.delay + 1);
            if (since >= few && since < few + 1) met += share > lowest_aim && share < 1.05 ? 1.0 / (loop.delay + 1) : 0;
            if (row.frame < settled) continue;
            ASSERT_LT(share, 1.05) << "trial " << trial << " frame " << row.frame;
            fast += share < lowest_aim ? 1 : 0;
        }
        EXPECT_LE(fast, PredictiveOptions{}.probes) << "trial " << trial;
    }
    EXPECT_GT(met, 0.9 * trials);
}

TEST(RateLaw, LosesLittleMoreThanTheLeastThatCanBeLostInItsTime) {
    constexpr double octave = 0.03;  // between steps of an octave
    const RateScene scene = bowl();
    for (const double target : {8.0, 10.0, 14.0, 18.0}) {
        RateLoop loop = always(scene);
        loop.target = constant(target);
        loop.noise = 0;
        PredictiveLaw law;
        const TraceRow row = run(law, loop).back();
        EXPECT_NEAR(row.frame_ms, target, 0.02 * target);
        EXPECT_LE(scene.at(row.decision.rate).loss, (1 + octave) * scene.least_loss(row.frame_ms)) << target;
    }
}

TEST(RateLaw, ACutIsInBandOnItsFirstFrame) {
    const RateScene views[] = {bowl(20'000), bowl(12'000), bowl(33'000)};
    for (int delay = 0; delay <= most_delay; ++delay) {
        RateLoop loop{[&](std::int64_t frame) -> const RateScene& { return views[frame / 200 % 3]; }};
        loop.frames = 1200;
        loop.delay = delay;
        PredictiveLaw law;
        const auto rows = run(law, loop);
        for (std::size_t i = 600; i < rows.size(); ++i)
            ASSERT_NEAR(rows[i].frame_ms, target_ms, 0.1 * target_ms) << "delay " << delay << " frame " << i;
    }
}

TEST(RateLaw, HoldsStillUnderNoiseAboutAsLongAsByDistanceAndSize) {
    const RateScene scene = bowl();
    int by_rate = 0, by_pairs = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        RateLoop loop = always(scene);
        loop.frames = 1200;
        loop.noise = 0.02;
        loop.seed = seed;
        PredictiveLaw law, other;
        by_rate += changes(run(law, loop), 200);
        loop.has_rates = false;
        by_pairs += changes(run(other, loop), 200);
    }
    EXPECT_LE(by_rate, 1.5 * by_pairs);
    EXPECT_LE(by_rate, 20 * 2) << "in 1000 frames";
    RateLoop quiet = always(scene);
    quiet.noise = 0;
    PredictiveLaw law;
    EXPECT_EQ(changes(run(law, quiet), 200), 0);
}

TEST(RateLaw, OutOfReachTheWorthwhileStepIsDrawn) {
    const RateScene scene = bowl();
    const double least_ms = scene.ms(scene.rates.back());
    for (const double share : {0.3, 0.6, 0.8}) {
        const double target = share * least_ms, budget_ms = least_ms + 0.25 * (least_ms - target);
        RateLoop loop = always(scene);
        loop.target = constant(target);
        loop.noise = 0;
        PredictiveLaw law;
        const TraceRow row = run(law, loop).back();
        double best = std::numeric_limits<double>::infinity();
        for (const RateStep& step : scene.rates) {
            const double ms = scene.ms(step);
            if (ms <= budget_ms) best = std::min(best, ms * (0.05 + step.loss));
        }
        EXPECT_LE(row.frame_ms, 1.03 * budget_ms);
        EXPECT_LE(row.frame_ms * (0.05 + scene.at(row.decision.rate).loss), 1.03 * best) << share;
    }
}

// A renderer may stop knowing rates, and begin.
TEST(RateLaw, RatesThatComeAndGoAreAnsweredInTheirFrame) {
    const RateScene scene = bowl();
    PredictiveLaw law;
    std::mt19937_64 random(1);
    Forecast without = scene.forecast;
    without.rates = {};
    for (std::int64_t frame = 0; frame < 600; ++frame) {
        const bool has_rates = frame / 100 % 2 == 1;
        const Decision decision = law.decide({target_ms, test_range, has_rates ? &scene.forecast : &without});
        ASSERT_TRUE(frame < 3 || (decision.rate > 0) == has_rates) << frame;
        const Work work = work_of(scene, decision);
        const double ms = scene.ms(work) * std::exp(0.005 * normal(random));
        ASSERT_NEAR(ms, target_ms, frame > 200 ? 0.1 * target_ms : 1e3) << frame;
        law.observe({frame, ms, decision, work});
    }
}

// D and S tell what a rate comes to in the view that it is drawn in.
TEST(RateLaw, DistanceAndSizeFollowTheView) {
    const RateScene near = bowl(20'000), same = bowl(20'000);
    RateScene other = bowl(20'000);
    for (RateStep& step : other.rates) step.splat_size *= 0.5;
    other.forecast = {other.forecast.frame, other.motion, other.shapes, other.rates};
    RateLoop loop{[&](std::int64_t frame) -> const RateScene& { return frame < 300 ? near : other; }};
    loop.frames = 301;
    loop.noise = 0;
    PredictiveLaw law;
    const auto rows = run(law, loop);
    EXPECT_EQ(rows[300].decision.rate, rows[299].decision.rate);
    EXPECT_NEAR(rows[300].decision.splat_size, 0.5 * rows[299].decision.splat_size, 1e-9);
}

TEST(RateLaw, ProbesAreFewAndOfPoints) {
    const RateScene scene = bowl(1500);  // all of it fits
    RateLoop loop = always(scene);
    PredictiveLaw law;
    const auto rows = run(law, loop);
    std::vector<double> rates;
    for (const TraceRow& row : rows) {
        if (row.frame < 12 || row.decision.state == State::original) continue;
        EXPECT_GT(row.work[WorkKind::point], 0) << row.frame;
        rates.push_back(row.decision.rate);
    }
    ASSERT_EQ(rates.size(), 2u);
    EXPECT_NEAR(rates[1], 4 * rates[0], 1e-9 * rates[1]);
    EXPECT_EQ(rows.back().decision.state, State::original);
}

// --- Anything at all.

double any_number(std::mt19937_64& random) {
    constexpr double odd[] = {0,
                              -1,
                              1e30,
                              -1e30,
                              5e-324,
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()};
    const std::uint64_t pick = random() % 16;
    return pick < std::size(odd) ? odd[pick] : uniform(random, 0, 100);
}

std::vector<RateStep> damaged(std::vector<RateStep> rates, std::mt19937_64& random) {
    rates.resize(1 + random() % rates.size());
    for (std::uint64_t blow = random() % 40; blow > 0; --blow) {
        RateStep& step = rates[random() % rates.size()];
        double* const numbers[] = {&step.rate, &step.motion_distance, &step.splat_size, &step.loss};
        switch (random() % 4) {
            case 0:
                step.state = static_cast<State>(random() % 3);
                break;
            case 1:
                step.work.counts[random() % work_kinds] = static_cast<std::int64_t>(random());
                break;
            case 2:
                std::swap(step, rates[random() % rates.size()]);
                break;
            default:
                *numbers[random() % 4] = any_number(random);
        }
    }
    return rates;
}

TEST(RateLaw, NoDamagedForecastMakesADecisionLeaveItsRange) {
    const RateScene scene = bowl();
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        std::mt19937_64 random(seed);
        PredictiveLaw law;
        for (std::int64_t frame = 0; frame < 200; ++frame) {
            const std::vector<RateStep> rates = damaged(scene.rates, random);
            const Forecast forecast{scene.forecast.frame, scene.motion, scene.shapes, rates};
            const Decision d = law.decide({target_ms, test_range, random() % 8 ? &forecast : nullptr});
            ASSERT_TRUE(d.rate >= 0 && std::isfinite(d.rate)) << "seed " << seed << " frame " << frame;
            ASSERT_GT(d.motion_distance, 0);
            ASSERT_TRUE(d.state == State::original ? std::isinf(d.motion_distance) : d.motion_distance <= test_range);
            ASSERT_TRUE(d.splat_size >= 0 && d.splat_size <= max_splat_size);
            ASSERT_EQ(d.splat_size > 0, d.state == State::points);
            law.observe({frame, uniform(random, 1, 60), d, scene.work({State::points, 1, 1, uniform(random)})});
        }
    }
}

TEST(RateLaw, TheSameCallsGiveTheSameBits) {
    const RateScene scene = bowl();
    const auto bits = [&] {
        PredictiveLaw law;
        std::vector<std::uint64_t> all;
        for (const TraceRow& row : run(law, always(scene)))
            for (const double number : {row.decision.rate, row.decision.motion_distance, row.decision.splat_size})
                all.push_back(std::bit_cast<std::uint64_t>(number));
        return all;
    };
    EXPECT_EQ(bits(), bits());
}

}  // namespace
}  // namespace sfsm
