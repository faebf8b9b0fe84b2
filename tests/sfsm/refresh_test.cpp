// Times that a display rounds up to whole refreshes: told from others, and how the model is led to what they hide.
#include "sfsm/refresh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sfsm {
namespace {

constexpr double target = 16;  // [ms], a refresh
constexpr int convincing = 4;  // whole times in a row
// Of ln gain, as refresh.cpp has it: a frame in time before and after one has been late, and a late one.
constexpr double fast = 2e-3, slow = 4e-5, first_late = 0.03, late = 49 * slow;
constexpr double rounding = 1e-9;

const Amounts work{{1, 1}, 2};

// Knows well that the work takes so long.
CostModel knowing(double ms) {
    CostModel model({2, {1, 1}, 0, {}});
    for (int i = 0; i < 300; ++i) model.observe(work, ms);
    return model;
}

double predicted(const CostModel& model) {
    return std::exp(model.predict(work).log_ms);
}

// The change of ln gain that one time makes.
double gained(Refresh& refresh, CostModel& model, double ms, double target_ms = target) {
    const double before = std::log(model.gain());
    refresh.observe(model, work, ms, target_ms);
    return std::log(model.gain()) - before;
}

// Both after so many whole times that the last of them is taken for a rounded one.
struct Rounded {
    explicit Rounded(double predicted_ms) : model(knowing(predicted_ms)) {
        for (int i = 1; i < convincing; ++i) gained(refresh, model, target);
        model = knowing(predicted_ms);  // what it heard meanwhile is not of interest
    }
    CostModel model;
    Refresh refresh;
};

TEST(Refresh, TimesThatAreNotWholeAreHeardAsTheyAre) {
    const std::vector<double> courses[] = {{10, 10, 10, 10, 10, 10},
                                           {16, 16, 16, 15.9, 16, 16, 16, 15.9, 16, 16, 16},  // never four in a row
                                           {16.001, 16.001, 16.001, 16.001, 16.001},          // not to six digits
                                           {144, 144, 144, 144, 144, 144},  // nine refreshes are a pause
                                           {8, 8, 8, 8, 8, 8},              // half a one
                                           {5.3, 5.3, 5.3, 5.3, 5.3, 5.3}};
    for (const std::vector<double>& course : courses) {
        CostModel heard = knowing(10), told = knowing(10);
        Refresh refresh;
        for (const double ms : course) {
            heard.observe(work, ms);
            refresh.observe(told, work, ms, target);
            ASSERT_EQ(told.predict(work).log_ms, heard.predict(work).log_ms) << "from " << course[0];
        }
    }
}

TEST(Refresh, WithoutATargetEverythingIsHeardAsItIs) {
    CostModel heard = knowing(10), told = knowing(10);
    Refresh refresh;
    for (int i = 0; i < 20; ++i) {
        heard.observe(work, target);
        refresh.observe(told, work, target, 0);
        ASSERT_EQ(told.gain(), heard.gain());
    }
}

// The model thinks that there is time to spare, and the display doesn't say otherwise.
TEST(Refresh, WhileFramesAreInTimeTheGainIsLetDown) {
    Rounded run(10);
    for (int i = 0; i < 50; ++i) EXPECT_NEAR(gained(run.refresh, run.model, target), -fast, rounding) << i;
    EXPECT_NEAR(predicted(run.model), 10 * std::exp(-50 * fast), 0.01);
}

TEST(Refresh, ALateFrameTakesBackSomeAndSlowsTheRest) {
    Rounded run(15);
    EXPECT_NEAR(gained(run.refresh, run.model, 2 * target), first_late, rounding);
    EXPECT_NEAR(gained(run.refresh, run.model, target), -slow, rounding);
    EXPECT_NEAR(gained(run.refresh, run.model, 2 * target), late, rounding) << "the second one, soon after";
    for (int i = 0; i < 250; ++i) ASSERT_NEAR(gained(run.refresh, run.model, target), -slow, rounding) << i;
    EXPECT_NEAR(gained(run.refresh, run.model, target), -fast, rounding) << "long ago by now";
}

TEST(Refresh, ATwoPerCentShareOfLateFramesIsWhereItRests) {
    EXPECT_NEAR(late / slow, 49, rounding) << "in time for each that is late";
}

TEST(Refresh, AnotherTargetIsFarFromItsRefreshAgain) {
    Rounded run(15);
    gained(run.refresh, run.model, 2 * target);
    ASSERT_NEAR(gained(run.refresh, run.model, target), -slow, rounding);
    EXPECT_NEAR(gained(run.refresh, run.model, 2 * target, 2 * target), -fast, rounding);
}

TEST(Refresh, ManyLateFramesInARowAreBelieved) {
    Rounded run(15);
    double before = predicted(run.model);
    for (int i = 0; i < 12; ++i) gained(run.refresh, run.model, 2 * target);
    EXPECT_GT(predicted(run.model), 1.2 * before) << "two refreshes is what they take";

    Rounded now_and_then(15);
    before = predicted(now_and_then.model);
    for (int i = 0; i < 24; ++i) gained(now_and_then.refresh, now_and_then.model, i % 2 == 0 ? 2 * target : target);
    EXPECT_NEAR(predicted(now_and_then.model), before * std::exp(first_late + 11 * late - 12 * slow), 0.01)
        << "by chance: nothing but the drift";
}

// Between two refreshes a prediction may be right: it is kept.
TEST(Refresh, PredictionsBetweenTheRefreshesAreKept) {
    for (const double ms : {18.0, 25.0, 33.0}) {
        CostModel model = knowing(ms);
        Refresh refresh;
        for (int i = 1; i < convincing; ++i) gained(refresh, model, 2 * target);
        model = knowing(ms);
        for (int i = 0; i < 20; ++i) EXPECT_NEAR(gained(refresh, model, 2 * target), 0, rounding) << ms;
    }
}

// Far above the refresh that a frame has met, a prediction is wrong.
TEST(Refresh, PredictionsOverTheRefreshThatWasMetAreCorrected) {
    Rounded run(24);
    for (int i = 0; i < 20; ++i) gained(run.refresh, run.model, target);
    EXPECT_LT(predicted(run.model), 1.06 * target);
}

}  // namespace
}  // namespace sfsm
