// Times that a display rounds up to whole refreshes: told from others, and how the model is led to what they hide.
#include "sfsm/refresh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sfsm {
namespace {

constexpr double target = 16;  // [ms], a refresh
constexpr int convincing = 4;  // whole times in a row
// Of ln gain, as refresh.cpp has it: a frame in time when the last late one is long ago and when it isn't.
constexpr double fast = 1e-2, slow = 4e-5;
constexpr double late_per_in_time = 60;  // 1.6 % are late where the two are in balance
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
    refresh.observe(model, work, {ms, ms}, target_ms);
    return std::log(model.gain()) - before;
}

// Both after so many whole times that they are taken for rounded ones.
struct Rounded {
    explicit Rounded(double predicted_ms) : model(knowing(predicted_ms)) {
        for (int i = 0; i < convincing; ++i) gained(refresh, model, target);
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
            refresh.observe(told, work, {ms, ms}, target);
            ASSERT_EQ(told.predict(work).log_ms, heard.predict(work).log_ms) << "from " << course[0];
        }
    }
}

TEST(Refresh, WithoutATargetEverythingIsHeardAsItIs) {
    CostModel heard = knowing(10), told = knowing(10);
    Refresh refresh;
    for (int i = 0; i < 20; ++i) {
        heard.observe(work, target);
        refresh.observe(told, work, {target, target}, 0);
        ASSERT_EQ(told.gain(), heard.gain());
    }
}

// The model thinks that there is time to spare, and the display doesn't say otherwise.
TEST(Refresh, WhileFramesAreInTimeTheGainIsLetDownFasterAndFaster) {
    Rounded run(15);
    double before = 0;
    for (int i = 0; i < 30; ++i) {
        const double step = -gained(run.refresh, run.model, target);
        EXPECT_GE(step, before - rounding) << i;
        before = step;
    }
    EXPECT_NEAR(before, fast, rounding);
}

// Else the gain would vanish while a light load takes all detail, and a heavy one would come as a shock.
TEST(Refresh, TheGainIsNotLetDownBelowWhatAllDetailMayTake) {
    Rounded run(15);
    for (int i = 0; i < 2000; ++i) gained(run.refresh, run.model, target);
    EXPECT_GT(predicted(run.model), 0.55 * target);
}

TEST(Refresh, ALateFrameTakesBackSomeAndSlowsTheRest) {
    Rounded run(15);
    for (int i = 0; i < 10; ++i) gained(run.refresh, run.model, target);
    EXPECT_GT(gained(run.refresh, run.model, 2 * target), 0.02);
    const double drift = -gained(run.refresh, run.model, target);
    EXPECT_GT(drift, 0);
    EXPECT_LT(drift, 10 * slow);
    for (int i = 0; i < 79; ++i) ASSERT_LT(-gained(run.refresh, run.model, target), 10 * slow) << i;
    for (int i = 0; i < 100; ++i) gained(run.refresh, run.model, target);
    EXPECT_NEAR(gained(run.refresh, run.model, target), -fast, rounding) << "long ago by now";
}

TEST(Refresh, ATwoPerCentShareOfLateFramesIsWhereItRests) {
    Rounded run(15.5);
    gained(run.refresh, run.model, 2 * target);
    for (int i = 0; i < 12; ++i) {
        const double before = std::log(run.model.gain());
        double late = 0;
        for (int k = 0; k < late_per_in_time; ++k) gained(run.refresh, run.model, target);
        late = gained(run.refresh, run.model, 2 * target);
        EXPECT_GT(late, 0);
        EXPECT_NEAR(std::log(run.model.gain()), before, 5 * slow * late_per_in_time) << "round " << i;
    }
}

TEST(Refresh, ManyLateFramesInARowAreBelieved) {
    Rounded run(15);
    double before = predicted(run.model);
    for (int i = 0; i < 12; ++i) gained(run.refresh, run.model, 2 * target);
    EXPECT_GT(predicted(run.model), 1.2 * before) << "two refreshes is what they take";

    Rounded now_and_then(15);
    before = predicted(now_and_then.model);
    for (int i = 0; i < 12; ++i) gained(now_and_then.refresh, now_and_then.model, i % 2 == 0 ? 2 * target : target);
    EXPECT_LT(predicted(now_and_then.model), 1.15 * before) << "by chance: nothing but the drift";
}

// Prices that were learned while nothing that was drawn made a difference say that all is free.
TEST(Refresh, PricesAreForgottenWhenTimesDidNotFollowTheWork) {
    CostModel model({2, {1, 1}, 0, {}});
    Refresh refresh;
    for (int i = 0; i < 80 && !refresh.is_waiting(); ++i) {
        const double ms = i % 2 == 0 ? target : 1.001 * target;
        refresh.observe(model, {{1, i % 8 < 4 ? 1.0 : 0.5}, 2}, {ms, ms}, 0.9 * target);
    }
    ASSERT_TRUE(refresh.is_waiting());
    EXPECT_NEAR(refresh.due_ms(0.9 * target), target, 0.01 * target);
    EXPECT_GT(model.price(1), 0.3 * model.price(0));
}

// What a step from one refresh to the next has taught is no price.
TEST(Refresh, PricesAreForgottenWhenTimesWereWhole) {
    CostModel model({2, {1, 1}, 1, {}});
    Refresh refresh;
    const auto observe = [&](int i) {
        refresh.observe(model, {{1, i % 2 == 0 ? 0.9 : 1.0}, 2},
                        {i % 2 == 0 ? target : 2 * target, i % 2 == 0 ? target : 2 * target}, target);
    };
    int i = 0;
    for (; i < convincing - 1; ++i) observe(i);
    EXPECT_GT(model.price(1), 2 * model.price(0));
    observe(i);
    ASSERT_TRUE(refresh.is_waiting());
    EXPECT_NEAR(model.price(1), model.price(0), 0.01 * model.price(0));
}

// Times far above a cap are the work's, and what is learned of them is what was learned without one.
TEST(Refresh, WellAboveACapTimesAreHeardAsTheyAre) {
    CostModel model({2, {1, 1}, 0, {}});
    Refresh refresh;
    const auto observe = [&](double amount, double ms) {
        refresh.observe(model, {{1, amount}, 2}, {ms, ms}, 0.9 * target);
    };
    for (int i = 0; i < 80 && !refresh.is_waiting(); ++i) observe(i % 8 < 4 ? 1.0 : 0.5, target);
    ASSERT_TRUE(refresh.is_waiting());
    for (int i = 0; i < 20; ++i) observe(1, 1.37 * target);
    EXPECT_NEAR(std::exp(model.predict({{1, 1}, 2}).log_ms), 1.37 * target, 0.02 * target);
}

// Between two refreshes a prediction may be right: it is kept.
TEST(Refresh, PredictionsBetweenTheRefreshesAreKept) {
    for (const double ms : {18.0, 25.0, 33.0}) {
        CostModel model = knowing(ms);
        Refresh refresh;
        for (int i = 0; i < convincing; ++i) gained(refresh, model, 2 * target);
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
