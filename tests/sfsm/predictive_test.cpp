// The closed loop of the default law, with and without a forecast: where it goes, how soon, and what can't happen.
#include "sfsm/predictive.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sfsm/detail.h"
#include "sfsm/least_loss.h"
#include "tests/sfsm/normal.h"
#include "tests/sfsm/simulation.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

constexpr int most_delay = 4;  // frames, of timer queries
constexpr double target_ms = 1000.0 / 60;

// --- One knob, no forecast: time = load * curve(detail) * target.

using Curve = std::function<double(double detail)>;
using Load = std::function<double(std::int64_t frame)>;

double toy(double detail) {
    return 0.3 + 1.2 * detail;
}

Time knob(Curve curve, Load load, double noise = 0, std::uint64_t seed = 1) {
    return [=, random = std::mt19937_64(seed)](std::int64_t frame, const Decision& decision) mutable {
        const double ms = load(frame) * curve(detail_of(decision, test_range)) * target_ms;
        return noise > 0 ? ms * std::exp(noise * normal(random)) : ms;
    };
}

Load steady(double load = 1) {
    return [=](std::int64_t) { return load; };
}

std::vector<TraceRow> run_knob(const Time& time, std::int64_t frames, int delay) {
    PredictiveLaw law;
    return run(law, {time, constant(target_ms), frames, delay});
}

int reversals(const std::vector<TraceRow>& rows, std::size_t from) {
    int count = 0;
    double last_step = 0;
    for (std::size_t i = from + 1; i < rows.size(); ++i) {
        const double step = detail_of(rows[i].decision, test_range) - detail_of(rows[i - 1].decision, test_range);
        if (step == 0) continue;
        count += step * last_step < 0 ? 1 : 0;
        last_step = step;
    }
    return count;
}

int changes(const std::vector<TraceRow>& rows, std::size_t from, std::size_t to) {
    int count = 0;
    for (std::size_t i = from + 1; i < to; ++i) count += rows[i].decision != rows[i - 1].decision ? 1 : 0;
    return count;
}

// A line, or a bow either way; from 2 to 30 times as dear at detail 1 as at 0.
Curve any_monotone_curve(std::mt19937_64& random) {
    const double dearer = std::exp(uniform(random, std::log(2), std::log(30)));
    const double bow = uniform(random, 0.5, 2);
    const double least = 1.6 / dearer;
    return [=](double detail) { return least * (1 + (dearer - 1) * std::pow(detail, bow)); };
}

TEST(PredictiveLaw, SettlesOnAnyMonotonePlantWithinSixAnswers) {
    constexpr int answers = 6;      // each takes delay + 1 frames, and the first two times are waited for
    constexpr double close = 0.05;  // of the target
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 300; ++trial) {
        const Curve curve = any_monotone_curve(random);
        const int delay = trial % (most_delay + 1);
        const bool is_reachable = curve(0) < 1;
        const auto rows = run_knob(knob(curve, steady()), 200, delay);
        for (const TraceRow& row : rows) {
            if (row.frame < 1 + answers * (delay + 1) || !is_reachable) continue;
            ASSERT_NEAR(row.frame_ms, target_ms, close * target_ms)
                << "trial " << trial << " delay " << delay << " frame " << row.frame;
        }
    }
}

TEST(PredictiveLaw, AnswersALoadStepOneFrameAfterItsSecondTime) {
    constexpr double in_band = 0.15;  // of the target; two times have 1 % noise, and the shape was not known
    for (int delay = 0; delay <= most_delay; ++delay) {
        const Load load = [](std::int64_t frame) { return frame >= 300 && frame < 600 ? 1.6 : 1.0; };
        const auto rows = run_knob(knob(toy, load, 0.01), 900, delay);
        for (const std::int64_t step : {300, 600}) {
            for (std::int64_t frame = step + delay + 2; frame < step + 60; ++frame) {
                const TraceRow& row = rows[static_cast<std::size_t>(frame)];
                ASSERT_NEAR(row.frame_ms, target_ms, in_band * target_ms) << "delay " << delay << " frame " << frame;
            }
        }
    }
}

TEST(PredictiveLaw, KeepsStillAtConstantLoad) {
    constexpr double most_per_1000 = 2;
    int turns = 0;
    constexpr int seeds = 20;
    for (int seed = 0; seed < seeds; ++seed) {
        turns += reversals(run_knob(knob(toy, steady(), 0.03, seed), 2200, 2), 200);
    }
    EXPECT_LE(turns, most_per_1000 * 2 * seeds);
}

TEST(PredictiveLaw, ChangesNothingOnASteadyTrace) {
    for (int delay = 0; delay <= most_delay; ++delay) {
        const auto rows = run_knob(knob(toy, steady()), 2000, delay);
        EXPECT_EQ(changes(rows, 100, rows.size()), 0) << "delay " << delay;
    }
}

TEST(PredictiveLaw, FollowsARampWithoutLag) {
    const Load ramp = [](std::int64_t frame) {
        return 1 + 0.5 * std::clamp((static_cast<double>(frame) - 300) / 900, 0.0, 1.0);
    };
    double sum = 0;
    constexpr int seeds = 20;
    for (int seed = 0; seed < seeds; ++seed) {
        const auto rows = run_knob(knob(toy, ramp, 0.03, seed), 1200, 2);
        for (std::size_t i = 300; i < rows.size(); ++i) sum += rows[i].frame_ms / target_ms / 900 / seeds;
    }
    EXPECT_NEAR(sum, 1, 0.015) << "mean time over the ramp, in targets";
}

TEST(PredictiveLaw, AHitchAPauseAndALoadingScreenLeaveNothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const Time plant = knob(toy, steady());
    const Time calm = plant;
    for (const std::vector<double>& times : std::vector<std::vector<double>>{
             {4000}, {80}, {30}, {0.1}, {0, nan, -5, inf, 1e9, 1e9}, {900, 900, 900, 900, 900, 900, 900}}) {
        const Time interrupted = [&](std::int64_t frame, const Decision& decision) {
            const auto i = static_cast<std::size_t>(frame - 500);
            return frame >= 500 && i < times.size() ? times[i] : plant(frame, decision);
        };
        const auto rows = run_knob(interrupted, 1000, 2);
        EXPECT_EQ(changes(rows, 400, rows.size()), 0) << times.size() << " frames from " << times[0] << " ms";
    }
}

TEST(PredictiveLaw, StopsAtAStepInCostInsteadOfBouncingAcrossIt) {
    const Curve stairs = [](double detail) { return toy(std::floor(detail * 8) / 8); };
    constexpr int seeds = 60, most_reversals = 10;  // of each in 2000 frames
    int bouncing = 0;
    double over = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const auto rows = run_knob(knob(stairs, steady(), 0.01, seed), 3000, 2);
        bouncing += reversals(rows, 1000) > most_reversals ? 1 : 0;
        for (std::size_t i = 200; i < rows.size(); ++i) over += rows[i].frame_ms > 1.05 * target_ms ? 1 : 0;
    }
    EXPECT_LE(bouncing, seeds / 10) << "a jump of a few per cent may look like noise";
    EXPECT_LT(over / seeds / 2800, 0.05);
}

// Costs that jump between two details look like a cap on the frame rate, or like a load that falls.
TEST(PredictiveLaw, NeitherStaysAboveNorBouncesOnStairsOfAnyShape) {
    constexpr int seeds = 100;
    constexpr std::int64_t load_frames = 1200, settled = 400, frames = 3 * load_frames;
    int stuck = 0;
    double over = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        std::mt19937_64 random(seed);
        const int steps = 2 + static_cast<int>(uniform(random, 0, 9));
        std::vector<double> levels{uniform(random, 0.3, 0.6)};
        for (int i = 0; i < steps; ++i) levels.push_back(levels.back() + uniform(random, 0, 3.2 / steps));
        const Curve stairs = [=](double detail) {
            return levels[static_cast<std::size_t>(std::floor(detail * steps + 1e-9))];
        };
        const std::array<double, 3> loads{1, uniform(random, 0.7, 1.4), uniform(random, 0.8, 1.3)};
        const Load load = [=](std::int64_t frame) { return loads[static_cast<std::size_t>(frame / load_frames)]; };
        const double noise = std::exp(uniform(random, std::log(0.002), std::log(0.03)));
        double late = 0;
        for (const TraceRow& row : run_knob(knob(stairs, load, noise, static_cast<std::uint64_t>(seed)), frames, 2)) {
            const bool is_reachable = load(row.frame) * levels[0] < 0.95;
            const bool is_late = row.frame_ms > 1.03 * std::exp(2 * noise) * target_ms;
            if (row.frame % load_frames >= settled && is_reachable && is_late)
                late += 1.0 / static_cast<double>(3 * (load_frames - settled));
        }
        over += late / seeds;
        stuck += late > 0.5 ? 1 : 0;
    }
    EXPECT_EQ(stuck, 0);
    EXPECT_LT(over, 0.045);
}

TEST(PredictiveLaw, NoFirstFrameIsFinerThanPointsOfFourTimesTheFinest) {
    PredictiveLaw law;
    const Decision first = law.decide({target_ms, test_range});
    EXPECT_EQ(first.state, State::points);
    EXPECT_NEAR(first.splat_size, 4 * finest_splat, 1e-9);
}

TEST(PredictiveLaw, DrawsNoTrianglesBeforeTheFinestPointsAreKnown) {
    const Curve leaping = [](double detail) { return detail < detail_of_points ? 0.3 + 0.2 * detail : 2.5; };
    const auto rows = run_knob(knob(leaping, steady()), 30, 2);
    bool are_known = false;
    for (const TraceRow& row : rows) {
        EXPECT_TRUE(are_known || row.decision.state == State::points) << row.frame;
        are_known = are_known || row.decision.splat_size < 1.1 * finest_splat;
    }
    EXPECT_TRUE(are_known);
}

TEST(PredictiveLaw, GivesUpOnATargetOutOfReachAndComesBack) {
    const Load load = [](std::int64_t frame) { return frame >= 300 && frame < 900 ? 6.0 : 1.0; };
    const auto rows = run_knob(knob(toy, load, 0.01), 1200, 2);
    for (std::size_t i = 330; i < 900; ++i) EXPECT_LT(detail_of(rows[i].decision, test_range), 0.05) << i;
    for (std::size_t i = 920; i < 1200; ++i) EXPECT_NEAR(rows[i].frame_ms, target_ms, 0.1 * target_ms) << i;
}

// For 600 frames a processor sets the pace, whatever the detail, and then it doesn't.
TEST(PredictiveLaw, WhatBoughtNothingOnceIsTriedAgain) {
    constexpr std::int64_t begin = 300, end = 900;
    constexpr int longest = 400;  // frames until that is found out: a wait, a retest and the answer to it
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        std::mt19937_64 random(seed);
        const Time bound = [&](std::int64_t frame, const Decision& decision) {
            const double drawing = toy(detail_of(decision, test_range));
            const bool is_bound = frame >= begin && frame < end;
            return (is_bound ? std::max(drawing, 1.3) : drawing) * target_ms * std::exp(0.03 * normal(random));
        };
        const auto rows = run_knob(bound, end + longest + 100, 2);
        int over = 0;
        for (std::size_t i = end + longest; i < rows.size(); ++i) over += rows[i].frame_ms > 1.1 * target_ms ? 1 : 0;
        EXPECT_LE(over, 5) << "seed " << seed;
    }
}

TEST(PredictiveLaw, GivesDetailBackWhereItBuysNothing) {
    const Time cpu_bound = [](std::int64_t, const Decision&) { return 1.5 * target_ms; };
    const auto rows = run_knob(cpu_bound, 600, 2);
    EXPECT_GT(detail_of(rows.back().decision, test_range), 0.9);
    EXPECT_EQ(changes(rows, 300, rows.size()), 2) << "one retest, which changes nothing";
}

// Times in whole refreshes say nothing of the time to spare; detail is sought until a few frames are late.
TEST(PredictiveLaw, FindsTheDetailThatADisplayHides) {
    const Load load = [](std::int64_t frame) { return frame >= 1000 && frame < 2000 ? 1.6 : 1.0; };
    const Time plant = knob(toy, load, 0.03);
    const Time rounded = [&](std::int64_t frame, const Decision& decision) {
        return std::ceil(plant(frame, decision) / target_ms) * target_ms;
    };
    const auto rows = run_knob(rounded, 3000, 2);
    double late = 0, cost = 0;
    for (std::size_t i = 200; i < rows.size(); ++i) {
        late += rows[i].frame_ms > 1.5 * target_ms ? 1.0 / 2800 : 0;
        cost += load(rows[i].frame) * toy(detail_of(rows[i].decision, test_range)) / 2800;
    }
    EXPECT_LT(late, 0.05);
    EXPECT_GT(cost, 0.8) << "mean share of the refresh that is used";
}

TEST(PredictiveLaw, ANewTargetIsAnsweredInItsFrame) {
    PredictiveLaw law;
    const Target target = [](std::int64_t frame) { return frame < 300 ? target_ms : 0.8 * target_ms; };
    const auto rows = run(law, {knob(toy, steady()), target, 400, 4});
    EXPECT_NEAR(rows[300].frame_ms, 0.8 * target_ms, 0.05 * target_ms);
}

// What failed under one target may fit the next.
TEST(PredictiveLaw, ANewTargetTriesAgainWhatWasTooDear) {
    constexpr std::int64_t at = 300, prompt = 40;  // long before what was too dear is tried again anyway
    const Curve stairs = [](double detail) { return toy(std::floor(detail * 8) / 8); };  // 0.90 and 1.05 of the target
    const Target target = [](std::int64_t frame) { return (frame < at ? 1 : 1.1) * target_ms; };
    PredictiveLaw law;
    const auto rows = run(law, {knob(stairs, steady(), 0.002), target, at + 300, 1});
    double higher = 0;
    for (std::int64_t frame = at + prompt; frame < at + 300; ++frame)
        higher += rows[static_cast<std::size_t>(frame)].frame_ms > target_ms ? 1 : 0;
    EXPECT_GT(higher / (300 - prompt), 0.9);
}

// D is a share of L: a time tells of the detail that its decision was when it was made.
TEST(PredictiveLaw, LateTimesAreOfTheirOwnRange) {
    for (int delay = 0; delay <= most_delay; ++delay) {
        std::mt19937_64 random(3);
        PredictiveLaw law;
        std::vector<TraceRow> rows;
        for (std::int64_t frame = 0; frame < 300; ++frame) {
            if (frame > delay) {
                const TraceRow& arrived = rows[static_cast<std::size_t>(frame - 1 - delay)];
                law.observe({arrived.frame, arrived.frame_ms, arrived.decision, {}});
            }
            TraceRow row;
            row.frame = frame;
            row.range = uniform(random, 60, 600);
            row.decision = law.decide({1.25 * target_ms, row.range});  // met in state 1
            row.frame_ms = toy(detail_of(row.decision, row.range)) * target_ms;
            rows.push_back(row);
            if (frame < 60) continue;
            ASSERT_EQ(row.decision.state, State::slowed) << frame;
            ASSERT_LE(row.decision.motion_distance, row.range) << frame;
            ASSERT_NEAR(row.frame_ms, 1.25 * target_ms, 0.03 * target_ms) << "delay " << delay << " frame " << frame;
        }
    }
}

// --- With a forecast.

// A view of people whose motion and shapes can be thinned, and a renderer with prices.
struct Scene {
    Prices prices{2, {0, 1e-6, 4e-7, 2e-4}};
    double people = 10'000, triangles_each = 1000, points_each = 1500, farness = 2;
    std::vector<Step> motion, shapes;
    Forecast forecast;
    double drawn = 1;  // points and triangles, for each that is foreseen
    Work around;       // structure and background

    double updates(double share) const {
        const double near = std::pow(share, farness);
        return people * (near + (1 - near) / (1 + 20 * (1 - share)));
    }
    void count() {
        motion.clear();
        shapes.clear();
        for (int i = 0; i <= 12; ++i) {
            const double share = 1 - i / 12.5;
            const double distance = i == 0 ? std::numeric_limits<double>::infinity() : share * test_range;
            motion.push_back(motion_step(distance, std::llround(updates(share)), (1 - share) * 0.3));
        }
        shapes.push_back(shape_step(0, std::llround(people * triangles_each), 0, 0));
        for (int i = 0; i <= 24; ++i) {
            const double size = 0.5 * std::exp2(i / 4.0);
            shapes.push_back(shape_step(size, 0, std::llround(people * points_each / size), 0.5 * size));
        }
        for (Step& step : shapes) step.work[WorkKind::single] = std::llround(people);
        forecast = {around, motion, shapes};
        forecast.frame[WorkKind::person] = std::llround(people);
    }
    Work work(const Decision& decision) const {
        const double share =
            decision.state == State::original ? 1 : std::min(1.0, decision.motion_distance / test_range);
        Work work = forecast.frame;
        work[WorkKind::single] = std::llround(people);
        work[WorkKind::motion_update] = std::llround(updates(share));
        if (decision.state == State::points) {
            work[WorkKind::point] = std::llround(drawn * people * points_each / decision.splat_size);
        } else {
            work[WorkKind::triangle] = std::llround(drawn * people * triangles_each);
        }
        return work;
    }
    double ms(const Work& work) const { return cost_of(work, prices); }
};

struct ForecastLoop {
    std::function<const Scene&(std::int64_t frame)> scene;
    Target target = constant(target_ms);
    std::int64_t frames = 600;
    int delay = 2;
    double noise = 0.01;
    std::uint64_t seed = 1;
    double sway = 0;  // [share] of times, to and fro
};

std::vector<TraceRow> run(Controller& law, const ForecastLoop& loop) {
    std::mt19937_64 random(loop.seed);
    return run_frames(law, loop.frames, loop.delay, loop.target, test_range, [&](TraceRow& row) {
        const Scene& scene = loop.scene(row.frame);
        row.decision = law.decide({row.target_ms, test_range, &scene.forecast});
        row.work = scene.work(row.decision);
        row.frame_ms = scene.ms(row.work) * std::exp(loop.noise * normal(random));
        row.frame_ms *= std::exp(loop.sway * std::sin(2.4 * static_cast<double>(row.frame)));
    });
}

Scene scene_of(double people, double points_each = 1500, double farness = 2) {
    Scene scene;
    scene.people = people;
    scene.points_each = points_each;
    scene.farness = farness;
    scene.count();
    return scene;
}

TEST(PredictiveForecast, ACameraCutIsInBandOnItsFirstFrame) {
    const Scene views[] = {scene_of(20'000), scene_of(17'000, 2500, 3), scene_of(35'000, 900, 8)};
    for (int delay = 0; delay <= most_delay; ++delay) {
        PredictiveLaw law;
        const auto view_at = [&](std::int64_t frame) -> const Scene& { return views[frame / 200 % 3]; };
        const auto rows = run(law, ForecastLoop{view_at, constant(target_ms), 1200, delay});
        for (std::size_t i = 600; i < rows.size(); ++i)
            ASSERT_NEAR(rows[i].frame_ms, target_ms, 0.1 * target_ms) << "delay " << delay << " frame " << i;
    }
}

TEST(PredictiveForecast, ForecastsThatAreOffMeetTheTargetToo) {
    for (const double drawn : {0.85, 0.9, 1.1, 1.15}) {
        Scene scene = scene_of(20'000);
        scene.drawn = drawn;
        PredictiveLaw law;
        const auto rows = run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }});
        double sum = 0;
        for (std::size_t i = 200; i < rows.size(); ++i) sum += rows[i].frame_ms / 400;
        EXPECT_NEAR(sum, target_ms, 0.015 * target_ms) << drawn;
    }
}

// Such times make up for each other, as those of frames that wait for a cap do.
TEST(PredictiveForecast, TimesThatSwayAreTakenForACapOnlyUntilItIsTested) {
    for (const double sway : {0.01, 0.015, 0.02}) {
        for (const double target : {12.0, 14.0, 16.0, 18.0}) {
            const Scene scene = scene_of(20'000);
            PredictiveLaw law;
            const auto rows = run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; },
                                                    constant(target), 6000, 2, 0.001, 1, sway});
            double over = 0;
            for (const TraceRow& row : rows) over += row.frame_ms > 1.05 * target ? 1.0 / 6000 : 0;
            EXPECT_LT(over, 0.025) << sway << ", " << target;
        }
    }
}

// The paper's first experiment: 20,000 people, most of the time is motion.
TEST(PredictiveForecast, ThePapersTargetStepsAreMetOnTheirFirstFrame) {
    Scene scene;
    scene.prices = {44, {0, 8.6e-6, 1.16e-6, 0.0382}};
    scene.people = 20'000;
    scene.farness = 16;
    scene.count();
    const Target target = [](std::int64_t frame) { return frame < 30 ? 1000.0 : frame < 100 ? 300.0 : 95.0; };
    for (int delay = 0; delay <= 2; ++delay) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            PredictiveLaw law;
            const auto rows = run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, target, 300,
                                                    delay, 0.005, seed});
            for (const std::size_t step : {30u, 100u}) {
                for (std::size_t i = step + 3; i < step + 60; ++i)
                    ASSERT_NEAR(rows[i].frame_ms, rows[i].target_ms, 0.1 * rows[i].target_ms)
                        << "delay " << delay << " seed " << seed << " frame " << i;
            }
            EXPECT_EQ(rows[20 + 30].decision.state, State::slowed);
            EXPECT_EQ(rows[20 + 100].decision.state, State::points);
        }
    }
}

// A software renderer: a second for the triangles, a tenth of that for points, and motion costs nothing.
TEST(PredictiveForecast, LeavesSlowTrianglesAfterTwoTimesAndForGood) {
    Scene scene;
    scene.prices = {20, {0, 4.75e-5, 1e-5, 0}};
    scene.people = 20'000;
    scene.count();
    constexpr int answers = 3;  // after the two that are waited for
    for (int delay = 0; delay <= most_delay; ++delay) {
        PredictiveLaw law;
        const auto rows =
            run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(60), 400, delay});
        for (const TraceRow& row : rows) {
            if (row.frame < delay + 2) continue;
            ASSERT_EQ(row.decision.state, State::points) << row.frame;
            if (row.frame < delay + 2 + answers * (delay + 1)) continue;
            ASSERT_LT(row.frame_ms, 1.1 * 60) << "delay " << delay << " frame " << row.frame;
            ASSERT_TRUE(row.frame < 60 || row.frame_ms > 0.9 * 60) << "delay " << delay << " frame " << row.frame;
        }
    }
}

TEST(PredictiveForecast, TakesTheWholePictureWhereThereIsTime) {
    const Scene scene = scene_of(2000);
    PredictiveLaw law;
    const auto rows = run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }});
    for (std::size_t i = 100; i < rows.size(); ++i) EXPECT_EQ(rows[i].decision, Decision{}) << i;
}

TEST(PredictiveForecast, KeepsStillWhileNothingChanges) {
    const Scene scene = scene_of(20'000);
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(target_ms), 2000, 2, 0});
    EXPECT_EQ(changes(rows, 200, rows.size()), 0);
}

TEST(PredictiveForecast, StatusTellsPricesAndWhatToExpect) {
    const Scene views[] = {scene_of(20'000), scene_of(17'000, 2500, 3), scene_of(35'000, 900, 8)};
    PredictiveLaw law;
    const auto rows = run(law, ForecastLoop{[&](std::int64_t frame) -> const Scene& { return views[frame / 50 % 3]; }});
    const Status& status = law.status();
    EXPECT_EQ(status.decision, rows.back().decision);
    EXPECT_NEAR(status.predicted_ms, target_ms, 0.05 * target_ms);
    EXPECT_NEAR(status.price_ms[WorkKind::point], 4e-7, 1e-7);
    EXPECT_GT(status.uncertainty, 0);
    EXPECT_LT(status.uncertainty, 0.05);
    EXPECT_NEAR(status.noise, 0.01, 0.005);
}

TEST(PredictiveForecast, ForecastsThatAreOffAreMendedWhileDecisionsChange) {
    const Target target = [](std::int64_t frame) { return frame % 2 == 0 ? 14.0 : 20.0; };
    for (const double drawn : {0.85, 0.9, 1.1, 1.15}) {
        Scene scene = scene_of(20'000);
        scene.drawn = drawn;
        PredictiveLaw law;
        const auto rows = run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, target});
        for (const int parity : {0, 1}) {
            double sum = 0;
            for (std::size_t i = 200 + parity; i < rows.size(); i += 2) sum += rows[i].frame_ms / target(i) / 200;
            EXPECT_NEAR(sum, 1, 0.02) << drawn << ", every other frame from " << parity;
        }
    }
}

TEST(PredictiveForecast, NobodyMovesBeyondARangeThatHasShrunk) {
    Scene scene;
    scene.prices = {44, {0, 8.6e-6, 1.16e-6, 0.0382}};
    scene.people = 20'000;
    scene.farness = 16;
    scene.count();
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(300), 100, 0});
    const Decision before = rows.back().decision;
    ASSERT_LT(before.motion_distance, test_range);
    for (const double share : {0.9, 0.5, 0.2}) {
        const double range = share * before.motion_distance;
        const Decision decision = law.decide({300, range, &scene.forecast});
        EXPECT_TRUE(decision.state == State::original || decision.motion_distance <= range) << share;
    }
}

// Two views of the same work, of which the second loses its looks where the first did not.
TEST(PredictiveForecast, ABetterDecisionOfEqualTimeIsTaken) {
    Scene before = scene_of(20'000), after = before;
    for (Step& step : before.motion) step.loss_px *= 0.01;
    for (Step& step : after.motion) step.loss_px *= 100;
    before.forecast = {before.forecast.frame, before.motion, before.shapes};
    after.forecast = {after.forecast.frame, after.motion, after.shapes};
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t frame) -> const Scene& { return frame < 300 ? before : after; },
                              constant(target_ms), 310, 0, 0.002});
    const auto loss = [&](const Decision& d, const Scene& scene) {
        return plan_at(scene.forecast, test_range, std::min(d.motion_distance, test_range), d.splat_size).loss;
    };
    for (const std::size_t frame : {299u, 305u}) {
        const Scene& scene = frame < 300 ? before : after;
        const double least = least_loss_plan(scene.forecast, test_range, before.prices, target_ms).loss;
        EXPECT_LE(loss(rows[frame].decision, scene), 1.25 * least) << frame;
        EXPECT_NEAR(rows[frame].frame_ms, target_ms, 0.05 * target_ms) << frame;
    }
}

// The way down is learned in few single frames, while there is time for them.
TEST(PredictiveForecast, ProbesAreFewAndApartAndOfTwoSplatSizes) {
    const Scene scene = scene_of(2000);
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(target_ms), 600, 2, 0.01});
    std::vector<double> sizes;
    std::int64_t slowed = 0, last = 0;
    for (const TraceRow& row : rows) {
        if (row.frame < 12 || row.decision == Decision{}) continue;  // the first times are of a guess
        EXPECT_GT(row.frame - last, 2) << "each is answered before the next";
        last = row.frame;
        if (row.decision.state == State::points) sizes.push_back(row.decision.splat_size);
        slowed += row.decision.state == State::slowed ? 1 : 0;
    }
    EXPECT_LE(slowed, PredictiveOptions{}.probes);
    EXPECT_EQ(sizes, (std::vector<double>{0.5, 2})) << "the finest, and one four times as coarse";
}

TEST(PredictiveForecast, ProbesNoSplatThatIsFinerThanIsOfUse) {
    Scene scene = scene_of(2000);
    for (Step& step : scene.shapes) step.loss_px = step.setting == 0 ? 0 : std::max(0.5, 0.5 * step.setting);
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(target_ms), 600, 2, 0.01});
    for (const TraceRow& row : rows)
        if (row.decision.state == State::points) {
            EXPECT_GE(row.decision.splat_size, 1) << row.frame;
        }
}

// A camera that turns from the field to the stands draws more than people.
TEST(PredictiveForecast, ACutToAnotherBackgroundIsInBandOnItsFirstFrame) {
    Scene field = scene_of(20'000), stands = scene_of(20'000);
    for (Scene* scene : {&field, &stands}) scene->prices[WorkKind::structure_triangle] = 4e-5;
    field.around[WorkKind::structure_triangle] = 10'000;
    stands.around[WorkKind::structure_triangle] = 120'000;
    field.count();
    stands.count();
    PredictiveLaw law(PredictiveOptions{}, Drawing::native);
    const auto view_at = [&](std::int64_t frame) -> const Scene& { return frame / 100 % 2 == 0 ? field : stands; };
    const auto rows = run(law, ForecastLoop{view_at, constant(target_ms), 1000});
    for (std::size_t i = 400; i < rows.size(); ++i)
        ASSERT_NEAR(rows[i].frame_ms, target_ms, 0.1 * target_ms) << "frame " << i;
}

// Points that cost a sixth of a triangle are not believed to cost two of them, nor triangles to be llvmpipe's.
TEST(PredictiveForecast, NothingIsDrawnFinerAtFirstThanItsOwnDrawingIsBelievedToAllow) {
    const Scene scene = scene_of(4000);
    const FrameRequest request{target_ms, test_range, &scene.forecast};
    const Decision gl = make_controller("predictive", {.drawing = Drawing::opengl})->decide(request);
    const Decision native = make_controller("predictive", {.drawing = Drawing::native})->decide(request);
    ASSERT_EQ(gl.state, State::points);
    ASSERT_EQ(native.state, State::points);
    EXPECT_LT(native.splat_size, gl.splat_size / 4);
    EXPECT_GT(native.motion_distance, gl.motion_distance);
    EXPECT_EQ(make_controller("predictive")->decide(request), gl) << "OpenGL, if nobody says";
}

TEST(PredictiveForecast, ThereIsNoProbeWhileTheTargetIsMissed) {
    Scene scene = scene_of(2000);
    scene.prices.frame = 1.2 * target_ms;  // whatever is drawn
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(target_ms), 400, 0, 0.01});
    EXPECT_LE(changes(rows, 60, rows.size()), 2);
}

Work work_of(const Plan& plan) {
    Work work;
    for (std::size_t i = 0; i < work_kinds; ++i) work.counts[i] = std::llround(plan.counts[i]);
    return work;
}

// A million people half a pixel tall, as OpenGL's forecast had them: finer than S = 1 each step has half as many points
// again, and all of them together save a tenth of a pixel.
TEST(PredictiveForecast, OutOfReachNoPointsAreDrawnThatAreNotWorthTheirTime) {
    constexpr std::int64_t people = 998'772, fewest_points = 1'997'544;
    const std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), people, 0),
                                      motion_step(0.67 * test_range, 328'127, 0.0012),
                                      motion_step(0.17 * test_range, 31'212, 0.0033)};
    std::vector<Step> shapes = {shape_step(0, 1'296'406'056, 0, 0),       shape_step(0.354, 0, 14'846'244, 0.1768),
                                shape_step(0.42, 0, 10'344'904, 0.2101),  shape_step(0.5, 0, 7'423'122, 0.2443),
                                shape_step(0.595, 0, 5'172'452, 0.2682),  shape_step(0.707, 0, 3'713'043, 0.2785),
                                shape_step(0.841, 0, 2'646'321, 0.27974), shape_step(1, 0, 2'187'635, 0.279742),
                                shape_step(1.19, 0, 2'002'459, 0.279742)};
    for (double size = 1.414; size < 33; size *= 1.189) shapes.push_back(shape_step(size, 0, fewest_points, 0.279742));
    const Forecast forecast{Work{people}, motion, shapes};
    for (const Drawing drawing : {Drawing::opengl, Drawing::native})
        for (const double point_ms : {1.2e-4, 3e-5, 5e-6}) {
            const Prices prices{1, {6e-4, 8e-5, point_ms, 1e-6}};
            const double least_ms = plan_ms(cheapest_plan(forecast, test_range), prices);
            PredictiveLaw law(PredictiveOptions{}, drawing);
            std::mt19937_64 random(1);
            int dear = 0;  // frames, to learn what they cost
            for (std::int64_t frame = 0; frame < 200; ++frame) {
                const Decision decision = law.decide({target_ms, test_range, &forecast});
                const Plan plan = plan_at(forecast, test_range, decision.motion_distance, decision.splat_size);
                const double ms = plan_ms(plan, prices);
                const bool is_dear = plan[WorkKind::point] > 2 * fewest_points || ms > 1.5 * least_ms;
                ASSERT_FALSE(is_dear && frame < 12) << "frame " << frame << " of a guess";
                dear += is_dear ? 1 : 0;
                law.observe({frame, ms * std::exp(0.02 * normal(random)), decision, work_of(plan)});
            }
            EXPECT_LE(dear, PredictiveOptions{}.probes) << name_of(drawing) << ", a point " << point_ms << " ms";
        }
}

// Half as many points again look a fifth better, and what they cost is never known: times of frames that are drawn to
// learn it don't come.
TEST(PredictiveForecast, OutOfReachFinerDetailIsTriedAFewTimesEvenIfNothingIsLearned) {
    constexpr std::int64_t people = 1'000'000;
    const std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), people / 32, 0)};
    const std::vector<Step> shapes = {shape_step(0, 1'000 * people, 0, 0), shape_step(0.5, 0, 3 * people, 0.22),
                                      shape_step(1, 0, 2 * people, 0.28)};
    const Forecast forecast{Work{people}, motion, shapes};
    for (const double point_ms : {1.2e-4, 3e-5}) {
        const Prices prices{1, {2e-5, 8e-5, point_ms, 1e-6}};
        PredictiveLaw law;
        std::mt19937_64 random(1);
        int tried = 0;
        for (std::int64_t frame = 0; frame < 600; ++frame) {
            const Decision decision = law.decide({target_ms, test_range, &forecast});
            const Plan plan = plan_at(forecast, test_range, decision.motion_distance, decision.splat_size);
            if (decision.splat_size < 1)
                ++tried;
            else
                law.observe({frame, plan_ms(plan, prices) * std::exp(0.02 * normal(random)), decision, work_of(plan)});
        }
        EXPECT_EQ(tried, PredictiveOptions{}.probes) << point_ms << " ms";
    }
}

// The target is cut to where what is drawn takes just as long as detail may take, but the coarsest looks nearly as
// good.
TEST(PredictiveForecast, OutOfReachDetailIsLetGoThatIsNotWorthItsTime) {
    const std::vector<Step> motion = {motion_step(std::numeric_limits<double>::infinity(), 1000, 0)};
    const std::vector<Step> shapes = {shape_step(0, 100'000'000, 0, 0), shape_step(1, 0, 1'500'000, 0.001),
                                      shape_step(2, 0, 1'200'000, 0.002), shape_step(4, 0, 1'000'000, 0.003)};
    const Forecast forecast{Work{1000}, motion, shapes};
    const Prices prices{1, {0, 8e-5, 1e-5, 1e-6}};
    const double least_ms = plan_ms(cheapest_plan(forecast, test_range), prices);
    constexpr double before_ms = 13;
    constexpr std::int64_t cut = 100;
    for (double after_ms = 2; after_ms < 4; after_ms += 0.1) {
        PredictiveLaw law;
        std::mt19937_64 random(1);
        double ms = 0;
        for (std::int64_t frame = 0; frame <= cut; ++frame) {
            const Decision decision = law.decide({frame < cut ? before_ms : after_ms, test_range, &forecast});
            const Plan plan = plan_at(forecast, test_range, decision.motion_distance, decision.splat_size);
            if (frame == cut) {
                ASSERT_NEAR(ms, before_ms, 0.05 * before_ms);
            }
            ms = plan_ms(plan, prices);
            law.observe({frame, ms * std::exp(0.001 * normal(random)), decision, work_of(plan)});
        }
        EXPECT_LE(ms, 1.02 * least_ms) << after_ms << " ms";
    }
}

// What every frame has is the trouble, not people: their detail costs next to nothing, and stays.
TEST(PredictiveForecast, OutOfReachDetailThatCostsLittleIsKept) {
    Scene scene = scene_of(2000);
    scene.prices.frame = 1.5 * target_ms;
    PredictiveLaw law;
    const auto rows =
        run(law, ForecastLoop{[&](std::int64_t) -> const Scene& { return scene; }, constant(target_ms), 400, 0, 0.01});
    const Decision& decision = rows.back().decision;
    const Plan kept = plan_at(scene.forecast, test_range, decision.motion_distance, decision.splat_size);
    EXPECT_LE(kept.loss, 0.25 * cheapest_plan(scene.forecast, test_range).loss);
    EXPECT_LE(rows.back().frame_ms, 1.1 * scene.prices.frame);
}

// --- Anything at all.

double any_number(std::mt19937_64& random) {
    constexpr double odd[] = {0,
                              -1,
                              1e30,
                              -1e30,
                              5e-324,
                              1e-308,
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN(),
                              16.7,
                              200};
    const std::uint64_t pick = random() % 16;
    if (pick < std::size(odd)) return odd[pick];
    return pick < 14 ? uniform(random, 0, 1000) : std::bit_cast<double>(random());
}

std::int64_t any_count(std::mt19937_64& random) {
    constexpr std::int64_t odd[] = {
        0, -1, 1, 20'000, std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
    const std::uint64_t pick = random() % 8;
    return pick < std::size(odd) ? odd[pick] : static_cast<std::int64_t>(random() % 1'000'000);
}

Decision any_decision(std::mt19937_64& random) {
    return {static_cast<State>(random() % 3), any_number(random), any_number(random)};
}

void expect_sane(const Decision& decision, const char* when) {
    ASSERT_GT(decision.motion_distance, 0) << when;
    ASSERT_FALSE(std::isnan(decision.motion_distance)) << when;
    ASSERT_TRUE(decision.splat_size >= 0 && decision.splat_size <= max_splat_size) << when << decision.splat_size;
    const bool is_original = decision.state == State::original;
    ASSERT_TRUE(is_original ? decision == Decision{} : std::isfinite(decision.motion_distance)) << when;
    ASSERT_EQ(decision.splat_size > 0, decision.state == State::points) << when;
}

TEST(PredictiveLaw, NoInputMakesADecisionLeaveItsRange) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        std::mt19937_64 random(seed);
        PredictiveLaw law;
        for (int i = 0; i < 500; ++i) {
            std::vector<Step> motion(random() % 6);
            for (Step& step : motion) step = {any_number(random), Work{0, 0, 0, any_count(random)}, any_number(random)};
            std::vector<Step> shapes(random() % 6);
            for (Step& step : shapes)
                step = {any_number(random), Work{0, any_count(random), any_count(random)}, any_number(random)};
            const Forecast forecast{Work{any_count(random), 0, 0, 0, any_count(random), any_count(random)}, motion,
                                    shapes};
            const FrameSample sample{any_count(random),
                                     any_number(random),
                                     random() % 2 ? law.status().decision : any_decision(random),
                                     {any_count(random), any_count(random), any_count(random), any_count(random),
                                      any_count(random), any_count(random)}};
            law.observe(sample);
            expect_sane(law.decide({any_number(random), any_number(random), random() % 3 ? &forecast : nullptr}),
                        law.status().reason);
            if (HasFatalFailure()) FAIL() << "seed " << seed << " call " << i;
        }
    }
}

TEST(PredictiveLaw, BadTimesAreCountedAndIgnored) {
    PredictiveLaw law;
    const auto rows = run_knob(knob(toy, steady()), 10, 0);
    for (const double ms :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        law.observe({0, ms, {}, {}});
    }
    EXPECT_EQ(law.status().bad_samples, 4);
    EXPECT_EQ(law.status().last_ms, 0);
}

TEST(PredictiveLaw, AMillionFramesDoNotWearItOut) {
    constexpr std::int64_t frames = 1'000'000;
    PredictiveLaw law;
    std::mt19937_64 random(9);
    double sum = 0;
    Decision decision = law.decide({target_ms, test_range});
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        const double load = frame / 5000 % 2 ? 1.5 : 1.0;
        const double ms = load * toy(detail_of(decision, test_range)) * target_ms * (1 + uniform(random, -0.05, 0.05));
        law.observe({frame, ms, decision, {}});
        decision = law.decide({target_ms, test_range});
        if (frame >= frames - 10'000) sum += ms / 10'000;
    }
    EXPECT_NEAR(sum, target_ms, 0.02 * target_ms);
}

TEST(PredictiveLaw, TheSameCallsGiveTheSameBits) {
    const auto hash = [] {
        std::uint64_t value = 0xcbf29ce484222325u;
        const auto rows = run_knob(knob(toy, steady(), 0.03), 500, 2);
        for (const TraceRow& row : rows) {
            for (const double field : {row.decision.motion_distance, row.decision.splat_size})
                value = (value ^ std::bit_cast<std::uint64_t>(field)) * 0x100000001b3u;
        }
        return value;
    };
    EXPECT_EQ(hash(), hash());
}

TEST(PredictiveOptions, ABrokenRuleIsNamed) {
    PredictiveOptions options;
    options.caution = -1;
    try {
        PredictiveLaw law(options);
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("caution"), std::string::npos);
    }
}

}  // namespace
}  // namespace sfsm
