// Which time is aimed at, after frames of known noise.
#include "sfsm/aim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr double target_ms = 10;
constexpr double rounding = 1e-9;

// A model of frames that take 8 ms, give or take normal noise; `late_share` of them up to `latest` longer.
CostModel model_of(double noise, double late_share = 0, double latest = 0) {
    CostModel model({1, {1}, 0, {}});
    std::mt19937_64 random(1);
    for (int i = 0; i < 2000; ++i) {
        const double normal = std::sqrt(-2 * std::log(1 - uniform(random))) * std::cos(6.283185307 * uniform(random));
        const double on_top = uniform(random) < late_share ? uniform(random, 0.05, latest) : 0;
        model.observe({{1}, 1}, 8 * (std::exp(noise * normal) + on_top));
    }
    return model;
}

double aim_of(const CostModel& model) {
    Aim aim;
    aim.target_ms = target_ms;
    return aim.aim_ms(model, 0, 0);
}

TEST(Aim, OfNormalNoiseIsAQuarterSigmaBelowTheTarget) {
    for (const double noise : {0.001, 0.005, 0.01, 0.02}) {
        const CostModel model = model_of(noise);
        EXPECT_NEAR(aim_of(model), target_ms * (1 - 0.25 * model.noise()), rounding) << noise;
    }
}

TEST(Aim, LeavesAHeavyTailThreePercentOfFramesOverTheLimit) {
    const CostModel model = model_of(0.02, 0.06, 0.15);
    EXPECT_NEAR(aim_of(model) * std::exp(model.tail()), 1.05 * target_ms, rounding);
    EXPECT_LT(aim_of(model), 0.98 * target_ms);
    EXPECT_GT(aim_of(model), 0.92 * target_ms);
}

TEST(Aim, IsNotLoweredForever) {
    EXPECT_NEAR(aim_of(model_of(0.02, 0.1, 0.29)), 0.92 * target_ms, rounding);
    EXPECT_NEAR(aim_of(model_of(0.2)), 0.92 * target_ms, rounding);
}

}  // namespace
}  // namespace sfsm
