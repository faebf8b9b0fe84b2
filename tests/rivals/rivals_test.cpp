// Each rival's first response, computed by hand from its published facts.
#include "sfsm/rivals/rivals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "sfsm/detail.h"
#include "sfsm/rivals/offline_table.h"

namespace sfsm {
namespace {

constexpr double target = 20;    // [ms]
constexpr double range = 200;    // [m]
constexpr double exact = 1e-12;  // of details that go through a decision and back

// A rival that sees each time before the next decision.
struct Driven {
    explicit Driven(std::string_view name) : Driven(make_rival(name)) {}
    explicit Driven(std::unique_ptr<Controller> made) : law(std::move(made)) {
        decision = law->decide({target, range});
    }

    std::unique_ptr<Controller> law;
    Decision decision;

    double detail() const { return detail_of(decision, range); }

    // The detail after `times` times of `load` targets.
    double after(int times, double load) {
        for (int i = 0; i < times; ++i) {
            law->observe({0, load * target, decision, {}});
            decision = law->decide({target, range});
        }
        return detail();
    }
};

TEST(Rivals, AnUnknownNameIsAnsweredWithTheNamesThereAre) {
    try {
        make_rival("paper");
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("'paper'"), std::string::npos) << message;
        for (const std::string_view name : rival_names()) EXPECT_NE(message.find(name), std::string::npos) << message;
    }
}

TEST(Rivals, NeverGoBelowTheirLeastDetail) {
    for (const std::string_view name : rival_names()) {
        const double least = Driven(name).after(5000, 50);
        EXPECT_NEAR(least, 0.05, 1e-3) << name;
    }
}

TEST(Filament, DividesByItsOutputWhenSlow) {
    Driven filament("filament");
    const double error = 1 - 2.0;
    const double output = (1 - std::exp(-1.0 / 8)) * error + 0.002 * error;
    EXPECT_NEAR(filament.after(1, 2), 1 / (1 - output), 1e-7);
}

TEST(Filament, HasADeadBand) {
    EXPECT_EQ(Driven("filament").after(1, 1.05), 1) << "0.12 * 0.05 is under 0.01";
    EXPECT_LT(Driven("filament").after(1, 1.1), 1);
}

TEST(Intel, TakesAHundredthOfTheErrorOffTheScale) {
    const double scale = 1 - 0.01 * 0.5;
    EXPECT_NEAR(Driven("intel").after(1, 1.5), scale * scale, exact);
}

TEST(DarkPlaces, StepsInProportionAndTaxesRises) {
    Driven darkplaces("darkplaces");
    EXPECT_NEAR(darkplaces.after(1, 1.25), 1 - 0.2 * 0.2, exact);
    EXPECT_NEAR(darkplaces.after(1, 0.8), 0.96, exact) << "0.2 * 0.25 is no more than the tax";
    EXPECT_NEAR(darkplaces.after(1, 0.5), 0.96 * (1 + 0.2 - 0.05), exact + 0.11) << "at most 0.1";
    EXPECT_LE(darkplaces.detail(), 1);
}

TEST(Minetest, MovesFiveTimesASecondByHalfTheSecant) {
    Driven minetest("minetest");
    EXPECT_EQ(minetest.after(4, 2), 1) << "160 ms have passed";
    EXPECT_NEAR(minetest.after(1, 2), (240 - 0.5 * 20 / 0.5) / 240, exact) << "at the least slope, 0.5 ms a node";
    EXPECT_NEAR(minetest.after(8, 1.3), 220.0 / 240, exact) << "within a third";
}

TEST(UnrealLike, PanicsAfterTwoFramesOverBudget) {
    Driven unreal("unreal-like");
    EXPECT_EQ(unreal.after(1, 1.5), 1);
    EXPECT_NEAR(unreal.after(1, 1.5), 0.9 / 1.5, exact);
}

TEST(UnrealLike, ChangesEveryEighthFrameAtMost) {
    Driven unreal("unreal-like");
    unreal.after(2, 3);  // 0.3
    EXPECT_NEAR(unreal.after(7, 0.6), 0.3, exact);
    EXPECT_NEAR(unreal.after(1, 0.6), 0.3 + 0.9 * 0.3 * (0.9 / 0.6 - 1), exact);
}

TEST(Valve, DropsTwoLevelsAfterThreeFrames) {
    Driven valve("valve");
    EXPECT_EQ(valve.after(2, 0.95), 1);
    EXPECT_NEAR(valve.after(1, 0.95), 1 / (1.15 * 1.15), exact);
    EXPECT_NEAR(valve.after(4, 0.6), 1 / (1.15 * 1.15), exact);
    EXPECT_NEAR(valve.after(1, 0.6), 1 / 1.15, exact) << "one up after five";
}

TEST(Valve, ForeseesAMiss) {
    Driven valve("valve");
    valve.after(3, 0.8);
    EXPECT_NEAR(valve.after(1, 0.86), 1 / (1.15 * 1.15), exact) << "0.86 + 0.06 is over 0.9";
}

TEST(UnitySample, FallsByTheMissAndRisesAfterQuiet) {
    Driven unity("unity-sample");
    EXPECT_NEAR(unity.after(1, 1.25), 0.75, exact);
    EXPECT_NEAR(unity.after(1, 0.7), 0.75, exact);    // falling: 10
    EXPECT_NEAR(unity.after(116, 0.7), 0.75, exact);  // quiet: 3 each, 358
    EXPECT_NEAR(unity.after(1, 0.7), 0.75 + 0.035 * (0.25 + 0.75 * 0.5), exact);
}

TEST(Hdrp, FallsByHalfItsRangeAfterFourBadGroups) {
    Driven hdrp("hdrp");
    EXPECT_EQ(hdrp.after(59, 1.5), 1);
    EXPECT_NEAR(hdrp.after(1, 1.5), 1 - 0.95 / 2, exact);
    EXPECT_NEAR(hdrp.after(119, 0.5), 0.525, exact);
    EXPECT_NEAR(hdrp.after(1, 0.5), 0.525 + 0.95 / 5, exact);
}

TEST(UnityAdaptive, LowersFastAfterFourSeconds) {
    Driven adaptive("unity-adaptive");
    EXPECT_EQ(adaptive.after(99, 2), 1) << "3.96 s";
    EXPECT_NEAR(adaptive.after(1, 2), 0.9, exact);
    EXPECT_NEAR(Driven("unity-adaptive").after(416, 1.2), 1, exact) << "10 s where it is less slow";
    EXPECT_NEAR(Driven("unity-adaptive").after(417, 1.2), 0.9, exact);
}

TEST(SecondLife, ComesTenMetresNearerAtOnceAndBackAfterThreePeriods) {
    constexpr double step = 10.0 / 256;
    Driven life("second-life");
    EXPECT_EQ(life.after(49, 1.2), 1);
    EXPECT_NEAR(life.after(1, 1.2), 1 - step, exact);
    EXPECT_NEAR(life.after(149, 0.8), 1 - step, exact);
    EXPECT_EQ(life.after(1, 0.8), 1);
    EXPECT_NEAR(Driven("second-life").after(5000, 0.97), 1, exact) << "too little to spare for anything";
}

TEST(Woof, TakesAStepForEachRatioExceeded) {
    const double goal = (target - 1.25) / target;
    EXPECT_EQ(Driven("woof").after(14, 2), 1);
    EXPECT_NEAR(Driven("woof").after(15, 1.1 * goal), 0.95, exact);
    EXPECT_NEAR(Driven("woof").after(15, 1.3 * goal), 0.90, exact);
    EXPECT_NEAR(Driven("woof").after(15, 1.6 * goal), 0.85, exact);
}

TEST(Drei, VotesOverTenWindows) {
    Driven drei("drei");
    EXPECT_NEAR(drei.detail(), 0.5, exact);
    EXPECT_NEAR(drei.after(69, 2), 0.5, exact) << "windows of 7 frames at 40 ms";
    EXPECT_NEAR(drei.after(1, 2), 0.4, exact);
    EXPECT_NEAR(drei.after(260, 0.5), 0.5, exact) << "windows of 25 frames at 10 ms";
}

TEST(RobustMpc, DividesByTheWorstErrorOfItsForecasts) {
    Driven mpc("robust-mpc");
    EXPECT_NEAR(mpc.after(1, 2), 0.5, exact);
    mpc.law->observe({0, 1.5 * target, mpc.decision, {}});  // half of the detail at 1.5 targets: 3 for all of it
    mpc.decision = mpc.law->decide({target, range});
    EXPECT_NEAR(mpc.detail(), 1 / (2.5 * (1 + 0.5)), exact) << "mean cost 2.5; 3 was taken for 2";
}

// --- What each counts is begun anew.

TEST(Filament, WhatCannotRiseAnyFurtherIsNotSummedUp) {
    Driven filament("filament");
    EXPECT_EQ(filament.after(1000, 0.5), 1);
    EXPECT_LT(filament.after(9, 2), 1) << "slow is the median of 15 times from the eighth on";
}

TEST(Hdrp, RisesAfterEightGoodGroupsInARow) {
    Driven hdrp("hdrp");
    const double low = hdrp.after(60, 1.5);
    hdrp.after(7 * 15, 0.5);
    hdrp.after(15, 1.5);
    EXPECT_EQ(hdrp.after(7 * 15, 0.5), low);
    EXPECT_GT(hdrp.after(15, 0.5), low);
}

TEST(Minetest, KnowsNoSlopeFromOnePeriod) {
    constexpr double nodes = 240, least_slope = 0.5;  // [ms per node]
    const double spare_ms = target - 10 * target;
    EXPECT_NEAR(Driven("minetest").after(1, 10), 1 + 0.5 * spare_ms / least_slope / nodes, exact);
}

TEST(SecondLife, PeriodsToSpareAreInARowAndCountedOnce) {
    constexpr double step = 10.0 / 256;
    Driven life("second-life");
    EXPECT_NEAR(life.after(100, 1.2), 1 - 2 * step, exact);
    life.after(100, 0.8);
    life.after(50, 0.98);
    EXPECT_NEAR(life.after(149, 0.8), 1 - 2 * step, exact);
    EXPECT_NEAR(life.after(1, 0.8), 1 - step, exact);
    EXPECT_NEAR(life.after(149, 0.8), 1 - step, exact);
    EXPECT_NEAR(life.after(1, 0.8), 1, exact);
}

TEST(UnityAdaptive, WaitsFourSecondsForEachStep) {
    Driven adaptive("unity-adaptive");
    for (int i = 1; i < 4; ++i) {
        adaptive.after(99, 2);
        EXPECT_NEAR(adaptive.detail(), 1.1 - 0.1 * i, exact);
        EXPECT_NEAR(adaptive.after(1, 2), 1 - 0.1 * i, exact);
    }
}

TEST(UnitySample, CountsAnewAfterAFall) {
    Driven unity("unity-sample");
    unity.after(1, 1.25);
    unity.after(117, 0.7);  // 358 of 360
    EXPECT_NEAR(unity.after(1, 1.1), 0.65, exact);
    EXPECT_NEAR(unity.after(100, 0.7), 0.65, exact);
}

TEST(UnitySample, FallsByAGrowthThatWouldUseUpWhatIsSpare) {
    Driven unity("unity-sample");
    EXPECT_EQ(unity.after(1, 0.6), 1);
    EXPECT_NEAR(unity.after(1, 0.85), 1 - (0.85 - 0.6), exact);
}

TEST(UnrealLike, TwoFramesOverBudgetWithOneBetweenThemAreNoPanic) {
    Driven unreal("unreal-like");
    for (const double load : {1.2, 0.8, 1.2}) EXPECT_EQ(unreal.after(1, load), 1);
    EXPECT_LT(unreal.after(1, 1.2), 1);
}

TEST(Valve, LooksTwoFramesBackOnlyAfterFive) {
    for (const int quiet : {1, 2}) {
        Driven valve("valve");
        valve.after(quiet, 0.76);
        for (const double load : {0.76, 0.845}) valve.after(1, load);
        ASSERT_EQ(valve.detail(), 1);
        EXPECT_EQ(valve.after(1, 0.87) < 1, quiet == 2) << "0.055 a frame, over two";
    }
}

TEST(Woof, EachStepTakesAHistoryOfItsOwn) {
    Driven woof("woof");
    for (int i = 1; i < 4; ++i) {
        woof.after(14, 1.1);
        EXPECT_NEAR(woof.detail(), 1.05 - 0.05 * i, exact);
        EXPECT_NEAR(woof.after(1, 1.1), 1 - 0.05 * i, exact);
    }
}

TEST(Rivals, ATimeOfNoSoundDecisionIsOfThePresentDetail) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (const std::string_view name : rival_names()) {
        Driven sound(name), odd(name);
        for (int i = 0; i < 3; ++i) {
            sound.after(1, 1.5);
            odd.law->observe({0, 1.5 * target, {State::slowed, none, 0}, {}});
            odd.decision = odd.law->decide({target, range});
        }
        EXPECT_NEAR(odd.detail(), sound.detail(), exact) << name;
    }
}

TEST(OfflineTable, TakesTheFinestStepThatFitsTimesTheGain) {
    Driven table(make_offline_table([](double detail) { return target * detail; }));
    const double step = 0.95 / offline_steps;
    EXPECT_NEAR(table.after(1, 1), 1, exact) << "as the table says";
    const double gain = std::pow(2, 0.125);  // an eighth of a time twice as long, by logarithms
    const double fits = table.after(1, 2);
    EXPECT_LE(fits, 1 / gain);
    EXPECT_GT(fits, 1 / gain - step);
}

TEST(OfflineTable, MeasuresEachStepOnceAndThenNoMore) {
    int measured = 0;
    Driven table(make_offline_table([&](double detail) {
        ++measured;
        EXPECT_GE(detail, 0.05);
        EXPECT_LE(detail, 1);
        return 1 + detail;
    }));
    table.after(100, 1.3);
    EXPECT_EQ(measured, offline_steps + 1);
}

TEST(OfflineTable, GivesAllDetailAwayForATimeThatNoStepMeets) {
    Driven table(make_offline_table([](double) { return target; }));
    EXPECT_NEAR(table.after(200, 3), 0.05, exact);
}

}  // namespace
}  // namespace sfsm
