// Rises of detail that failed: how far and how soon they are tried again.
#include "sfsm/ceiling.h"

#include <gtest/gtest.h>

namespace sfsm {
namespace {

constexpr int trial = 24, first_wait = 16, longest = 1024;  // decisions, as ceiling.h tells
constexpr int unconfirmed = 64;
constexpr double ms = 16, slow_ms = 20;

void pass(Ceiling& ceiling, int decisions, double ms_at_floor = ms, double ms_at_top = slow_ms) {
    for (int i = 0; i < decisions; ++i) ceiling.step(ms_at_floor, ms_at_top, 0);
}

// A rise from 0.4 to 0.8 that failed at once, back to 0.4.
void fail(Ceiling& ceiling) {
    ceiling.rise(0.4, 0.8, ms);
    ceiling.fall(0.8, 0.4, slow_ms);
}

// The same again after its ceiling was lifted.
void confirm(Ceiling& ceiling) {
    fail(ceiling);
    pass(ceiling, unconfirmed);
    fail(ceiling);
}

// Decisions until a rise from `from` is allowed.
int wait(Ceiling ceiling, double from, double to_spare = 0) {
    int decisions = 0;
    for (; ceiling.rise(from, 1, ms) == from && decisions < 2 * longest; ++decisions)
        ceiling.step(ms, slow_ms, to_spare);
    return decisions;
}

TEST(Ceiling, RisesAreFreeUntilOneFails) {
    Ceiling ceiling;
    for (int i = 1; i < 100; ++i) {
        EXPECT_EQ(ceiling.rise(0.01 * (i - 1), 0.01 * i, ms), 0.01 * i);
        pass(ceiling, i % 40);
        EXPECT_EQ(ceiling.fall(0.7, 0.01, slow_ms), 0.01) << "what no rise led to";
    }
}

TEST(Ceiling, AFailedRiseFallsNoLowerThanItBegan) {
    for (const auto& [to, expected] : {std::pair{0.7, 0.7}, std::pair{0.41, 0.41}, std::pair{0.1, 0.4}}) {
        Ceiling ceiling;
        EXPECT_EQ(ceiling.rise(0.4, 0.8, ms), 0.8);
        EXPECT_EQ(ceiling.fall(0.8, to, slow_ms), expected);
        EXPECT_EQ(ceiling.floor(), 0.4);
    }
}

TEST(Ceiling, TheSecondFallIsAtLeastHalfWayBack) {
    for (const auto& [to, expected] : {std::pair{0.74, 0.575}, std::pair{0.5, 0.5}, std::pair{0.1, 0.4}}) {
        Ceiling ceiling;
        ceiling.rise(0.4, 0.8, ms);
        EXPECT_EQ(ceiling.fall(0.8, 0.75, slow_ms), 0.75) << "what is believed, the first time";
        EXPECT_DOUBLE_EQ(ceiling.fall(0.75, to, slow_ms), expected) << to;
    }
}

TEST(Ceiling, EachRiseMayFailOnceAtItsFirstBelief) {
    Ceiling ceiling;
    ceiling.rise(0.4, 0.8, ms);
    ceiling.fall(0.8, 0.4, slow_ms);
    pass(ceiling, first_wait);
    const double higher = ceiling.rise(0.4, 1, ms);
    ASSERT_DOUBLE_EQ(higher, 0.6);
    EXPECT_EQ(ceiling.fall(higher, 0.59, slow_ms), 0.59);
}

TEST(Ceiling, ARiseIsOnTrialForSoManyDecisions) {
    for (const int decisions : {0, 1, trial - 1, trial, trial + 1, 1000}) {
        Ceiling ceiling;
        ceiling.rise(0.4, 0.8, ms);
        pass(ceiling, decisions);
        EXPECT_EQ(ceiling.fall(0.8, 0.1, slow_ms), decisions <= trial ? 0.4 : 0.1) << decisions;
    }
    Ceiling ceiling;  // and after each fall anew
    ceiling.rise(0.4, 0.8, ms);
    pass(ceiling, trial);
    ceiling.fall(0.8, 0.7, slow_ms);
    pass(ceiling, trial);
    EXPECT_EQ(ceiling.fall(0.7, 0.1, slow_ms), 0.4);
}

TEST(Ceiling, WaitsDoubleWithEachFailureUpToTheLongest) {
    Ceiling ceiling;
    fail(ceiling);
    pass(ceiling, unconfirmed);
    ceiling.rise(0.4, 0.8, ms);
    double at = 0.8;
    for (const int expected : {16, 32, 64, 128, 256, 512, longest}) {
        // Fails again and again before its trial is over: each fall is one more failure.
        ceiling.fall(at, at - 0.001, slow_ms);
        EXPECT_EQ(wait(ceiling, 0.4), expected);
        at = 0.4 + (at - 0.4) / (expected == 16 ? 1 : 2) - (expected == 16 ? 0.001 : 0);
    }
}

TEST(Ceiling, HurriesWhileMuchTimeIsToSpareUntilItIsHopeless) {
    Ceiling ceiling;
    fail(ceiling);
    pass(ceiling, unconfirmed);
    ceiling.rise(0.4, 0.8, ms);
    double at = 0.8;
    for (const int patience : {16, 32, 64, 128, 256}) {
        ceiling.fall(at, 0.6, slow_ms);
        at = patience == 16 ? 0.6 : (0.4 + at) / 2;
        EXPECT_EQ(wait(ceiling, 0.4, 0.2), patience < 128 ? patience / 8 : patience);
        EXPECT_EQ(wait(ceiling, 0.4, 0.05), patience) << "little is to spare";
        EXPECT_EQ(wait(ceiling, 0.4, -0.2), patience) << "none is to spare";
    }
}

TEST(Ceiling, BelowItRisesGoHalfWayAndAreWatched) {
    Ceiling ceiling;
    confirm(ceiling);
    pass(ceiling, first_wait);
    EXPECT_EQ(Ceiling(ceiling).rise(0.4, 0.45, ms), 0.45) << "no farther than asked";
    EXPECT_DOUBLE_EQ(ceiling.rise(0.4, 1, ms), 0.6);
    EXPECT_EQ(wait(ceiling, 0.6), trial);
    pass(ceiling, trial);
    EXPECT_DOUBLE_EQ(ceiling.rise(0.6, 1, ms), 0.7);
    pass(ceiling, trial);
    EXPECT_EQ(ceiling.rise(0.785, 1, ms), 0.785) << "not worth a rise";
    EXPECT_GT(ceiling.rise(0.775, 1, ms), 0.775);
}

TEST(Ceiling, LastsLongOnlyOnceTheNextRiseConfirmsIt) {
    Ceiling chance;
    fail(chance);
    pass(chance, unconfirmed - 1);
    EXPECT_DOUBLE_EQ(Ceiling(chance).rise(0.4, 1, ms), 0.6);
    pass(chance, 1);
    EXPECT_EQ(chance.rise(0.4, 1, ms), 1);
    Ceiling confirmed;
    confirm(confirmed);
    pass(confirmed, longest - 1);
    EXPECT_DOUBLE_EQ(Ceiling(confirmed).rise(0.4, 1, ms), 0.6);
    pass(confirmed, 1);
    EXPECT_EQ(confirmed.rise(0.4, 1, ms), 1);
}

TEST(Ceiling, IsNotConfirmedByARiseFromAboveIt) {
    Ceiling ceiling;
    fail(ceiling);
    pass(ceiling, unconfirmed);
    ceiling.rise(0.85, 0.95, ms);
    ceiling.fall(0.95, 0.85, slow_ms);
    pass(ceiling, unconfirmed);
    EXPECT_EQ(ceiling.rise(0.85, 1, ms), 1);
}

TEST(Ceiling, IsForgottenWhenTheLoadHasFallenByATenth) {
    for (const auto& [share, is_forgotten] : {std::pair{0.91, false}, std::pair{0.89, true}, std::pair{0.1, true}}) {
        Ceiling ceiling;
        fail(ceiling);
        pass(ceiling, trial, 0.1 * ms);  // still on trial: what is predicted now is what proved wrong
        EXPECT_LT(Ceiling(ceiling).rise(0.4, 1, ms), 1);
        pass(ceiling, 2, share * ms);
        EXPECT_EQ(ceiling.rise(0.4, 1, ms) == 1, is_forgotten) << share;
    }
}

TEST(Ceiling, LoadIsComparedWithThatOfTheRiseThatFailed) {
    Ceiling ceiling;
    confirm(ceiling);
    pass(ceiling, trial + 1);
    // Rises below the ceiling, under less and less load: each is within a tenth of the one before.
    EXPECT_EQ(ceiling.rise(0.4, 0.45, 0.95 * ms), 0.45);
    EXPECT_EQ(ceiling.floor(), 0.4);
    pass(ceiling, trial, 0.95 * ms);
    EXPECT_EQ(ceiling.rise(0.45, 0.5, 0.91 * ms), 0.5);
    EXPECT_LT(Ceiling(ceiling).top(), 1);
    pass(ceiling, 1, 0.89 * ms);
    EXPECT_EQ(ceiling.top(), 1) << "at once, though the last rise is still on trial";
}

TEST(Ceiling, IsForgottenWhenItsOwnDetailIsPredictedToBeFast) {
    for (const auto& [share, is_forgotten] : {std::pair{0.81, false}, std::pair{0.79, true}}) {
        Ceiling ceiling;
        confirm(ceiling);
        pass(ceiling, trial, ms, 0.1 * slow_ms);
        EXPECT_EQ(ceiling.top(), 0.8) << "what is predicted now is what proved wrong";
        pass(ceiling, 1, ms, share * slow_ms);
        EXPECT_EQ(ceiling.top() == 1, is_forgotten) << share;
    }
}

TEST(Ceiling, ForgettingEndsTheWaitAndItsGrowth) {
    Ceiling ceiling;
    ceiling.rise(0.4, 0.8, ms);
    ceiling.fall(0.8, 0.75, slow_ms);
    ceiling.fall(0.75, 0.5, slow_ms);
    ceiling.fall(0.5, 0.4, slow_ms);
    ceiling.forget();
    EXPECT_EQ(ceiling.rise(0.4, 0.8, ms), 0.8);
    ceiling.fall(0.8, 0.4, slow_ms);
    EXPECT_EQ(wait(ceiling, 0.4), first_wait);
}

}  // namespace
}  // namespace sfsm
