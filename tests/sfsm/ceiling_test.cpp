// Rises of detail that failed: how far and how soon they are tried again.
#include "sfsm/ceiling.h"

#include <gtest/gtest.h>

namespace sfsm {
namespace {

constexpr int trial = 24, first_wait = 16, longest = 1024;  // decisions, as ceiling.h tells
constexpr int unconfirmed = 64;
constexpr int held = 6, settled = 10;
constexpr double ms = 16;

void pass(Ceiling& ceiling, int decisions, double ms_at_floor = ms) {
    for (int i = 0; i < decisions; ++i) ceiling.step(ms_at_floor, 0);
}

// A rise from 0.4 to 0.8 that failed at once, back to 0.4.
void fail(Ceiling& ceiling) {
    ceiling.rise(0.4, 0.8, ms);
    ceiling.fall(0.8, 0.4);
}

// The same again after its ceiling was lifted.
void confirm(Ceiling& ceiling) {
    fail(ceiling);
    pass(ceiling, unconfirmed);
    fail(ceiling);
}

bool is_there(Ceiling ceiling) {
    return ceiling.rise(0.4, 1, ms) < 1;
}

// Decisions until a rise from `from` is allowed.
int wait(Ceiling ceiling, double from, double to_spare = 0) {
    int decisions = 0;
    for (; ceiling.rise(from, 1, ms) == from && decisions < 2 * longest; ++decisions) ceiling.step(ms, to_spare);
    return decisions;
}

TEST(Ceiling, RisesAreFreeUntilOneFails) {
    Ceiling ceiling;
    for (int i = 1; i < 100; ++i) {
        EXPECT_EQ(ceiling.rise(0.01 * (i - 1), 0.01 * i, ms), 0.01 * i);
        pass(ceiling, i % 40);
        EXPECT_EQ(ceiling.fall(0.7, 0.01), 0.01) << "what no rise led to";
    }
}

TEST(Ceiling, AFailedRiseFallsNoLowerThanItBegan) {
    for (const auto& [to, expected] : {std::pair{0.7, 0.7}, std::pair{0.41, 0.41}, std::pair{0.1, 0.4}}) {
        Ceiling ceiling;
        EXPECT_EQ(ceiling.rise(0.4, 0.8, ms), 0.8);
        EXPECT_EQ(ceiling.fall(0.8, to), expected);
        EXPECT_EQ(ceiling.floor(), 0.4);
    }
}

TEST(Ceiling, TheSecondFallIsAtLeastHalfWayBack) {
    for (const auto& [to, expected] : {std::pair{0.74, 0.575}, std::pair{0.5, 0.5}, std::pair{0.1, 0.4}}) {
        Ceiling ceiling;
        ceiling.rise(0.4, 0.8, ms);
        EXPECT_EQ(ceiling.fall(0.8, 0.75), 0.75) << "what is believed, the first time";
        EXPECT_DOUBLE_EQ(ceiling.fall(0.75, to), expected) << to;
    }
}

TEST(Ceiling, EachRiseMayFailOnceAtItsFirstBelief) {
    Ceiling ceiling;
    ceiling.rise(0.4, 0.8, ms);
    ceiling.fall(0.8, 0.4);
    pass(ceiling, first_wait);
    const double higher = ceiling.rise(0.4, 1, ms);
    ASSERT_DOUBLE_EQ(higher, 0.6);
    EXPECT_EQ(ceiling.fall(higher, 0.59), 0.59);
}

TEST(Ceiling, ARiseIsOnTrialForSoManyDecisions) {
    for (const int decisions : {0, 1, trial - 1, trial, trial + 1, 1000}) {
        Ceiling ceiling;
        ceiling.rise(0.4, 0.8, ms);
        pass(ceiling, decisions);
        EXPECT_EQ(ceiling.fall(0.8, 0.1), decisions <= trial ? 0.4 : 0.1) << decisions;
    }
    Ceiling ceiling;  // and after each fall anew
    ceiling.rise(0.4, 0.8, ms);
    pass(ceiling, trial);
    ceiling.fall(0.8, 0.7);
    pass(ceiling, trial);
    EXPECT_EQ(ceiling.fall(0.7, 0.1), 0.4);
}

TEST(Ceiling, WaitsDoubleWithEachFailureUpToTheLongest) {
    Ceiling ceiling;
    fail(ceiling);
    pass(ceiling, unconfirmed);
    ceiling.rise(0.4, 0.8, ms);
    double at = 0.8;
    for (const int expected : {16, 32, 64, 128, 256, 512, longest}) {
        // Fails again and again before its trial is over: each fall is one more failure.
        ceiling.fall(at, at - 0.001);
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
        ceiling.fall(at, 0.6);
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
    ceiling.fall(0.95, 0.85);
    pass(ceiling, unconfirmed);
    EXPECT_EQ(ceiling.rise(0.85, 1, ms), 1);
}

// What a failure taught is believed of all details, until the floor has been drawn.
TEST(Ceiling, AfterAFailureTheFloorIsHeldForAFewDecisions) {
    Ceiling ceiling;
    fail(ceiling);
    for (int i = 0; i < held; ++i) {
        EXPECT_EQ(ceiling.fall(0.4, 0.1), 0.4) << i;
        EXPECT_EQ(Ceiling(ceiling).fall(0.39, 0.1), 0.1) << "not its floor";
        pass(ceiling, 1);
    }
    EXPECT_EQ(ceiling.fall(0.4, 0.1), 0.1);
}

TEST(Ceiling, IsForgottenWhenTheLoadHasFallen) {
    for (const auto& [share, is_forgotten] : {std::pair{0.86, false}, std::pair{0.84, true}, std::pair{0.1, true}}) {
        Ceiling ceiling;
        fail(ceiling);
        pass(ceiling, trial - 1, 0.1 * ms);
        EXPECT_TRUE(is_there(ceiling)) << "still on trial";
        pass(ceiling, 1, share * ms);
        EXPECT_EQ(!is_there(ceiling), is_forgotten) << share;
    }
}

// A rise that failed as the load rose is compared with that load; with no more, though, than was ever predicted of it.
TEST(Ceiling, LoadIsComparedWithTheMostThatWasPredictedOnceTheFailureIsUnderstood) {
    for (const auto& [since, is_compared] : {std::pair{settled - 1, false}, std::pair{settled, true}}) {
        Ceiling ceiling;
        fail(ceiling);
        pass(ceiling, since - 1);
        pass(ceiling, 1, 1.3 * ms);
        pass(ceiling, trial - since);
        EXPECT_EQ(!is_there(ceiling), is_compared) << since;
    }
}

TEST(Ceiling, LoadIsComparedWithThatOfTheRiseThatFailed) {
    Ceiling ceiling;
    confirm(ceiling);
    pass(ceiling, trial + 1);
    // Rises below the ceiling, under less and less load: each is within 15 % of the one before.
    EXPECT_EQ(ceiling.rise(0.4, 0.45, 0.93 * ms), 0.45);
    EXPECT_EQ(ceiling.floor(), 0.4);
    pass(ceiling, trial, 0.93 * ms);
    EXPECT_EQ(ceiling.rise(0.45, 0.5, 0.86 * ms), 0.5);
    EXPECT_TRUE(is_there(ceiling));
    pass(ceiling, 1, 0.84 * ms);
    EXPECT_FALSE(is_there(ceiling)) << "at once, though the last rise is still on trial";
}

// A slow frame under a new target is no failed rise.
TEST(Ceiling, ForgettingEndsTheTrialOfARise) {
    Ceiling ceiling;
    ceiling.rise(0.3, 0.5, ms);
    ceiling.forget();
    EXPECT_EQ(ceiling.fall(0.5, 0.1), 0.1);
    EXPECT_EQ(ceiling.rise(0.1, 0.9, ms), 0.9);
}

TEST(Ceiling, ForgettingEndsTheWaitAndItsGrowth) {
    Ceiling ceiling;
    ceiling.rise(0.4, 0.8, ms);
    ceiling.fall(0.8, 0.75);
    ceiling.fall(0.75, 0.5);
    ceiling.fall(0.5, 0.4);
    ceiling.forget();
    EXPECT_EQ(ceiling.rise(0.4, 0.8, ms), 0.8);
    ceiling.fall(0.8, 0.4);
    EXPECT_EQ(wait(ceiling, 0.4), first_wait);
}

}  // namespace
}  // namespace sfsm
