// A load that never rests is told from noise, from jumps and from prices that are wrong.
#include "sfsm/drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/sfsm/normal.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr double noise = 0.03;

double swing(int frame, double period, double height = 0.15) {
    return height * std::sin(2 * std::numbers::pi * frame / period);
}

using Load = std::function<double(int frame)>;

// Frames, of 3000, for which a drift was seen. Detail answers the load by `answer` of it.
int frames_on(const Load& log_load, double answer, std::uint64_t seed = 1) {
    std::mt19937_64 random(seed);
    Drift drift;
    int on = 0;
    for (int i = 0; i < 3000; ++i) {
        drift.observe(log_load(i) + noise * normal(random), 0.5 + answer * log_load(i - 3), noise);
        on += drift.is_on() ? 1 : 0;
    }
    return on;
}

TEST(Drift, ALoadThatSwingsIsSeen) {
    for (const double period : {80, 150, 300, 500}) {
        const Load load = [=](int frame) { return swing(frame, period); };
        EXPECT_GT(frames_on(load, -0.5), 3000 - 2.5 * period - 100) << period;
    }
}

TEST(Drift, RestNoiseAndJumpsAreNone) {
    EXPECT_EQ(frames_on([](int) { return 0.0; }, -0.5), 0);
    EXPECT_EQ(frames_on([](int frame) { return frame / 400 % 2 * 0.5; }, -0.5), 0) << "jumps";
    EXPECT_EQ(frames_on([](int frame) { return swing(frame, 200, 0.04); }, -0.5), 0) << "too little to follow";
    EXPECT_EQ(frames_on([](int frame) { return frame % 97 == 0 ? 1.0 : 0.0; }, -0.5), 0) << "hitches";
}

TEST(Drift, ALoadThatGrowsWithDetailIsAPrice) {
    EXPECT_EQ(frames_on([](int frame) { return swing(frame, 200); }, 0.5), 0);
}

TEST(Drift, AheadIsWhereTheLoadWillBe) {
    for (const double period : {100, 200, 400}) {
        std::mt19937_64 random(1);
        Drift drift;
        double squares = 0;
        for (int i = 0; i < 3000; ++i) {
            drift.observe(swing(i, period) + noise * normal(random), 0.5 - swing(i - 3, period), noise);
            if (i >= 1000) squares += std::pow(drift.ahead(3) - swing(i + 3, period), 2) / 2000;
        }
        EXPECT_LT(std::sqrt(squares), 0.03) << "in deviations; the level alone lags by 4 % at 100 frames: " << period;
    }
}

TEST(Drift, EndsWithTheSwing) {
    Drift drift;
    const auto swung = [](int frame) { return swing(frame, 200); };
    for (int i = 0; i < 1000; ++i) drift.observe(swung(i), 0.5 - swung(i - 3), noise);
    EXPECT_TRUE(drift.is_on());
    int frames = 0;
    for (; drift.is_on() && frames < 1000; ++frames) drift.observe(0, 0.5, noise);
    EXPECT_LT(frames, 400);
    for (int i = 0; i < 1000; ++i) drift.observe(swung(i), 0.5 - swung(i - 3), noise);
    EXPECT_TRUE(drift.is_on());
    for (int i = 0; i < 2; ++i) drift.observe(0.7, 0.5, noise);
    EXPECT_FALSE(drift.is_on()) << "a jump";
    EXPECT_EQ(drift.ahead(3), 0.7);
}

TEST(Drift, AnOutlierIsLeftOut) {
    Drift drift;
    for (int i = 0; i < 10; ++i) drift.observe(0, 0.5, noise);
    drift.observe(0.5, 0.5, noise);
    EXPECT_EQ(drift.ahead(1), 0);
    drift.observe(-0.5, 0.5, noise);
    EXPECT_EQ(drift.ahead(1), 0) << "two that disagree";
}

}  // namespace
}  // namespace sfsm
