// What the paper's law counts and remembers from one time to the next, and what makes it forget: each shown by driving
// it by hand from state to state.
#include <gtest/gtest.h>

#include "sfsm/paper.h"
#include "tests/sfsm/driven.h"

namespace sfsm {
namespace {

constexpr PaperConstants constants;
constexpr double target = 300, far_too_slow = 900, far_too_fast = 30;  // [ms]
constexpr double just_fast = 0.97 * target;                            // but inside the return margin

using Drive = Driven<PaperLaw>;

// State 2 at the smallest splats, which all times say is where to be: triangles are far too slow.
Drive in_points() {
    Drive run(target);
    run.answer(far_too_slow, 3);  // D = L, 5/6 L, points
    EXPECT_EQ(run.decision.state, State::points);
    run.answer(just_fast, 20);  // S down to its smallest
    EXPECT_EQ(run.decision.splat_size, constants.tau);
    return run;
}

// Back to triangles, which are too slow again after so many times: the last of them is the slow one.
void return_for(Drive& run, int times) {
    run.leave_state(far_too_fast);
    ASSERT_EQ(run.decision.state, State::slowed);
    run.answer(target, times - 1);  // stays
    ASSERT_EQ(run.answer(far_too_slow).state, State::points);
}

TEST(PaperPatience, EachFailedReturnDoublesItUpToItsMost) {
    Drive run = in_points();
    for (const int patience : {3, 6, 12, 24, 48, 96, 128, 128}) {
        EXPECT_EQ(run.leave_state(far_too_fast), patience);
        ASSERT_EQ(run.answer(far_too_slow).state, State::points) << "after a patience of " << patience;
    }
}

TEST(PaperPatience, AReturnThatLastsItsTrialHasNotFailed) {
    for (const int times : {1, 2, constants.trial - 1, constants.trial, constants.trial + 1, 100}) {
        Drive run = in_points();
        return_for(run, 1);
        return_for(run, times);
        EXPECT_EQ(run.leave_state(far_too_fast), times < constants.trial ? 12 : constants.first_patience) << times;
    }
}

TEST(PaperPatience, TheTrialBeginsWithEachReturn) {
    Drive run = in_points();
    return_for(run, constants.trial - 1);
    return_for(run, constants.trial - 1);  // failed too, although both have lasted longer together
    EXPECT_EQ(run.leave_state(far_too_fast), 4 * constants.first_patience);
}

TEST(PaperPatience, AReturnToTheWholePictureForgetsThoseThatFailed) {
    Drive run = in_points();
    for (int i = 0; i < 4; ++i) return_for(run, 1);
    run.leave_state(far_too_fast);
    const int times = run.leave_state(far_too_fast);
    ASSERT_EQ(run.decision, Decision{});
    ASSERT_LT(times, constants.trial) << "or it would be the trial that it has passed";
    run.answer(far_too_fast, 100);  // what counts is the time in state 1
    run.answer(far_too_slow, 3);
    ASSERT_EQ(run.decision.state, State::points);
    EXPECT_EQ(run.leave_state(far_too_fast), 2 * constants.first_patience) << "one more that has failed";
}

TEST(PaperPatience, OnlyTimesInARowCount) {
    Drive run = in_points();
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(run.answer(far_too_fast, constants.first_patience - 1).state, State::points) << i;
        EXPECT_EQ(run.answer(just_fast).state, State::points) << "fast, but not enough";
    }
    EXPECT_EQ(run.leave_state(far_too_fast), constants.first_patience);

    Drive whole(target);
    whole.answer(1.01 * target);  // state 1, D = L
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(whole.answer(far_too_fast, constants.first_patience - 1).state, State::slowed) << i;
        EXPECT_EQ(whole.answer(just_fast).state, State::slowed);
    }
    EXPECT_EQ(whole.leave_state(far_too_fast), constants.first_patience);
    EXPECT_EQ(whole.decision, Decision{});
}

// Where L is short, the way back from points leads to D = L at once: the times that opened it are not counted again.
TEST(PaperPatience, BeginsAnewInEveryState) {
    Drive run = in_points();
    run.reach(40);
    run.leave_state(far_too_fast);
    ASSERT_EQ(run.decision, (Decision{State::slowed, 40, 0}));
    EXPECT_GE(run.leave_state(far_too_fast), constants.first_patience);
}

TEST(PaperEpisodes, EachBeginsWithTheWholeRangeAndFiveSixths) {
    Drive run(target);
    for (int episode = 0; episode < 3; ++episode) {
        EXPECT_EQ(run.answer(1.2 * target), (Decision{State::slowed, test_range, 0})) << episode;
        EXPECT_EQ(run.answer(1.15 * target), (Decision{State::slowed, 5.0 / 6 * test_range, 0})) << episode;
        run.leave_state(far_too_fast);
        ASSERT_EQ(run.decision, Decision{});
    }
}

TEST(PaperEpisodes, AfterAReturnDRisesByItsLeastStepFirst) {
    for (const double range : {test_range, 5 * test_range}) {  // far from the distances of before
        Drive run = in_points();
        run.reach(range);
        run.leave_state(far_too_fast);
        const double first = 2.0 / 3 * range + constants.h;
        ASSERT_EQ(run.decision.motion_distance, first);
        EXPECT_EQ(run.answer(far_too_fast).motion_distance, first + constants.h) << "one time has no slope";
    }
}

// Eq. 4 past 2/3 L: D goes on where the secant leads, and S begins.
TEST(PaperEpisodes, PointsKeepTheDistanceThatLedToThem) {
    Drive run(134);
    run.answer(200);  // D = L
    run.answer(200);  // 5/6 L
    EXPECT_EQ(run.answer(170).state, State::points);
    const double slope = 30 / (test_range / 6);  // [ms/m]
    EXPECT_NEAR(run.decision.motion_distance, 5.0 / 6 * test_range - 36 / slope, 1e-9);
    EXPECT_EQ(run.decision.splat_size, constants.tau);
}

TEST(PaperEpisodes, WhoIsNearestAlwaysMoves) {
    Drive run(100);
    run.answer(200);
    run.answer(200);
    run.answer(190);  // the secant leads below 0
    EXPECT_EQ(run.decision.state, State::points);
    EXPECT_DOUBLE_EQ(run.decision.motion_distance, test_range / 6);
    EXPECT_DOUBLE_EQ(run.reach(30).motion_distance, 5) << "of the range there is now";
}

TEST(PaperTarget, ANewOneIsNotJudgedByATimeOfAnOlderDecision) {
    Drive run(target);
    const Decision whole = run.answer(far_too_slow);
    ASSERT_EQ(whole, (Decision{State::slowed, test_range, 0}));
    EXPECT_EQ(run.retarget(200), whole) << "no time has answered D = L";
    EXPECT_NE(run.answer(far_too_slow), whole);
}

// Whatever L has become in between, a fast frame never makes D shorter.
TEST(PaperEpisodes, AFastTimeNeverCutsTheMotionOfAGrowingRange) {
    Drive run(target);
    run.reach(100);
    run.answer(1.01 * target);  // state 1, D = L
    run.law.observe({0, just_fast, run.decision, {}});
    EXPECT_EQ(run.reach(300), (Decision{State::slowed, 300, 0}));
}

}  // namespace
}  // namespace sfsm
