// Recorded runs in a closed loop: what was recorded comes out again, and what wasn't follows from the work.
#include "sfsm/simulate/recorded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "sfsm/controller.h"
#include "sfsm/detail.h"
#include "sfsm/rate_plans.h"
#include "sfsm/simulate/course.h"
#include "sfsm/simulate/metrics.h"
#include "sfsm/simulate/noise.h"
#include "sfsm/simulate/work_plant.h"
#include "tests/sfsm/rate_scene.h"

namespace sfsm::simulate {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;
constexpr Prices true_prices{2, {1e-4, 1e-6, 3e-6, 5e-4}};

// Roams so that all that a camera changes does change.
std::vector<View> views() {
    std::vector<View> all;
    for (int i = 0; i < 100; ++i) {
        const double phase = 2 * 3.14159265358979 * i / 100;
        all.push_back({.people = std::round(15000 + 5000 * std::sin(phase)),
                       .range = 250 + 50 * std::cos(phase),
                       .farness = 3 + std::sin(2 * phase),
                       .theta = 0.1,
                       .triangles_each = 1000,
                       .points_each = 600 + 200 * std::cos(3 * phase),
                       .surface_px = 0.1});
    }
    return all;
}

Scenario original(OverFrames load = {}) {
    Scenario scenario;
    scenario.plant = std::make_shared<WorkPlant>(
        true_prices, views(), [](std::int64_t frame) { return static_cast<std::size_t>(frame % 100); },
        Unforeseen{.load = std::move(load)});
    scenario.target = TargetSchedule::parse("16,9@200");
    scenario.frames = 400;
    scenario.delay = 1;
    return scenario;
}

TraceRow row_of(const Plant& plant, std::int64_t frame, const Outcome& outcome) {
    TraceRow row;
    row.frame = 1000 + 2 * frame;  // numbers of a recording start anywhere
    row.target_ms = outcome.target_ms;
    row.frame_ms = outcome.ms;
    row.decision = outcome.decision;
    row.range = plant.range(frame);
    row.work = plant.work(frame, outcome.decision);
    const Forecast& forecast = *plant.forecast(frame);
    row.motion.assign(forecast.motion.begin(), forecast.motion.end());
    row.shapes.assign(forecast.shapes.begin(), forecast.shapes.end());
    row.rates.assign(forecast.rates.begin(), forecast.rates.end());
    return row;
}

std::vector<Outcome> closed_loop(const Scenario& scenario, std::string_view law) {
    std::vector<Outcome> outcomes;
    run(make_course(scenario), *make_controller(law), {}, outcomes);
    return outcomes;
}

std::vector<TraceRow> trace_of(const Scenario& scenario, std::string_view law) {
    const std::vector<Outcome> outcomes = closed_loop(scenario, law);
    std::vector<TraceRow> rows;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
        rows.push_back(row_of(*scenario.plant, static_cast<std::int64_t>(i), outcomes[i]));
    return rows;
}

// Every frame drawn as it happens: all three states, sizes and distances between all steps.
std::vector<TraceRow> trace_of_any_decisions(const Scenario& scenario) {
    std::vector<TraceRow> rows;
    for (std::int64_t frame = 0; frame < scenario.frames; ++frame) {
        Outcome outcome;
        outcome.target_ms = 16;
        const double range = scenario.plant->range(frame);
        const double distance = range * (0.05 + 0.95 * uniform_at(3, frame, Stream::noise));
        const double size = 0.5 * std::exp2(6 * uniform_at(3, frame, Stream::spike));
        const Decision decisions[] = {{}, {State::slowed, distance, 0}, {State::points, distance, size}};
        outcome.decision = decisions[frame % 3];
        outcome.ms = scenario.plant->cost_ms(frame, outcome.decision);
        rows.push_back(row_of(*scenario.plant, frame, outcome));
    }
    return rows;
}

std::vector<TraceRow> foreign_rows(std::size_t count) {
    std::vector<TraceRow> rows(count);
    for (std::size_t i = 0; i < count; ++i) {
        rows[i].frame = static_cast<std::int64_t>(i);
        rows[i].target_ms = 12;
        rows[i].frame_ms = 16 + 4 * std::sin(1e-3 * static_cast<double>(i));
    }
    return rows;
}

// The bowl by rate, frame by frame of another size, each drawn at one of the rates in turn or by D and S.
std::vector<TraceRow> rows_with_rates(int every_how_many_by_pair = 4) {
    std::vector<TraceRow> rows;
    for (int i = 0; i < 300; ++i) {
        const RateScene scene = bowl(20'000 + 8'000 * std::sin(0.05 * i));
        TraceRow& row = rows.emplace_back();
        row.frame = i;
        row.target_ms = 14;
        row.range = test_range;
        row.motion = scene.motion;
        row.shapes = scene.shapes;
        row.rates = scene.rates;
        const bool is_by_pair = i % every_how_many_by_pair == 0;
        if (is_by_pair) {
            const std::size_t step = 1 + i % 20;
            row.decision = {State::points, scene.motion[2].setting, scene.shapes[step].setting};
            row.work = scene.forecast.frame;
            row.work += scene.motion[2].work;
            row.work += scene.shapes[step].work;
        } else {
            row.decision.rate = scene.rates[static_cast<std::size_t>(i) % scene.rates.size()].rate;
            row.decision = RatePlans(scene.forecast, test_range).renewed(row.decision);
            row.work = scene.work(row.decision);
        }
        row.frame_ms = scene.ms(row.work);
    }
    return rows;
}

constexpr RecordedOptions own{.delay = 1, .has_work = true};
constexpr RecordedOptions foreign{.delay = 2, .has_work = false};

TEST(Recorded, TheRecordedDecisionsTakeTheRecordedTimes) {
    const std::vector<TraceRow> rows = trace_of_any_decisions(original());
    for (const RecordedOptions& options : {own, foreign}) {
        const Scenario scenario = recorded_scenario(rows, options);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto frame = static_cast<std::int64_t>(i);
            Decision decision = rows[i].decision;
            if (!options.has_work) decision.motion_distance *= scenario.plant->range(frame) / rows[i].range;
            const double cost_ms = scenario.plant->cost_ms(frame, decision);
            EXPECT_NEAR(cost_ms, rows[i].frame_ms, rounding * rows[i].frame_ms) << i;
            EXPECT_EQ(measured_ms(scenario, 1, frame, cost_ms), cost_ms);
        }
    }
}

TEST(Recorded, OtherDecisionsTakeWhatTheRecordedRendererWouldHaveTaken) {
    const Scenario truth =
        original([](std::int64_t frame) { return 1 + 0.3 * std::sin(0.1 * static_cast<double>(frame)); });
    std::vector<TraceRow> rows = trace_of_any_decisions(original());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto frame = static_cast<std::int64_t>(i);
        // Recorded at a step, or the load would carry the interpolation.
        const auto step = static_cast<std::size_t>(frame % 12 + 1);
        Decision& decision = rows[i].decision;
        if (decision.state != State::original) decision.motion_distance = rows[i].motion[step].setting;
        if (decision.state == State::points) decision.splat_size = rows[i].shapes[step].setting;
        rows[i].work = truth.plant->work(frame, decision);
        rows[i].frame_ms = truth.plant->cost_ms(frame, decision);
    }
    const Scenario scenario = recorded_scenario(rows, own);
    double worst_at = 0, worst_between = 0;
    for (std::int64_t frame = 0; frame < scenario.frames; ++frame) {
        const TraceRow& row = rows[static_cast<std::size_t>(frame)];
        const auto off = [&](const Decision& decision) {
            return std::abs(scenario.plant->cost_ms(frame, decision) / truth.plant->cost_ms(frame, decision) - 1);
        };
        for (std::size_t m = 1; m < row.motion.size(); ++m) {
            const double at = row.motion[m].setting;
            const double between = 0.5 * (at + std::min(row.range, row.motion[m - 1].setting));
            worst_at =
                std::max({worst_at, off({State::slowed, at, 0}), off({State::points, at, row.shapes[9].setting})});
            worst_between =
                std::max({worst_between, off({State::slowed, between, 0}), off({State::points, between, 3})});
        }
    }
    // The fit's own error, for loads that sway by 30 % are noise to it: 2.5 %.
    EXPECT_LT(worst_at, 0.05);
    EXPECT_LT(worst_between, 0.05);
}

TEST(Recorded, WithoutALoadOtherDecisionsTakeWhatTheyWouldHaveTaken) {
    const Scenario truth = original();
    const Scenario scenario = recorded_scenario(trace_of_any_decisions(truth), own);
    double worst_at = 0, worst_between = 0;
    for (std::int64_t frame = 0; frame < scenario.frames; ++frame) {
        const Forecast& forecast = *truth.plant->forecast(frame);
        const double range = truth.plant->range(frame);
        for (std::size_t m = 1; m < forecast.motion.size(); ++m) {
            const double at = forecast.motion[m].setting;
            const double between = 0.5 * (at + std::min(range, forecast.motion[m - 1].setting));
            for (const auto& [distance, worst] : {std::pair{at, &worst_at}, std::pair{between, &worst_between}}) {
                const Decision decision{State::points, distance, forecast.shapes[9].setting};
                const double off = scenario.plant->cost_ms(frame, decision) / truth.plant->cost_ms(frame, decision) - 1;
                *worst = std::max(*worst, std::abs(off));
            }
        }
    }
    // Recorded were distances between the steps, so each load carries what the interpolation of that frame is off: 1 %.
    EXPECT_LT(worst_at, 0.02);
    EXPECT_LT(worst_between, 0.02);
}

TEST(Recorded, TellsTheLawWhatTheTraceTold) {
    const std::vector<TraceRow> rows = trace_of_any_decisions(original());
    const Scenario scenario = recorded_scenario(rows, own);
    EXPECT_EQ(scenario.frames, std::ssize(rows));
    EXPECT_EQ(scenario.delay, own.delay);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto frame = static_cast<std::int64_t>(i);
        const Forecast& forecast = *scenario.plant->forecast(frame);
        EXPECT_TRUE(std::equal(forecast.motion.begin(), forecast.motion.end(), rows[i].motion.begin()));
        EXPECT_TRUE(std::equal(forecast.shapes.begin(), forecast.shapes.end(), rows[i].shapes.begin()));
        EXPECT_EQ(forecast.frame, only_on<WorkAxis::frame>(rows[i].work));
        EXPECT_EQ(scenario.plant->range(frame), rows[i].range);
        EXPECT_EQ(scenario.target.at(frame), rows[i].target_ms);
    }
}

TEST(Recorded, WorkAndDetailAreTheForecastsAtItsSteps) {
    const std::vector<TraceRow> rows = trace_of_any_decisions(original());
    const Scenario scenario = recorded_scenario(rows, own);
    const TraceRow& row = rows[5];
    for (const Step& motion : row.motion) {
        for (const Step& splat : row.shapes) {
            const Decision decision{splat.setting > 0 ? State::points : State::slowed, motion.setting, splat.setting};
            EXPECT_EQ(scenario.plant->work(5, decision),
                      (Work{row.work[WorkKind::person], splat.work[WorkKind::triangle], splat.work[WorkKind::point],
                            motion.work[WorkKind::motion_update], 0, 0, splat.work[WorkKind::single]}));
            EXPECT_NEAR(scenario.plant->detail(5, decision), 1 / (1 + motion.loss_px + splat.loss_px), rounding);
        }
    }
    EXPECT_EQ(scenario.plant->work(5, {}), scenario.plant->work(5, {State::slowed, infinity, 0}));
    EXPECT_EQ(scenario.plant->detail(5, {}), 1);
}

TEST(Recorded, NothingFinerThanTheOptimumMeetsTheLimit) {
    // Between steps the optimum is taken for linear where it is a power: 1.5 % of the cost of points.
    constexpr double least_gain = 0.01;
    const std::vector<TraceRow> rows = trace_of_any_decisions(original());
    for (const RecordedOptions& options : {own, foreign}) {
        const Scenario scenario = recorded_scenario(rows, options);
        const Plant& plant = *scenario.plant;
        for (const std::int64_t frame : {std::int64_t{0}, std::int64_t{37}}) {
            for (const double share : {0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 1.0}) {
                const double limit_ms = std::max(share * plant.cost_ms(frame, {}),
                                                 plant.cost_ms(frame, {State::points, 1e-3, max_splat_size}));
                const Decision best = plant.optimum(frame, limit_ms);
                EXPECT_LE(plant.cost_ms(frame, best), (1 + 1e-9) * limit_ms);
                for (int i = 1; i <= 60; ++i) {
                    for (int j = 0; j <= 60; ++j) {
                        const Decision decision{j == 0 ? State::slowed : State::points, plant.range(frame) * i / 60,
                                                j == 0 ? 0 : 0.4 * std::exp2(j / 9.5)};
                        if (plant.cost_ms(frame, decision) > limit_ms) continue;
                        EXPECT_LE(plant.detail(frame, decision), plant.detail(frame, best) + least_gain);
                    }
                }
            }
        }
    }
}

TEST(Recorded, TheOptimumOutOfReachIsAsCheapAsCanBe) {
    const std::vector<TraceRow> rows = trace_of_any_decisions(original());
    const Scenario scenario = recorded_scenario(rows, own);
    const Plant& plant = *scenario.plant;
    const double least_ms = plant.cost_ms(0, {State::points, 1e-3, max_splat_size});
    EXPECT_LE(plant.cost_ms(0, plant.optimum(0, 1e-3)), (1 + 1e-9) * least_ms);
    EXPECT_EQ(plant.optimum(0, infinity), Decision{});
}

TEST(ReferenceCrowd, ItsStatesCostAboutOneAThirdAndATenth) {
    const std::vector<TraceRow> rows = foreign_rows(100);
    const Scenario scenario = recorded_scenario(rows, foreign);
    const double range = scenario.plant->range(50), load = rows[50].frame_ms;
    EXPECT_NEAR(scenario.plant->cost_ms(50, {}), load, rounding * load);
    EXPECT_NEAR(scenario.plant->cost_ms(50, {State::slowed, 0.75 * range, 0}), load / 3, 0.1 * load / 3);
    EXPECT_NEAR(scenario.plant->cost_ms(50, {State::points, range / 6, 1.5}), load / 10, 0.1 * load / 10);
    EXPECT_EQ(scenario.plant->forecast(50)->frame[WorkKind::person], 20000);
}

TEST(ReferenceCrowd, AMillionFramesAreACourse) {
    const std::vector<TraceRow> rows = foreign_rows(1'000'000);
    EXPECT_EQ(make_course(recorded_scenario(rows, foreign)).best.size(), rows.size());
}

TEST(Recorded, RowsWithoutATimeHaveTheLoadOfTheLastOneBefore) {
    std::vector<TraceRow> rows = foreign_rows(40);
    for (const std::size_t i : {0U, 1U, 20U, 21U}) rows[i].frame_ms = none;
    rows[22].frame_ms = 1e30;
    rows[2].frame_ms = 30;
    rows[19].frame_ms = 50;
    const Scenario scenario = recorded_scenario(rows, foreign);
    const Plant& plant = *scenario.plant;
    EXPECT_NEAR(plant.cost_ms(0, {}), 30, 1e-9);
    EXPECT_NEAR(plant.cost_ms(1, {}), 30, 1e-9);
    EXPECT_NEAR(plant.cost_ms(20, {}), 50, 1e-9);
    EXPECT_NEAR(plant.cost_ms(22, {}), 50, 1e-9);
    EXPECT_NEAR(plant.cost_ms(23, {}), rows[23].frame_ms, 1e-9);
}

TEST(Recorded, OwnRowsWithoutAForecastHaveTheOneBefore) {
    std::vector<TraceRow> rows = trace_of_any_decisions(original());
    for (const std::size_t i : {0U, 50U}) rows[i].motion.clear();
    std::reverse(rows[51].motion.begin(), rows[51].motion.end());
    rows[52].shapes[3].loss_px = infinity;
    const Scenario scenario = recorded_scenario(rows, own);
    const Plant& plant = *scenario.plant;
    EXPECT_EQ(plant.forecast(0), plant.forecast(1));
    for (const std::int64_t frame : {50, 51, 52}) EXPECT_EQ(plant.forecast(frame), plant.forecast(49));
    EXPECT_NE(plant.forecast(53), plant.forecast(49));
}

TEST(Recorded, OwnRowsWithoutAnyForecastAreTheReferenceCrowds) {
    std::vector<TraceRow> rows = trace_of_any_decisions(original());
    for (TraceRow& row : rows) row.motion.clear();
    const Scenario scenario = recorded_scenario(rows, own);
    const Plant& plant = *scenario.plant;
    EXPECT_EQ(plant.forecast(7)->frame[WorkKind::person], 20000);
    Decision decision = rows[7].decision;
    decision.motion_distance *= plant.range(7) / rows[7].range;
    EXPECT_NEAR(plant.cost_ms(7, decision), rows[7].frame_ms, 1e-9);
}

TEST(Recorded, SaysWhatIsMissing) {
    EXPECT_THROW(recorded_scenario({}, foreign), std::runtime_error);
    std::vector<TraceRow> timeless = foreign_rows(20);
    for (TraceRow& row : timeless) row.frame_ms = none;
    EXPECT_THROW(recorded_scenario(timeless, foreign), std::runtime_error);
    std::vector<TraceRow> aimless = foreign_rows(20);
    aimless[7].target_ms = none;
    EXPECT_THROW(recorded_scenario(aimless, foreign), std::invalid_argument);
    std::vector<TraceRow> few = trace_of_any_decisions(original());
    few.resize(10);
    EXPECT_THROW(recorded_scenario(few, own), std::runtime_error);
}

TEST(Recorded, ThePredictiveLawHoldsTheTargetWhenTheLoadDoubles) {
    std::vector<TraceRow> rows = foreign_rows(1000);
    for (TraceRow& row : rows) {
        row.target_ms = 8;
        row.frame_ms = row.frame < 500 ? 16 : 32;
    }
    for (const bool has_work : {false, true}) {
        if (has_work) {
            rows = trace_of(original([](std::int64_t frame) { return frame < 200 ? 1.0 : 2.0; }), "predictive");
            for (TraceRow& row : rows) row.target_ms = 14;
        }
        const Scenario scenario = recorded_scenario(rows, {.delay = 2, .has_work = has_work});
        const Course course = make_course(scenario);
        std::vector<Outcome> outcomes;
        run(course, *make_controller("predictive"), {}, outcomes);
        int held = 0, judged = 0;
        for (std::int64_t frame = 50; frame < scenario.frames; ++frame) {
            const Outcome& outcome = outcomes[static_cast<std::size_t>(frame)];
            ++judged;
            held += std::abs(outcome.ms / outcome.target_ms - 1) <= 0.1 ? 1 : 0;
        }
        EXPECT_GT(held, 0.95 * judged) << (has_work ? "own" : "foreign");
        EXPECT_GT(measure(course, outcomes).quality, 0.9);
    }
}

TEST(Recorded, TheLawThatRecordedItDoesItAgain) {
    for (const std::string_view law : law_names()) {
        const Scenario truth = original();
        const std::vector<TraceRow> rows = trace_of(truth, law);
        const std::vector<Outcome> outcomes = closed_loop(recorded_scenario(rows, own), law);
        double off = 0;
        for (std::size_t i = 0; i < rows.size(); ++i)
            off += std::abs(outcomes[i].ms / rows[i].frame_ms - 1) / static_cast<double>(rows.size());
        EXPECT_LT(off, 1e-3) << law;
    }
}

TEST(Recorded, AnotherLawDoesAnother) {
    const Scenario truth = original();
    const std::vector<TraceRow> rows = trace_of(truth, "paper");
    const Scenario scenario = recorded_scenario(rows, own);
    const std::vector<Outcome> paper = closed_loop(scenario, "paper"), ours = closed_loop(scenario, "predictive");
    // As it would have gone in the renderer itself.
    const std::vector<Outcome> real = closed_loop(truth, "predictive");
    double paper_off = 0, ours_off = 0, real_off = 0;
    for (std::size_t i = 50; i < rows.size(); ++i) {
        const double target_ms = ours[i].target_ms;
        paper_off += std::abs(paper[i].ms / target_ms - 1) / static_cast<double>(rows.size() - 50);
        ours_off += std::abs(ours[i].ms / target_ms - 1) / static_cast<double>(rows.size() - 50);
        real_off += std::abs(real[i].ms / target_ms - 1) / static_cast<double>(rows.size() - 50);
    }
    EXPECT_GT(paper_off, 0.10);
    EXPECT_LT(ours_off, 0.01);
    EXPECT_NEAR(ours_off, real_off, 0.002);
}

TEST(Recorded, HostileRowsGiveFiniteCosts) {
    const double numbers[] = {none, infinity, -infinity, 0, -1, 1e30, 5e-324, 1e308, 16, 0.5};
    constexpr std::int64_t counts[] = {
        0, 1, -5, 20000, std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
    std::mt19937 random(9);
    const auto number = [&] { return numbers[random() % std::size(numbers)]; };
    const auto count = [&] { return counts[random() % std::size(counts)]; };
    const std::vector<TraceRow> by_pairs = trace_of_any_decisions(original()), by_rates = rows_with_rates();
    for (int round = 0; round < 300; ++round) {
        std::vector<TraceRow> rows = round % 2 == 0 ? by_pairs : by_rates;
        rows.resize(60);
        for (int blow = 0; blow < 200; ++blow) {
            TraceRow& row = rows[random() % rows.size()];
            switch (random() % 15) {
                case 0:
                    row.frame_ms = number();
                    break;
                case 1:
                    row.range = number();
                    break;
                case 2:
                    row.decision.motion_distance = number();
                    break;
                case 3:
                    row.decision.splat_size = number();
                    break;
                case 4:
                    row.work = {count(), count(), count(), count()};
                    break;
                case 5:
                    row.motion.clear();
                    break;
                case 6:
                    row.shapes.resize(random() % 3);
                    break;
                case 7:
                    row.motion.assign(1, {number(), Work{0, 0, 0, count()}, number()});
                    break;
                case 8:
                    row.shapes.assign(2, {number(), Work{0, count(), count()}, number()});
                    break;
                case 9:
                    row.frame = count();
                    break;
                case 10:
                    row.decision.state = static_cast<State>(random() % 3);
                    break;
                case 11:
                    row.decision.rate = number();
                    break;
                case 12:
                    row.rates.resize(random() % 3);
                    break;
                case 13:
                    row.rates.assign(1, {number(), State::points, number(), number(), Work{0, count()}, number()});
                    break;
                default:
                    row.frame_ms *= 50;
                    break;
            }
        }
        for (const RecordedOptions& options : {own, foreign}) {
            const Scenario scenario = recorded_scenario(rows, options);
            const std::vector<Outcome> outcomes = closed_loop(scenario, "predictive");
            for (std::int64_t frame = 0; frame < scenario.frames; ++frame) {
                const Decision decision{static_cast<State>(random() % 3), number(), number(), number()};
                for (const double cost_ms :
                     {scenario.plant->cost_ms(frame, decision), outcomes[static_cast<std::size_t>(frame)].cost_ms}) {
                    ASSERT_TRUE(std::isfinite(cost_ms) && cost_ms > 0) << "round " << round << " frame " << frame;
                }
                const double detail = scenario.plant->detail(frame, decision);
                ASSERT_TRUE(detail > 0 && detail <= 1);
                const double best_ms = scenario.plant->cost_ms(frame, scenario.plant->optimum(frame, 16));
                ASSERT_TRUE(std::isfinite(best_ms) && best_ms > 0);
            }
        }
    }
}

TEST(Recorded, TheSameRowsGiveTheSameBits) {
    const std::vector<TraceRow> rows = trace_of(original(), "predictive");
    const auto times = [&] {
        std::vector<std::uint64_t> bits;
        for (const Outcome& outcome : closed_loop(recorded_scenario(rows, own), "predictive"))
            bits.push_back(std::bit_cast<std::uint64_t>(outcome.ms));
        return bits;
    };
    EXPECT_EQ(times(), times());
}

// --- Rates.

TEST(RecordedRates, TheRecordedDecisionsTakeTheRecordedTimesAndWork) {
    const std::vector<TraceRow> rows = rows_with_rates();
    const Scenario scenario = recorded_scenario(rows, own);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto frame = static_cast<std::int64_t>(i);
        EXPECT_NEAR(scenario.plant->cost_ms(frame, rows[i].decision), rows[i].frame_ms, rounding * rows[i].frame_ms);
        EXPECT_EQ(scenario.plant->work(frame, rows[i].decision), rows[i].work) << i;
        EXPECT_EQ(scenario.plant->forecast(frame)->rates.size(), rows[i].rates.size());
    }
}

TEST(RecordedRates, OtherRatesTakeWhatTheRecordedRendererWouldHaveTaken) {
    const std::vector<TraceRow> rows = rows_with_rates();
    const Scenario scenario = recorded_scenario(rows, own);
    for (std::int64_t frame = 0; frame < scenario.frames; frame += 7) {
        const RateScene scene = bowl(20'000 + 8'000 * std::sin(0.05 * static_cast<double>(frame)));
        for (const RateStep& step : scene.rates) {
            Decision decision;
            decision.rate = step.rate;
            const double ms = scene.ms(step);
            EXPECT_NEAR(scenario.plant->cost_ms(frame, decision), ms, 0.03 * ms) << frame;
            EXPECT_NEAR(scenario.plant->detail(frame, decision), 0.05 / (0.05 + step.loss), rounding);
        }
    }
}

TEST(RecordedRates, NoDecisionByDistanceAndSizeKeepsMoreThanTheBestRateOfItsTime) {
    const std::vector<TraceRow> rows = rows_with_rates();
    const Scenario scenario = recorded_scenario(rows, own);
    const Plant& plant = *scenario.plant;
    for (const std::int64_t frame : {0, 1, 77}) {
        double before = 2;
        for (const Step& shape : rows[static_cast<std::size_t>(frame)].shapes) {
            const Decision decision{shape.setting > 0 ? State::points : State::slowed, 120, shape.setting};
            const double detail = plant.detail(frame, decision);
            const Decision best = plant.optimum(frame, plant.cost_ms(frame, decision));
            EXPECT_GT(best.rate, 0);
            EXPECT_LE(detail, plant.detail(frame, best) * (1 + 1e-9)) << shape.setting;
            EXPECT_LE(detail, before * (1 + 1e-9)) << "coarser splats lose no less";
            before = detail;
        }
        EXPECT_EQ(plant.detail(frame, {}), 1);
    }
}

TEST(RecordedRates, TheOptimumIsTheFinestRateThatFits) {
    const std::vector<TraceRow> rows = rows_with_rates();
    const Scenario scenario = recorded_scenario(rows, own);
    const Plant& plant = *scenario.plant;
    for (const double limit_ms : {7.0, 10.0, 15.0, 20.0}) {
        const Decision best = plant.optimum(5, limit_ms);
        EXPECT_LE(plant.cost_ms(5, best), limit_ms * (1 + 1e-9));
        for (const RateStep& step : rows[5].rates) {
            Decision decision;
            decision.rate = step.rate;
            if (plant.cost_ms(5, decision) > limit_ms) continue;
            EXPECT_GE(plant.detail(5, best), plant.detail(5, decision));
        }
    }
}

TEST(RecordedRates, EveryLawsLoopIsClosedAndTheRateHoldsTheTargetFinest) {
    std::vector<TraceRow> rows = rows_with_rates();
    const Course course = make_course(recorded_scenario(rows, own));
    std::vector<Outcome> outcomes;
    double by_rate = 0;
    for (const std::string_view law : law_names()) {
        run(course, *make_controller(law), {}, outcomes);
        const Metrics metrics = measure(course, outcomes);
        EXPECT_GT(metrics.control_rate, 0.5) << law;
        EXPECT_LE(metrics.quality, 1 + 1e-6) << law;
        if (law == "predictive") by_rate = metrics.quality;
    }
    run(course, *make_controller("predictive"), {}, outcomes);
    EXPECT_GT(outcomes.back().decision.rate, 0);
    EXPECT_GT(measure(course, outcomes).within_10pct, 0.9);
    EXPECT_GT(by_rate, 0.97);
}

TEST(RecordedRates, ARowWithoutRatesIsDrawnByWhatTheRateComesTo) {
    std::vector<TraceRow> rows = rows_with_rates(2);
    for (std::size_t i = 100; i < rows.size(); ++i) rows[i].rates.clear();
    const Scenario scenario = recorded_scenario(rows, own);
    const Decision by_rate{State::points, 120, 2, 1e-9}, by_pair{State::points, 120, 2};
    EXPECT_NE(scenario.plant->cost_ms(50, by_rate), scenario.plant->cost_ms(50, by_pair));
    EXPECT_EQ(scenario.plant->cost_ms(150, by_rate), scenario.plant->cost_ms(150, by_pair));
    EXPECT_EQ(scenario.plant->detail(150, by_rate), scenario.plant->detail(150, by_pair));
}

TEST(RecordedRates, UnsoundRatesAreReplacedByThoseOfTheRowBefore) {
    std::vector<TraceRow> rows = rows_with_rates();
    std::swap(rows[50].rates[3], rows[50].rates[4]);
    rows[51].rates[3].loss = none;
    rows[52].rates[3].rate = infinity;
    rows[53].rates[3].splat_size = 99;
    rows[54].rates[3].motion_distance = 0;
    rows[55].rates[3].work.counts[2] = -1;
    rows[56].rates[3].loss = 0.9;
    const Scenario scenario = recorded_scenario(rows, own);
    for (const std::int64_t frame : {50, 51, 52, 53, 54, 55, 56})
        EXPECT_EQ(scenario.plant->forecast(frame), scenario.plant->forecast(49)) << frame;
    EXPECT_NE(scenario.plant->forecast(57), scenario.plant->forecast(49));
}

TEST(Recorded, AShortRunIsJudgedFromItsTenthOn) {
    EXPECT_EQ(recorded_scenario(foreign_rows(100), foreign).statistics_from, 10);
    EXPECT_EQ(recorded_scenario(foreign_rows(10000), foreign).statistics_from, 200);
}

}  // namespace
}  // namespace sfsm::simulate
