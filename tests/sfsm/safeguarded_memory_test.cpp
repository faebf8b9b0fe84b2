// What the safeguarded law counts and remembers: holds, waits, hitches and searches in vain, driven by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sfsm/detail.h"
#include "sfsm/safeguarded.h"
#include "tests/sfsm/driven.h"

namespace sfsm {
namespace {

constexpr double sought_ms = 10, triangles = 20, points = 8;  // [ms] nothing between too slow and too fast
constexpr int prompt = 8;                                     // times within which an answer is at once

// Short waits, so that they reach the longest.
SafeguardedConstants quick() {
    SafeguardedConstants constants;
    constants.first_patience = 4;
    constants.hold = 64;
    constants.longest_wait = 1000;
    return constants;
}

struct Drive : Driven<SafeguardedLaw> {
    Drive() : Driven(sought_ms, quick()) {}

    int failed = 0;      // returns from points so far
    Decision slow = {};  // the last decision that was too slow

    // Tries triangles until it is back in points. Returns how long it had been there.
    int stay() {
        const int times = leave_state(points);
        return_to_points();
        return times;
    }
    void return_to_points() {
        for (int i = 0; i < 100 && decision.state != State::points; ++i) {
            slow = decision;
            answer(triangles);
        }
        ASSERT_EQ(decision.state, State::points);
        ++failed;
    }
    // On to the first hold: the way between too slow and too fast is known to be a jump.
    void find_the_jump() {
        answer(triangles, 2);
        for (int i = 0; i < 1000 && !law.memory().is_held; ++i) {
            answer(decision.state == State::points ? points : triangles);
            if (decision.state != State::points) return_to_points();
        }
        ASSERT_TRUE(law.memory().is_held);
    }
};

// --- Holds and waits.

TEST(SafeguardedHolds, EachInARowLastsTwiceTheOneBeforeUpToTheLongest) {
    const SafeguardedConstants constants = quick();
    const auto doubled = [&](int first, int times) {
        return std::min<double>(std::ldexp(first, times), constants.longest_wait);
    };
    Drive run;
    run.find_the_jump();
    run.stay();  // the first was entered in the midst of it
    for (int hold = 1; hold < 8; ++hold) {
        const double expected = doubled(constants.hold, hold) + doubled(constants.first_patience, run.failed - 1);
        EXPECT_EQ(run.stay(), expected) << "hold " << hold << ", and the wait after so many failed returns";
    }
}

TEST(SafeguardedHolds, EndWithATrialOfWhatWasTooSlow) {
    Drive run;
    run.find_the_jump();
    for (int hold = 0; hold < 4; ++hold) {
        const Decision slow = run.slow;
        run.leave_state(points);
        EXPECT_EQ(run.decision, slow) << hold;
        run.return_to_points();
    }
}

TEST(SafeguardedHolds, EndAtOnceWhenTimesHaveMoved) {
    for (const double moved : {7.0, 9.2}) {  // by more than same_level, either way
        Drive run;
        run.find_the_jump();
        for (int hold = 0; hold < 4; ++hold) run.stay();
        run.answer(points, run.law.memory().wait + 40);
        ASSERT_TRUE(run.law.memory().is_held);
        ASSERT_GT(run.law.memory().hold, 8 * quick().hold);
        run.answer(moved, prompt);
        EXPECT_FALSE(run.law.memory().is_held) << moved;
        EXPECT_EQ(run.law.memory().hold, quick().hold) << "the next one is a first one";
    }
    Drive run;
    run.find_the_jump();
    for (int hold = 0; hold < 4; ++hold) run.stay();
    run.answer(points, run.law.memory().wait + 40);
    EXPECT_LE(run.leave_state(7), prompt) << "what was too slow may fit now";
}

TEST(SafeguardedHolds, LastWhileTimesMoveByLittle) {
    Drive run;
    run.find_the_jump();
    run.stay();
    run.answer(points, run.law.memory().wait + 1);
    ASSERT_TRUE(run.law.memory().is_held);
    const Decision held = run.decision;
    EXPECT_EQ(run.answer(1.03 * points, 50), held);
    EXPECT_EQ(run.answer(0.97 * points, 40), held);
}

TEST(SafeguardedHolds, ANewTargetEndsThemAndTheWaits) {
    Drive run;
    run.find_the_jump();
    for (int hold = 0; hold < 6; ++hold) run.stay();
    ASSERT_GT(run.law.memory().wait, 100);
    run.answer(points, 20);  // the wait has only begun
    run.retarget(1.2 * sought_ms);
    EXPECT_LE(run.leave_state(points), prompt);
    run.return_to_points();
    EXPECT_EQ(run.law.memory().hold, quick().hold);

    Drive held;
    held.find_the_jump();
    for (int hold = 0; hold < 3; ++hold) held.stay();
    held.answer(points, held.law.memory().wait + 30);
    ASSERT_TRUE(held.law.memory().is_held);
    held.retarget(1.2 * sought_ms);
    EXPECT_FALSE(held.law.memory().is_held);
    EXPECT_EQ(held.law.memory().hold, quick().hold);
}

TEST(SafeguardedWaits, AReturnThatLastsItsTrialHasNotFailed) {
    const SafeguardedConstants constants = quick();
    bool has_failed = false, has_lasted = false;
    for (int still = constants.trial - 8; still < constants.trial + 8; ++still) {
        Drive run;
        run.find_the_jump();
        run.stay();
        run.leave_state(points);
        int times = 0;  // since the return
        for (; times < still; ++times) run.answer(0.999 * sought_ms);
        ASSERT_NE(run.decision.state, State::points);
        for (; times < 200 && run.decision.state != State::points; ++times) run.answer(triangles);
        EXPECT_EQ(run.law.memory().wait, times < constants.trial ? constants.first_patience : 0)
            << "after " << times << ": the first wait, since the slow times were of another scene";
        has_failed = has_failed || times == constants.trial - 1;
        has_lasted = has_lasted || times == constants.trial;
    }
    EXPECT_TRUE(has_failed && has_lasted) << "both sides of the limit";
}

TEST(SafeguardedWaits, EndWhenAnotherSceneHasCome) {
    Drive run;
    run.find_the_jump();
    for (int hold = 0; hold < 6; ++hold) run.stay();
    ASSERT_GT(run.law.memory().wait, 100);
    const Decision decision = run.decision;
    ASSERT_EQ(run.answer(0.999 * sought_ms, 30), decision) << "all is well";
    EXPECT_LE(run.leave_state(0.6 * sought_ms), prompt);
}

TEST(SafeguardedWaits, CountFromTheEntryIntoPoints) {
    Drive run;
    run.find_the_jump();
    for (int hold = 0; hold < 6; ++hold) run.stay();
    const int wait = run.law.memory().wait;
    ASSERT_GT(wait, 100);
    run.answer(points, wait - 1);
    EXPECT_FALSE(run.law.memory().is_held);
    run.answer(points);
    EXPECT_TRUE(run.law.memory().is_held) << "now it may, and knows that nothing finer fits";
}

// Where the target is met a little above the boundary, crossing it is not worth the way back.
TEST(SafeguardedWaits, AReturnGoesClearlyAboveTheBoundary) {
    for (const auto& [sought, state] : {std::pair{0.672, State::points}, std::pair{0.70, State::slowed}}) {
        const Time time = [sought = sought](std::int64_t frame, const Decision& d) {
            return (frame < 200 ? 3 : 1) * sought_ms * (0.2 + 0.8 * detail_of(d, test_range) / sought);
        };
        SafeguardedLaw law;
        const auto rows = run(law, {time, constant(sought_ms), 600, 0});
        EXPECT_EQ(rows[199].decision.state, State::points);
        EXPECT_EQ(rows.back().decision.state, state) << sought;
    }
}

// --- Times.

// All detail is shown in half the targets time: no time moves anything.
struct Still : Driven<SafeguardedLaw> {
    Still() : Driven(20) { answer(10, 40); }
    double level_ms() const { return std::exp(law.memory().dwell.level); }
};

constexpr double rounding = 1e-9;

TEST(SafeguardedTimes, OneFarOffIsAHitchAndTwoAreAnotherLevel) {
    for (const double first : {13.0, 16.0, 7.0}) {
        for (const double second : {13.0, 16.0, 7.0}) {
            Still run;
            run.answer(first);
            EXPECT_NEAR(run.level_ms(), 10, rounding);
            run.answer(second);
            const bool is_one_side = (first > 10) == (second > 10);
            const double nearer = std::abs(std::log(first / 10)) < std::abs(std::log(second / 10)) ? first : second;
            EXPECT_NEAR(run.level_ms(), is_one_side ? nearer : 10, rounding) << first << " and " << second;
            run.answer(10);
            EXPECT_NEAR(run.level_ms(), is_one_side ? nearer : 10, rounding);
        }
    }
    Still run;  // two with a good time between them are two
    run.answer(16);
    run.answer(10);
    run.answer(16);
    EXPECT_NEAR(run.level_ms(), 10, rounding);
}

TEST(SafeguardedTimes, AnUnchangedDecisionsLevelIsTheirMean) {
    Driven<SafeguardedLaw> run(20);
    double sum = 0;
    for (int i = 1; i <= 64; ++i) {
        const double log_ms = std::log(10) + 0.002 * (i % 5);
        sum += log_ms;
        run.answer(std::exp(log_ms));
        ASSERT_NEAR(run.law.memory().dwell.level, sum / i, rounding) << i;
        ASSERT_EQ(run.law.memory().dwell.times, i);
    }
    run.answer(10);
    EXPECT_EQ(run.law.memory().dwell.times, 64) << "the horizon";
}

TEST(SafeguardedTimes, NoiseIsThatOfOneDecisionsTimes) {
    Driven<SafeguardedLaw> run(20);
    run.answer(10, 40);
    const double noise = run.law.memory().noise;
    for (int i = 0; i < 60; ++i) {  // a step after every second time
        run.retarget(i % 2 == 0 ? 8 : 20);
        run.answer(20 * detail_of(run.decision, test_range), 2);
    }
    EXPECT_EQ(run.law.memory().noise, noise) << "what a step changes is not noise";
}

TEST(SafeguardedTimes, APauseOfTheProgramIsNoTime) {
    Still run;
    run.answer(1e6);
    EXPECT_EQ(run.law.status().bad_samples, 0);
    for (const double ms : {1.001e6, 1e9, std::numeric_limits<double>::max()}) run.answer(ms);
    EXPECT_EQ(run.law.status().bad_samples, 3);
    EXPECT_NEAR(run.level_ms(), 10, rounding);
}

// --- Slopes and brackets: times of a renderer that takes what each test says, first 20 ms for all detail.

struct Sloped : Driven<SafeguardedLaw> {
    explicit Sloped(const SafeguardedConstants& constants = {}) : Driven(sought_ms, constants) {
        answer(2 * sought_ms, 2);
    }
    double detail() const { return law.memory().detail; }
    double slope() const { return law.memory().slope; }
};

TEST(SafeguardedSlope, AStraightLineIsKnownFromOneStepOn) {
    for (const double fixed : {2.0, 4.0, 6.0}) {  // [ms] at no detail
        const auto line = [=](double detail) { return fixed + (2 * sought_ms - fixed) * detail; };
        Sloped run;
        const double first = line(run.detail());
        run.answer(first, 2);
        EXPECT_NEAR(run.slope(), (2 * sought_ms - fixed) / first, rounding);
        EXPECT_NEAR(line(run.detail()), std::exp(run.law.memory().aim), rounding) << fixed;
    }
}

TEST(SafeguardedSlope, ADifferenceIsOneBeyondTheErrorsOfBothItsEnds) {
    SafeguardedConstants constants;
    constants.trust = 6;
    constants.outlier = 20;
    const double error = Sloped(constants).law.memory().noise / std::sqrt(2);  // of the mean of two times
    for (const double errors : {1.2, 1.7}) {                                   // at one end; at both they are 1.41
        const double change = errors * constants.trust * error + constants.dead_band;
        Sloped run(constants);
        const double moved = 1 - run.detail();
        run.answer(2 * sought_ms * std::exp(-change), 2);
        const double measured = (std::exp(change) - 1) / moved;
        if (errors < std::sqrt(2)) {
            EXPECT_LT(run.slope(), 0.8 * measured) << "it may be no slope at all";
        } else {
            EXPECT_NEAR(run.slope(), measured, rounding);
        }
    }
}

// From a line that falls from 20 ms by 12 ms a detail.
TEST(SafeguardedSlope, IsRevisedAsFarAsADifferenceIsBeyondDoubtAndThreefoldAtMost) {
    SafeguardedConstants constants;
    constants.dead_band = 0.2;
    constants.headroom = 0;
    constexpr double before_ms = 14, fall = 12, line = fall / sought_ms;  // where the line leads, it meets the target
    const auto at_the_lines_end = [&] {
        Sloped run(constants);
        EXPECT_NEAR(run.detail(), 0.5, rounding);
        run.answer(before_ms, 2);
        EXPECT_NEAR(run.detail(), 1 - (2 * sought_ms - sought_ms) / fall, rounding);
        return run;
    };
    Sloped hardly = at_the_lines_end();
    const double moved = 0.5 - hardly.detail(), change = 1.5 * constants.dead_band;
    hardly.answer(before_ms * std::exp(-change), constants.settled);
    const double measured = (std::exp(change) - 1) / moved;
    EXPECT_LT(std::abs(hardly.slope() - line), std::abs(hardly.slope() - measured)) << "little of it is beyond doubt";
    EXPECT_NE(hardly.slope(), line) << "but some";

    Sloped clearly = at_the_lines_end();
    clearly.answer(before_ms / 4, 2);
    EXPECT_GT(clearly.slope(), line);
    EXPECT_LE(clearly.slope(), 3 * line + rounding);
}

TEST(SafeguardedBracket, IsForgottenWhereAnEndWasOfAnotherScene) {
    Sloped faster;
    faster.answer(9, 2);
    ASSERT_TRUE(faster.law.memory().fast_end.is_known && faster.law.memory().slow_end.is_known);
    faster.answer(12, 2);
    ASSERT_TRUE(faster.law.memory().fast_end.is_known && faster.law.memory().slow_end.is_known);
    ASSERT_GT(faster.detail(), faster.law.memory().fast_end.detail);
    faster.answer(8, 2);  // finer than what took 9 ms
    EXPECT_TRUE(faster.law.memory().fast_end.is_known);
    EXPECT_FALSE(faster.law.memory().slow_end.is_known);

    Sloped slower;
    slower.answer(9, 2);
    ASSERT_LT(slower.detail(), 1);
    slower.answer(22, 2);  // coarser than what took 20 ms
    EXPECT_TRUE(slower.law.memory().slow_end.is_known);
    EXPECT_FALSE(slower.law.memory().fast_end.is_known);
}

TEST(SafeguardedMemory, ASearchBeginsAtTheLastSlowTimeAfterAFastOne) {
    Sloped run;
    ASSERT_EQ(run.law.memory().top.detail, 1);
    run.answer(9, 2);
    const double finer = run.detail();
    run.answer(12, 2);
    EXPECT_EQ(run.law.memory().top.detail, finer);
    EXPECT_NEAR(run.law.memory().top.level, std::log(12), rounding);
}

TEST(SafeguardedMemory, ANewTargetsSearchBeginsAnew) {
    Sloped run;
    run.answer(11);
    ASSERT_TRUE(run.law.memory().top.is_known);
    run.retarget(2 * sought_ms);
    EXPECT_FALSE(run.law.memory().top.is_known);
}

// What was found where detail bought nothing is not held against it once it does.
TEST(SafeguardedMemory, NothingIsLeftOfASearchInVain) {
    Driven<SafeguardedLaw> run(sought_ms);
    run.answer(1.5 * sought_ms, 2);
    for (int i = 0; i < 200 && run.decision != Decision{}; ++i) run.answer(1.5 * sought_ms);
    ASSERT_TRUE(run.law.memory().is_held);
    const SafeguardedMemory& left = run.law.memory();
    for (const auto& cost : {left.before, left.top, left.fast_end, left.slow_end}) EXPECT_FALSE(cost.is_known);
}

TEST(SafeguardedMemory, ASmallStepsBeginningIsForgottenAfterAQuietTime) {
    SafeguardedConstants constants;
    constants.dead_band = 0.03;
    constants.trust = 6;
    constants.outlier = 20;
    Sloped run(constants);
    run.answer(11.8, 2);
    run.answer(10.2, constants.settled);
    EXPECT_TRUE(run.law.memory().before.is_known) << "too small a step to tell a slope from noise";
    run.answer(10.2, 2);
    EXPECT_FALSE(run.law.memory().before.is_known);
}

// --- Searches.

// Bound elsewhere from frame 300 on, but for a last part that detail still buys.
TEST(SafeguardedSearch, DetailIsGivenUpForItsPriceAndNoLess) {
    for (const double sought : {0.5, 1.0}) {
        for (const double gain : {0.6, 1.6}) {  // of what is asked of all detail: 5 % of the time
            const double bought = gain * SafeguardedConstants{}.no_gain * sought;
            const Time time = [=](std::int64_t frame, const Decision& d) {
                const double detail = detail_of(d, test_range);
                if (frame < 300) return sought_ms * (0.2 + 0.8 * detail / sought);
                return 1.4 * sought_ms * (1 - bought * (1 - std::min(detail / sought, 1.0)));
            };
            SafeguardedLaw law;
            const auto rows = run(law, {time, constant(1.001 * sought_ms), 900, 0});
            const double kept = detail_of(rows.back().decision, test_range);
            EXPECT_NEAR(kept, gain < 1 ? sought : 0, 0.01) << "sought " << sought << ", gain " << gain;
        }
    }
}

TEST(SafeguardedSearch, InVainItIsRepeatedAfterLongerAndLongerHolds) {
    const SafeguardedConstants constants = quick();
    Driven<SafeguardedLaw> run(sought_ms, constants);
    int hold = constants.hold;
    for (int search = 0; search < 5; ++search) {
        int times = 0;
        for (; run.decision == Decision{} && times < 4 * constants.longest_wait; ++times) run.answer(1.5 * sought_ms);
        if (search > 0) {
            EXPECT_GE(times, hold);
            EXPECT_LE(times, hold + prompt);
            hold = std::min(2 * hold, constants.longest_wait);
        }
        for (int i = 0; i < 200 && run.decision != Decision{}; ++i) run.answer(1.5 * sought_ms);
        ASSERT_EQ(run.decision, Decision{}) << "all of it comes back";
    }
}

}  // namespace
}  // namespace sfsm
