// Every figure on runs written by hand, against what a pencil says.
#include "sfsm/simulate/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "sfsm/simulate/knob_plant.h"

namespace sfsm::simulate {
namespace {

constexpr double target_ms = 10;
constexpr double best_detail = 0.7 / 1.2;  // where the toy's curve is at the target

// A target that can be met exactly in every frame, and no noise: outcomes are written by the tests.
Course plain_course(std::int64_t frames) {
    KnobModel model;
    model.nominal_ms = target_ms;
    model.load = [](std::int64_t) { return 1.0; };
    Scenario scenario;
    scenario.plant = std::make_shared<KnobPlant>(model);
    scenario.target = TargetSchedule::parse("10");
    scenario.frames = frames;
    scenario.statistics_from = 0;
    scenario.delay = 1;
    return make_course(scenario);
}

using Written = std::function<void(std::int64_t frame, Outcome& outcome)>;

std::vector<Outcome> outcomes_of(const Course& course, const Written& write) {
    std::vector<Outcome> outcomes;
    for (std::int64_t frame = 0; frame < course.scenario.frames; ++frame) {
        Outcome outcome{target_ms, target_ms, target_ms, best_detail, {}, {}};
        write(frame, outcome);
        outcomes.push_back(outcome);
    }
    return outcomes;
}

Metrics measured(const Course& course, const Written& write) {
    return measure(course, outcomes_of(course, write));
}

void take(Outcome& outcome, double ms) {
    outcome.ms = outcome.cost_ms = ms;
}

TEST(Metrics, SharesAndRatesOfTenFrames) {
    const double times[] = {10, 10, 10, 10.4, 10.6, 9.6, 9.4, 8.5, 11.5, 25};
    const Metrics m = measured(plain_course(10), [&](std::int64_t frame, Outcome& o) { take(o, times[frame]); });
    EXPECT_DOUBLE_EQ(m.over_target, 0.4);
    EXPECT_DOUBLE_EQ(m.over_5pct, 0.3);
    EXPECT_DOUBLE_EQ(m.within_5pct, 0.5);
    EXPECT_DOUBLE_EQ(m.within_10pct, 0.7);
    EXPECT_NEAR(m.control_rate, (3 + 0.96 + 0.94 + 0.96 + 0.94 + 0.85 + 0.85 + 0) / 10, 1e-12);
    EXPECT_NEAR(m.hitch_ms_per_s, 1000 * (0.4 + 0.6 + 1.5 + 15) / 115, 1e-9);
    EXPECT_NEAR(m.overshoot_pct, 150, 1e-9);
    EXPECT_NEAR(m.judged_ms, 115, 1e-9);
}

TEST(Metrics, QualityIsTheSumOfDetailOverTheBest) {
    const Metrics m = measured(plain_course(4), [](std::int64_t frame, Outcome& o) {
        o.detail = frame < 2 ? best_detail : 0.5 * best_detail;
    });
    EXPECT_NEAR(m.quality, 0.75, 1e-9);
}

TEST(Metrics, QualityLeavesInterruptedFramesOut) {
    Course course = plain_course(100);
    course.scenario.interruptions = {{{60, 70}, 4000}};
    const Metrics m = measured(
        course, [](std::int64_t frame, Outcome& o) { o.detail = frame >= 60 && frame < 70 ? 0 : best_detail; });
    EXPECT_NEAR(m.quality, 1, 1e-9);
}

TEST(Metrics, FramesBeforeTheStatisticsCountInNoShare) {
    Course course = plain_course(20);
    course.scenario.statistics_from = 10;
    const Metrics m = measured(course, [](std::int64_t frame, Outcome& o) {
        if (frame < 10) take(o, 50);
    });
    EXPECT_EQ(m.over_5pct, 0);
    EXPECT_EQ(m.within_5pct, 1);
    EXPECT_EQ(m.overshoot_pct, 0);
}

TEST(Metrics, InterruptedFramesAndTargetsOutOfReachCountInNoShare) {
    Course course = plain_course(100);
    course.scenario.interruptions = {{{60, 70}, 4000}};
    for (std::size_t frame = 80; frame < 100; ++frame) course.best[frame].cost_ms = 1.2 * target_ms;
    const Metrics m = measured(course, [](std::int64_t frame, Outcome& o) {
        if (frame >= 60 && frame < 70) take(o, 4000);
        if (frame >= 80) take(o, 12);
        if (frame == 0) take(o, 11);
    });
    EXPECT_DOUBLE_EQ(m.over_5pct, 1.0 / 70);
}

TEST(Metrics, TheWorstSecondIsTheDensestStretchOfOneSecond) {
    // Misses of 11 ms: one in eighty frames, and twenty in a row.
    const Metrics m = measured(plain_course(400), [](std::int64_t frame, Outcome& o) {
        if ((frame >= 200 && frame < 220) || frame % 80 == 7) take(o, 11);
    });
    // The twenty and their neighbours 167 and 247: 22 of the 98 frames that 1002 ms hold.
    EXPECT_DOUBLE_EQ(m.worst_second, 22.0 / 98);
    EXPECT_EQ(measured(plain_course(50), [](std::int64_t, Outcome& o) { take(o, 12); }).worst_second, 0)
        << "a run of 600 ms has no second";
}

TEST(Metrics, SettlingIsCountedFromTheStepToTheLastLongExcursion) {
    Course course = plain_course(600);
    course.scenario.steps = {{{100, 300}, true}, {{300, 600}, false}};
    const Metrics m = measured(course, [](std::int64_t frame, Outcome& o) {
        if (frame >= 100 && frame < 130) take(o, 14);
        if (frame >= 300 && frame < 320) take(o, 7);
    });
    // A median of nine is back four frames after the times are.
    EXPECT_EQ(m.settle_down, 34);
    EXPECT_EQ(m.settle_up, 24);
    EXPECT_EQ(m.cost_settle_down, 30);
    EXPECT_EQ(m.cost_settle_up, 20);
}

TEST(Metrics, FourBadFramesPassTheMedianAndNotTheCost) {
    Course course = plain_course(300);
    course.scenario.steps = {{{100, 300}, true}};
    const Metrics m = measured(course, [](std::int64_t frame, Outcome& o) {
        if (frame >= 100 && frame < 104) take(o, 16);
    });
    EXPECT_EQ(m.settle_down, 0);
    EXPECT_EQ(m.cost_settle_down, 4);
}

TEST(Metrics, ThreeFramesOfSixtyMayLeaveTheBand) {
    Course course = plain_course(300);
    course.scenario.steps = {{{100, 300}, true}};
    const auto with_excursions = [&](std::int64_t count) {
        return measured(course,
                        [=](std::int64_t frame, Outcome& o) {
                            if (frame >= 150 && frame < 150 + count) take(o, 12);
                        })
            .cost_settle_down;
    };
    EXPECT_EQ(with_excursions(3), 0);
    EXPECT_EQ(with_excursions(4), 54) << "from frame 151 on only three are left, but it begins with frame 154, in band";
}

TEST(Metrics, WhatNeverSettlesHasNoNumber) {
    Course course = plain_course(400);
    course.scenario.steps = {{{100, 200}, true}, {{200, 400}, true}};
    const Metrics m = measured(course, [](std::int64_t frame, Outcome& o) {
        if (frame >= 200) take(o, 12);
    });
    EXPECT_FALSE(m.settle_down) << "it settled after one step of two";
    EXPECT_FALSE(m.settle_up) << "there is no such step";
    EXPECT_FALSE(m.recovery) << "there is no interruption";
}

TEST(Metrics, OvershootForgivesTheFramesThatNoLawCanKnowOf) {
    Course course = plain_course(300);
    course.scenario.steps = {{{100, 300}, true}};
    const auto peak_at = [&](std::int64_t peak) {
        return measured(course,
                        [=](std::int64_t frame, Outcome& o) {
                            if (frame == peak) take(o, 16);
                        })
            .overshoot_pct;
    };
    EXPECT_NEAR(peak_at(99), 60, 1e-9);
    EXPECT_EQ(peak_at(100), 0);
    EXPECT_EQ(peak_at(101), 0) << "the time of frame 100 arrives before frame 102";
    EXPECT_NEAR(peak_at(102), 60, 1e-9);
}

// A plant that tells of its frames beforehand.
class Told final : public Plant {
public:
    explicit Told(std::shared_ptr<const Plant> plant) : plant_(std::move(plant)) {}
    double range(std::int64_t frame) const override { return plant_->range(frame); }
    const Forecast* forecast(std::int64_t) const override { return &forecast_; }
    double cost_ms(std::int64_t frame, const Decision& d) const override { return plant_->cost_ms(frame, d); }
    Work work(std::int64_t frame, const Decision& d) const override { return plant_->work(frame, d); }
    double detail(std::int64_t frame, const Decision& d) const override { return plant_->detail(frame, d); }
    Decision optimum(std::int64_t frame, double limit_ms) const override { return plant_->optimum(frame, limit_ms); }

private:
    std::shared_ptr<const Plant> plant_;
    Forecast forecast_;
};

TEST(Metrics, OvershootForgivesNothingThatAForecastTold) {
    Course course = plain_course(300);
    course.scenario.steps = {{{100, 300}, true}};
    course.scenario.plant = std::make_shared<Told>(course.scenario.plant);
    const Metrics m = measured(course, [](std::int64_t frame, Outcome& o) {
        if (frame == 100) take(o, 16);
    });
    EXPECT_NEAR(m.overshoot_pct, 60, 1e-9);
}

TEST(Metrics, ReversalsVariationAndChangesAreOfSteadyFramesOnly) {
    Course course = plain_course(201);
    course.scenario.steady = {{100, 201}};
    const double details[] = {0.5, 0.6, 0.6, 0.5};  // up, rest, down, rest, up again: two turns in four frames
    const Metrics m = measured(course, [&](std::int64_t frame, Outcome& o) {
        o.detail = frame < 100 ? (frame % 2 == 0 ? 0.1 : 0.9) : details[frame % 4];
        o.decision.splat_size = o.detail;
    });
    EXPECT_NEAR(m.reversals_per_1000, 490, 1e-9) << "50 moves of 100 frames, the first is no turn";
    EXPECT_NEAR(m.variation_per_1000, 0.1 * 500, 1e-9);
    EXPECT_NEAR(m.changes_per_1000, 500, 1e-9);
}

TEST(Metrics, SlowDriftHasVariationButNoReversal) {
    Course course = plain_course(101);
    course.scenario.steady = {{0, 101}};
    const Metrics m =
        measured(course, [](std::int64_t frame, Outcome& o) { o.detail = 0.5 + 0.001 * static_cast<double>(frame); });
    EXPECT_EQ(m.reversals_per_1000, 0);
    EXPECT_NEAR(m.variation_per_1000, 1, 1e-9);
    EXPECT_EQ(m.changes_per_1000, 0) << "the decisions are the same";
}

TEST(Metrics, RecoveryIsTheWayBackToTheDetailBefore) {
    Course course = plain_course(400);
    course.scenario.interruptions = {{{100, 101}, 4000}};
    const auto low_until = [&](std::int64_t end) {
        return measured(course,
                        [=](std::int64_t frame, Outcome& o) {
                            if (frame > 100 && frame < end) o.detail = 0.9 * best_detail;
                        })
            .recovery;
    };
    EXPECT_EQ(low_until(0), 0);
    EXPECT_EQ(low_until(151), 50);
    EXPECT_FALSE(low_until(400));
}

TEST(Metrics, OfNoJudgedFramesAreZeros) {
    Course course = plain_course(10);
    course.scenario.statistics_from = 10;
    const Metrics m = measured(course, [](std::int64_t, Outcome&) {});
    EXPECT_EQ(m.over_5pct, 0);
    EXPECT_EQ(m.within_5pct, 0);
    EXPECT_EQ(m.quality, 0);
}

TEST(Metrics, RegainIsTheSlowestWayBackToEnoughOfTheBestDetail) {
    Course course = plain_course(600);
    course.scenario.regained = {{100, 300}, {300, 600}};
    course.scenario.regained_share = 0.9;
    const auto back_after = [&](std::int64_t first, std::int64_t second) {
        return measured(course, [=](std::int64_t frame, Outcome& o) {
            const bool is_away = (frame >= 100 && frame < 100 + first) || (frame >= 300 && frame < 300 + second);
            o.detail = best_detail * (is_away ? 0.89 : 0.91);
        });
    };
    EXPECT_EQ(back_after(20, 7).regain, 20);
    EXPECT_EQ(back_after(20, 70).regain, 70);
    EXPECT_EQ(back_after(0, 0).regain, 0);
    EXPECT_FALSE(back_after(20, 300).regain);
    course.scenario.regained.clear();
    EXPECT_FALSE(back_after(0, 0).regain) << "nothing is to be regained";
}

TEST(Metrics, IsStuckWhereTheEndIsMostlySlowOrHalfAsFine) {
    const Course course = plain_course(1000);
    const auto stuck = [&](double slow_share, double detail_share) {
        return measured(course,
                        [=](std::int64_t frame, Outcome& o) {
                            if (frame < 400) return take(o, 20);  // long ago
                            o.detail = detail_share * best_detail;
                            if (static_cast<double>(frame - 400) < slow_share * 600) take(o, 10.6);
                        })
            .is_stuck;
    };
    EXPECT_EQ(stuck(0.49, 1), 0);
    EXPECT_EQ(stuck(0.51, 1), 1);
    EXPECT_EQ(stuck(0, 0.51), 0);
    EXPECT_EQ(stuck(0, 0.49), 1);
}

TEST(Metrics, UnderACapTimesAreComparedWithTheCap) {
    Course course = plain_course(100);
    course.scenario.cap_ms = 12;
    const auto over = [&](double ms) {
        return measured(course, [=](std::int64_t, Outcome& o) { take(o, ms); }).over_5pct;
    };
    EXPECT_EQ(over(12), 0);
    EXPECT_EQ(over(12.7), 1);
    course.scenario.cap_ms = 8;
    EXPECT_EQ(over(10), 0);
    EXPECT_EQ(over(10.6), 1);
}

TEST(Metrics, StepsAreInOctavesOfTheSplatSizeThatIsSeen) {
    const Course course = plain_course(100);
    const auto step = [&](const Decision& before, const Decision& after) {
        return measured(course, [&](std::int64_t frame, Outcome& o) { o.decision = frame < 50 ? before : after; })
            .largest_step;
    };
    EXPECT_DOUBLE_EQ(step({State::points, 100, 1}, {State::points, 100, 4}), 2);
    EXPECT_DOUBLE_EQ(step({State::points, 100, 4}, {State::points, 100, 1}), 2);
    EXPECT_DOUBLE_EQ(step({}, {State::points, 100, 1}), 1) << "meshes look like the finest splats";
    EXPECT_DOUBLE_EQ(step({}, {State::points, 100, 0.3}), 0) << "nobody sees so little";
    EXPECT_DOUBLE_EQ(step({State::points, 100, 2}, {State::points, 50, 2}), 0);
}

TEST(Metrics, AStepThatTheTargetAskedForIsNone) {
    Course course = plain_course(100);
    const Metrics m = measured(course, [&](std::int64_t frame, Outcome& o) {
        o.target_ms = frame < 50 ? 20 : 10;
        o.decision = {State::points, 100, frame < 50 ? 1.0 : 3.0};
    });
    EXPECT_NEAR(m.largest_step, std::log2(3.0) - 1, 1e-12);
}

TEST(Metrics, TheFirstTenFramesAreComparedWithTargetAndRest) {
    const Metrics m = measured(plain_course(100), [](std::int64_t frame, Outcome& o) {
        take(o, frame == 3 ? 25 : frame == 12 ? 99 : 10);
        o.decision = {State::points, 100, frame == 5 ? 6.0 : 2.0};
    });
    EXPECT_DOUBLE_EQ(m.first_over, 2.5);
    EXPECT_DOUBLE_EQ(m.first_coarse, 3);
    EXPECT_NEAR(m.mean_ms, (98 * 10 + 25 + 99) / 100.0, 1e-9);
}

}  // namespace
}  // namespace sfsm::simulate
