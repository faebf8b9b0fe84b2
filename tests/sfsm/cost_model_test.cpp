#include "sfsm/cost_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sfsm/normal.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr PriceBelief belief{3, {1, 1, 1}, 0};

Amounts amounts(double a, double b, double c) {
    return {{a, b, c}, 3};
}

// A renderer with prices 2, 5 and 0.5, and a gain.
double renderer_ms(const Amounts& work, double gain = 1) {
    return gain * (2 * work.of[0] + 5 * work.of[1] + 0.5 * work.of[2]);
}

Amounts any_work(std::mt19937_64& random) {
    return amounts(1, uniform(random, 0, 4), uniform(random, 0, 4));
}

TEST(CostModel, LearnsPricesFromMixedWork) {
    std::mt19937_64 random(1);
    CostModel model(belief);
    for (int i = 0; i < 400; ++i) {
        const Amounts work = any_work(random);
        model.observe(work, renderer_ms(work) * std::exp(0.03 * normal(random)));
    }
    for (int i = 0; i < 20; ++i) {
        const Amounts work = any_work(random);
        const Prediction prediction = model.predict(work);
        EXPECT_NEAR(prediction.log_ms, std::log(renderer_ms(work)), 0.03);
        EXPECT_LT(prediction.uncertainty, 0.03);
    }
}

TEST(CostModel, KnowsWhatItDoesNotKnow) {
    CostModel model(belief);
    const Amounts seen = amounts(1, 1, 1), unseen = amounts(1, 10, 0);
    for (int i = 0; i < 200; ++i) model.observe(seen, renderer_ms(seen));
    EXPECT_LT(model.predict(seen).uncertainty, 0.01);
    EXPECT_GT(model.predict(unseen).uncertainty, 0.2);
    EXPECT_LT(std::abs(model.predict(unseen).log_ms - std::log(renderer_ms(unseen))),
              3 * model.predict(unseen).uncertainty);
}

TEST(CostModel, WorkThatAlwaysComesTogetherDoesNotBlowUp) {
    std::mt19937_64 random(2);
    CostModel model(belief);
    for (int i = 0; i < 100'000; ++i) {
        const double both = uniform(random, 0.5, 2);
        const Amounts work = amounts(1, both, 2 * both);
        model.observe(work, renderer_ms(work) * std::exp(0.05 * normal(random)));
    }
    for (int term = 0; term < 3; ++term) {
        EXPECT_GE(model.price(term), 0);
        EXPECT_LT(model.price(term), 20);
    }
    const Amounts work = amounts(1, 1, 2);
    EXPECT_NEAR(model.predict(work).log_ms, std::log(renderer_ms(work)), 0.03);
}

TEST(CostModel, PricesAreNeverNegative) {
    std::mt19937_64 random(3);
    CostModel model(belief);
    for (int i = 0; i < 10'000; ++i) {
        model.observe(any_work(random), std::exp(uniform(random, -3, 3)));
        for (int term = 0; term < 3; ++term) ASSERT_GE(model.price(term), 0) << i;
    }
}

TEST(CostModel, AShiftOfEverythingIsTheGainsAndNotThePrices) {
    std::mt19937_64 random(4);
    CostModel model(belief);
    for (int i = 0; i < 300; ++i) {
        const Amounts work = any_work(random);
        model.observe(work, renderer_ms(work) * std::exp(0.02 * normal(random)));
    }
    const double gain_before = model.gain();
    const std::int64_t shifts_before = model.shifts();
    const Amounts still = amounts(1, 2, 1), other = amounts(1, 0.2, 3);
    for (int i = 0; i < 10; ++i) model.observe(still, renderer_ms(still, 2) * std::exp(0.02 * normal(random)));
    EXPECT_EQ(model.shifts(), shifts_before + 1);
    EXPECT_NEAR(model.gain() / gain_before, 2, 0.05);
    EXPECT_NEAR(model.predict(other).log_ms, std::log(renderer_ms(other, 2)), 0.05);
}

TEST(CostModel, OneOutlierLeavesNothing) {
    for (const double ms : {1e-3, 4000.0, 1e30, std::numeric_limits<double>::denorm_min()}) {
        std::mt19937_64 random(5);
        CostModel model(belief);
        const Amounts work = amounts(1, 2, 1);
        for (int i = 0; i < 200; ++i) model.observe(work, renderer_ms(work) * std::exp(0.02 * normal(random)));
        const double before = model.predict(work).log_ms;
        model.observe(work, ms);
        EXPECT_NEAR(model.predict(work).log_ms, before, 0.002) << ms;
        EXPECT_EQ(model.shifts(), 0);
    }
}

TEST(CostModel, OfTwoFirstTimesTheShorterIsBelieved) {
    const Amounts work = amounts(1, 1, 1);
    for (const bool is_hitch_first : {true, false}) {
        CostModel model(belief);
        for (const bool is_hitch : {is_hitch_first, !is_hitch_first})
            model.observe(work, (is_hitch ? 10 : 1) * renderer_ms(work));
        ASSERT_TRUE(model.is_ready());
        EXPECT_LT(model.predict(work).log_ms, std::log(2 * renderer_ms(work))) << is_hitch_first;
    }
}

// A model that has seen the renderer for long, at a gain of 1, and lately without noise.
CostModel experienced(const Amounts& work) {
    CostModel model(belief);
    std::mt19937_64 random(7);
    for (int i = 0; i < 300; ++i) model.observe(work, renderer_ms(work) * std::exp(0.01 * normal(random)));
    for (int i = 0; i < 40; ++i) model.observe(work, renderer_ms(work));
    return model;
}

// Of the same times more than one gain can be believed, and with each its prices.
TEST(CostModel, AfterThousandsOfTimesPricesTakeTheGainOver) {
    constexpr int life = 4096;  // [times] of a gain
    std::mt19937_64 random(6);
    CostModel model(belief);
    for (int i = 1; i < life; ++i) {
        const Amounts work = any_work(random);
        model.observe(work, renderer_ms(work, i < 300 ? 1 : 3) * std::exp(0.02 * normal(random)));
    }
    const Amounts work = amounts(1, 2, 1), other = amounts(1, 0.2, 3);
    ASSERT_NEAR(model.gain(), 3, 0.5);
    const Prediction before = model.predict(other);
    const double price = model.gain() * model.price(1);
    model.observe(work, std::exp(model.predict(work).log_ms));
    EXPECT_NEAR(model.gain(), 1, 1e-3);
    EXPECT_NEAR(model.gain() * model.price(1), price, 1e-3 * price);
    EXPECT_NEAR(model.predict(other).log_ms, before.log_ms, 1e-3);
    EXPECT_NEAR(model.predict(other).uncertainty, before.uncertainty, 0.01 * before.uncertainty);
}

TEST(CostModel, PricesThatProvedWrongAreLearnedAnew) {
    const Amounts work = amounts(1, 2, 1), other = amounts(1, 0, 1);
    CostModel model = experienced(work);
    const double noise = model.noise();
    model.relearn(work, 3);
    EXPECT_NEAR(model.predict(work).log_ms, std::log(3), 1e-9);
    EXPECT_NEAR(model.predict(other).log_ms, std::log(1.5), 1e-9) << "prices are equal, as at first";
    EXPECT_GT(model.predict(other).uncertainty, 0.2);
    EXPECT_EQ(model.noise(), noise);
    EXPECT_TRUE(model.is_ready());
}

TEST(CostModel, TwoOutliersThatDisagreeAreNoShift) {
    const Amounts work = amounts(1, 2, 1);
    CostModel apart = experienced(work), alike = apart;
    for (const double gain : {1.5, 3.0}) apart.observe(work, renderer_ms(work, gain));
    for (const double gain : {2.0, 2.02}) alike.observe(work, renderer_ms(work, gain));
    EXPECT_EQ(apart.shifts(), 0);
    EXPECT_NEAR(apart.predict(work).log_ms, std::log(renderer_ms(work)), 0.05);
    EXPECT_EQ(alike.shifts(), 1);
}

TEST(CostModel, ALevelTwentyfoldOffIsBelievedAtItsEighthTime) {
    const Amounts work = amounts(1, 2, 1);
    for (const double gain : {40.0, 1 / 40.0}) {
        CostModel model = experienced(work);
        const double before = model.predict(work).log_ms;
        for (int i = 1; i < 8; ++i) {
            model.observe(work, renderer_ms(work, gain));
            ASSERT_EQ(model.predict(work).log_ms, before) << i;
        }
        for (int i = 0; i < 8; ++i) model.observe(work, renderer_ms(work, gain));
        EXPECT_NEAR(model.predict(work).log_ms, std::log(renderer_ms(work, gain)), 0.1) << gain;
    }
}

TEST(CostModel, WhatIsNeverSeenIsForgottenNoFurtherThanTheFirstBelief) {
    const Amounts seen = amounts(1, 1, 0);
    CostModel model(belief);
    for (int i = 0; i < 2; ++i) model.observe(seen, renderer_ms(seen));
    const double first = model.price_uncertainty(2);
    for (int i = 0; i < 500'000; ++i) model.observe(seen, renderer_ms(seen));
    EXPECT_NEAR(model.price_uncertainty(2), first, 0.01 * first);
}

// The same renderer timed in microseconds: all that has a unit has the other one.
TEST(CostModel, PricesAndTheirUncertaintyAreInTheTimesUnit) {
    CostModel ms(belief), us(belief);
    std::mt19937_64 random(8);
    for (int i = 0; i < 100; ++i) {
        const Amounts work = any_work(random);
        const double time = renderer_ms(work) * std::exp(0.02 * normal(random));
        ms.observe(work, time);
        us.observe(work, 1000 * time);
    }
    for (int term = 0; term < 3; ++term) {
        EXPECT_NEAR(us.price(term) / ms.price(term), 1000, 1e-3);
        EXPECT_NEAR(us.price_uncertainty(term) / ms.price_uncertainty(term), 1000, 1e-3);
    }
}

TEST(CostModel, TellsTheNoiseOfASingleFrame) {
    for (const double noise : {0.005, 0.03, 0.1}) {
        std::mt19937_64 random(6);
        CostModel model(belief);
        const Amounts work = amounts(1, 1, 1);
        double sum = 0;
        for (int i = 0; i < 2000; ++i) {
            const double spike = i % 100 == 0 ? 50 : 0;
            model.observe(work, renderer_ms(work) * std::exp(noise * normal(random)) + spike);
            sum += i >= 1000 ? model.noise() / 1000 : 0;
        }
        EXPECT_NEAR(sum, noise, 0.15 * noise);
    }
}

}  // namespace
}  // namespace sfsm
