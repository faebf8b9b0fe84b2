#include "sfsm/pairing.h"

#include <gtest/gtest.h>

#include <limits>

namespace sfsm {
namespace {

Decision splats(double size) {
    return {State::points, 100, size};
}

// Decisions number 0, 1, ...: each another size.
void decide(Pairing& pairing, int count) {
    for (int i = 0; i < count; ++i) pairing.add(splats(1 + 0.25 * static_cast<double>(pairing.count())));
}

FrameSample drawn(std::int64_t frame, int number) {
    return {frame, 16, splats(1 + 0.25 * number), {}};
}

TEST(Pairing, NumbersMayBeginAnywhere) {
    constexpr auto farthest = std::numeric_limits<std::int64_t>::max() - 100;
    for (const std::int64_t first : {std::int64_t{0}, std::int64_t{1}, std::int64_t{1000}, std::int64_t{-7}, farthest,
                                     std::numeric_limits<std::int64_t>::min()}) {
        for (const int delay : {0, 2, 16}) {
            Pairing pairing;
            decide(pairing, delay);
            for (int number = 0; number < 60; ++number) {
                decide(pairing, 1);
                FrameSample sample = drawn(first + number, number);
                ASSERT_TRUE(pairing.pair(sample));
                ASSERT_EQ(sample.frame, number) << first << " delay " << delay;
            }
        }
    }
}

TEST(Pairing, FramesThatWereNotDecidedMoveTheNumbering) {
    Pairing pairing;
    decide(pairing, 40);
    FrameSample sample = drawn(30, 30);
    ASSERT_TRUE(pairing.pair(sample));
    sample = drawn(36, 33);  // three loading frames between
    ASSERT_TRUE(pairing.pair(sample));
    EXPECT_EQ(sample.frame, 33);
    sample = {37, 16, {State::slowed, 50, 0}, {}};  // of nobody's, on its number
    ASSERT_TRUE(pairing.pair(sample));
    EXPECT_EQ(sample.frame, 34);
    EXPECT_EQ(sample.decision, (Decision{State::slowed, 50, 0}));
}

// Equal decisions don't move it: the one of the number is taken, whatever else is alike.
TEST(Pairing, AKeptDecisionIsPairedByItsNumber) {
    Pairing pairing;
    for (int i = 0; i < 20; ++i) pairing.add(splats(2));
    for (const int number : {3, 9, 10, 19}) {
        FrameSample sample{number, 16, splats(2), {}};
        ASSERT_TRUE(pairing.pair(sample));
        EXPECT_EQ(sample.frame, number);
    }
}

TEST(Pairing, ARoundedDecisionGetsItsBitsBack) {
    Pairing pairing;
    const Decision decision{State::points, 123.456789012, 1.23456789012, 4.56789012e-7};
    pairing.add(decision);
    FrameSample sample{0, 16, {State::points, 123.457, 1.23457, 4.56789e-7}, {}};
    ASSERT_TRUE(pairing.pair(sample));
    EXPECT_EQ(sample.decision, decision);
    sample.decision = {State::points, static_cast<float>(123.456789012), static_cast<float>(1.23456789012),
                       static_cast<float>(4.56789012e-7)};
    ASSERT_TRUE(pairing.pair(sample));
    EXPECT_EQ(sample.decision, decision);
}

TEST(Pairing, OnlyNumbersThatMeanSomethingAreCompared) {
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(is_alike({}, {State::original, 0, 0}));
    EXPECT_TRUE(is_alike({State::slowed, 40, 0}, {State::slowed, 40.0001, 7}));
    EXPECT_TRUE(is_alike({State::points, infinite, 2}, {State::points, infinite, 2}));
    EXPECT_FALSE(is_alike({State::slowed, 40, 0}, {State::slowed, 40.01, 0}));
    EXPECT_FALSE(is_alike({State::points, 40, 2}, {State::points, 40, 2.001}));
    EXPECT_FALSE(is_alike({State::points, 40, 2, 1e-7}, {State::points, 40, 2, 1.001e-7}));
    EXPECT_FALSE(is_alike({State::points, 40, 2, 0}, {State::points, 40, 2, 1e-300}));
    EXPECT_FALSE(is_alike({State::slowed, 40, 0}, {State::points, 40, 0}));
}

TEST(Pairing, FramesOfAForgottenSceneAreNotPaired) {
    Pairing pairing;
    decide(pairing, 50);
    FrameSample sample = drawn(1046, 46);
    ASSERT_TRUE(pairing.pair(sample));
    pairing.forget();
    decide(pairing, 2);
    for (const int number : {47, 48, 49}) {
        sample = drawn(1000 + number, number);
        EXPECT_FALSE(pairing.pair(sample)) << number;
    }
    sample = drawn(1050, 50);
    ASSERT_TRUE(pairing.pair(sample));
    EXPECT_EQ(sample.frame, 50);
}

TEST(Pairing, AfterAForgottenSceneNumbersMayBeginAnew) {
    Pairing pairing;
    decide(pairing, 200);
    FrameSample sample = drawn(198, 198);
    ASSERT_TRUE(pairing.pair(sample));
    pairing.forget();
    for (int i = 0; i < 20; ++i) {
        decide(pairing, 1);
        sample = drawn(i, 200 + i);
        ASSERT_TRUE(pairing.pair(sample));
        EXPECT_EQ(sample.frame, 200 + i);
    }
}

}  // namespace
}  // namespace sfsm
