// What is learned of forecasts that are off.
#include "sfsm/foresight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sfsm {
namespace {

constexpr double rounding = 1e-9;  // of logarithms of sums of a few terms
const Decision decision{State::points, 50, 2};

Amounts work(double times = 1) {
    return {{2 * times, 3 * times, 5 * times}, 3};
}

// Of `times` the work the price is `times` as high, whatever was learned.
CostModel priced() {
    CostModel model({3, {1, 1, 1}, 0, {}});
    for (int i = 0; i < 5; ++i) model.observe(work(), 12);
    return model;
}

FrameSample frame(std::int64_t number, const Decision& drawn_with = decision) {
    return {number, 12, drawn_with, {}};
}

class ForesightOf : public testing::Test {
protected:
    // One frame that drew so many times what was foreseen of it.
    void draw(double log_times) { draw(work(std::exp(log_times))); }
    void draw(const Amounts& drawn) {
        foresight_.foresee(next_, decision, work());
        foresight_.observe(frame(next_), drawn, model_);
        ++next_;
    }
    // ln of what is foreseen to be drawn, over what is said to be.
    double error() const {
        return foresight_.bias() + model_.predict(foresight_.corrected(work())).log_ms - model_.predict(work()).log_ms;
    }

    const CostModel model_ = priced();
    Foresight foresight_;
    std::int64_t next_ = 0;
};

TEST_F(ForesightOf, FramesIsTheMeanOfHowFarTheyAreOff) {
    EXPECT_EQ(foresight_.bias(), 0);
    double sum = 0;
    for (int i = 1; i <= 16; ++i) {
        const double off = 0.02 * (i % 3) - 0.01;  // within what one frame may surprise by
        draw(off);
        sum += off;
        EXPECT_NEAR(foresight_.bias(), sum / i, rounding) << i;
    }
}

TEST_F(ForesightOf, FramesForgetsWithAMemoryOfSixteen) {
    for (int i = 0; i < 100; ++i) draw(0.05);
    EXPECT_NEAR(foresight_.bias(), 0.05, rounding);
    for (int i = 1; i <= 40; ++i) {
        draw(0);
        EXPECT_NEAR(foresight_.bias(), 0.05 * std::pow(15.0 / 16, i), rounding) << i;
    }
}

TEST_F(ForesightOf, OneWildFrameCountsForATenthOfItself) {
    for (int i = 0; i < 100; ++i) draw(0);
    draw(1.5);
    EXPECT_NEAR(foresight_.bias(), 0.1 / 16, rounding);
    draw(-1.5);
    EXPECT_LT(foresight_.bias(), 0.001);
}

TEST_F(ForesightOf, TwoFramesThatAgreeIsBelievedAtOnce) {
    for (const double off : {std::log(2), std::log(0.5), 0.0, 1.0, 0.8}) {
        draw(off);
        draw(off);
        EXPECT_NEAR(foresight_.factor(1), std::exp(off), rounding);
        EXPECT_NEAR(foresight_.factor(2), std::exp(off), rounding);
        for (int i = 0; i < 50; ++i) draw(off);
        EXPECT_NEAR(error(), off, 0.01);
    }
}

TEST_F(ForesightOf, FramesThatDisagreeIsNotBelieved) {
    for (int i = 0; i < 100; ++i) draw(0);
    for (int i = 0; i < 30; ++i) draw(i % 2 == 0 ? 0.4 : -0.4);
    EXPECT_LT(std::abs(error()), 0.02);
}

TEST_F(ForesightOf, OneWildFrameAfterAMildOneIsNotBelieved) {
    for (int i = 0; i < 20; ++i) {
        draw(std::log(1.1));
        draw(std::log(1.24));
    }
    EXPECT_EQ(foresight_.factor(1), 1);
    EXPECT_EQ(foresight_.factor(2), 1);
    draw(std::log(1.24));
    EXPECT_GT(foresight_.factor(2), 1) << "and two are";
}

TEST_F(ForesightOf, AllFramesIsEightfoldAtMost) {
    for (const double off : {3.0, -3.0}) {
        for (int i = 0; i < 500; ++i) draw(off);
        EXPECT_NEAR(foresight_.factor(1), off > 0 ? 8 : 1.0 / 8, rounding);
        EXPECT_LE(std::abs(foresight_.bias()), 0.3);
    }
}

// What a factor may not make up for is left to the mean of all.
TEST_F(ForesightOf, AKindBeyondEightfoldLeavesTheRestToTheBias) {
    for (int i = 0; i < 100; ++i) draw({{2, 3 * 20, 5}, 3});
    EXPECT_NEAR(foresight_.factor(1), 8, rounding);
    EXPECT_GT(foresight_.bias(), 0.25);
}

TEST_F(ForesightOf, EachKindIsItsOwn) {
    const Amounts drawn = {{2, 3 * 2, 5 * 0.5}, 3};
    const Amounts more = {{2, 3 * 4, 5 * 1.5}, 3};
    for (const Amounts& amounts : {drawn, drawn, more, more}) draw(amounts);
    EXPECT_NEAR(foresight_.factor(1), 4, rounding);
    EXPECT_NEAR(foresight_.factor(2), 1.5, rounding);
    const Amounts corrected = foresight_.corrected(work());
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(corrected.of[i], more.of[i], rounding) << i;
}

TEST_F(ForesightOf, AKindOfLittleTimeIsUnheard) {
    for (int i = 0; i < 5; ++i) {
        foresight_.foresee(next_, decision, {{2, 3, 1e-3}, 3});
        foresight_.observe(frame(next_), {{2, 3, 5}, 3}, model_);
        ++next_;
    }
    EXPECT_EQ(foresight_.factor(2), 1);
}

TEST_F(ForesightOf, AFrameIsThatFramesAlone) {
    const Amounts twice = work(1.05);
    foresight_.foresee(7, decision, work());
    foresight_.observe(frame(6), twice, model_);
    foresight_.observe(frame(8), twice, model_);
    foresight_.observe(frame(7 + 32), twice, model_);  // of the same place in the ring
    foresight_.observe(frame(7, {State::points, 50, 3}), twice, model_);
    foresight_.observe(frame(7, {State::slowed, 50, 0}), twice, model_);
    foresight_.observe(frame(7, {State::points, 50, 2, 1e-6}), twice, model_);
    foresight_.observe(frame(0), twice, model_);  // never foreseen
    EXPECT_EQ(foresight_.bias(), 0);
    foresight_.observe(frame(7), twice, model_);
    EXPECT_NEAR(foresight_.bias(), std::log(1.05), rounding);
}

TEST_F(ForesightOf, FramesThatAreTimedLateIsKept) {
    for (int i = 0; i < 32; ++i) foresight_.foresee(i, decision, work(i == 0 ? 1 : 3));
    foresight_.observe(frame(0), work(1.05), model_);
    EXPECT_NEAR(foresight_.bias(), std::log(1.05), rounding);
}

}  // namespace
}  // namespace sfsm
