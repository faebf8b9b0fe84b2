#include "sfsm/simulate/scenario.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "sfsm/replay.h"

namespace sfsm::simulate {
namespace {

constexpr std::int64_t samples = 20'000;

TEST(Scenario, EveryNameMakesOneThatCanBeRun) {
    for (const std::string_view name : scenario_names()) {
        const Scenario scenario = make_scenario(name);
        EXPECT_EQ(scenario.name, name);
        EXPECT_FALSE(scenario.about.empty());
        EXPECT_GE(scenario.delay, 0);
        EXPECT_LE(scenario.delay, max_delay);
        EXPECT_LT(scenario.statistics_from, scenario.frames);
        for (const LoadStep& step : scenario.steps) EXPECT_LE(step.frames.end, scenario.frames) << name;
        for (const Frames& steady : scenario.steady) EXPECT_LE(steady.end, scenario.frames) << name;
        for (const Interruption& interruption : scenario.interruptions)
            EXPECT_GE(interruption.frames.begin, 60) << name;
        for (std::int64_t frame = 0; frame < scenario.frames; ++frame) {
            ASSERT_GT(scenario.plant->range(frame), 0) << name;
            ASSERT_GT(scenario.plant->cost_ms(frame, {}), 0) << name;
        }
    }
}

TEST(Scenario, AnUnknownNameIsAnsweredWithTheKnown) {
    try {
        make_scenario("bogus");
        FAIL() << "expected an exception";
    } catch (const std::invalid_argument& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("'bogus'"), std::string::npos) << message;
        for (const std::string_view name : scenario_names()) EXPECT_NE(message.find(name), std::string::npos) << name;
    }
}

// Whatever was decided, and so whichever law decided it.
TEST(Scenario, NoiseIsPaired) {
    const Scenario scenario = make_scenario("quiet-noisy");
    for (std::int64_t frame = 0; frame < 100; ++frame) {
        const double factor = measured_ms(scenario, 5, frame, 1);
        EXPECT_DOUBLE_EQ(measured_ms(scenario, 5, frame, 40), 40 * factor);
        EXPECT_NE(measured_ms(scenario, 6, frame, 1), factor);
    }
}

TEST(Scenario, NoiseIsLogNormalOfTheStatedSigma) {
    Scenario scenario = make_scenario("toy");
    scenario.spike_share = 0;
    double sum = 0, squares = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame) {
        const double logarithm = std::log(measured_ms(scenario, 1, frame, 10) / 10);
        sum += logarithm;
        squares += logarithm * logarithm;
    }
    const double five_sigma = 5 / std::sqrt(static_cast<double>(samples));
    EXPECT_NEAR(sum / samples, 0, five_sigma * scenario.noise);
    EXPECT_NEAR(std::sqrt(squares / samples), scenario.noise, five_sigma * scenario.noise);
}

TEST(Scenario, SpikesComeAsOftenAndAsHighAsStated) {
    Scenario scenario = make_scenario("spikes");
    scenario.noise = 0;
    const double target = scenario.target.at(0);
    double spikes = 0, height = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame) {
        const double on_top = (measured_ms(scenario, 1, frame, target) - target) / target;
        if (on_top == 0) continue;
        EXPECT_GE(on_top, scenario.spike_low - 1e-9);
        EXPECT_LE(on_top, scenario.spike_high + 1e-9);
        spikes += 1;
        height += on_top;
    }
    const double deviation = std::sqrt(scenario.spike_share / samples);
    EXPECT_NEAR(spikes / samples, scenario.spike_share, 5 * deviation);
    EXPECT_NEAR(height / spikes, (scenario.spike_low + scenario.spike_high) / 2, 0.1);
}

TEST(Scenario, VerticalSyncRoundsUpToWholeRefreshes) {
    Scenario scenario = make_scenario("vsync");
    scenario.noise = 0;
    const double refresh = scenario.refresh_ms;
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 0.1 * refresh), refresh);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 0.9 * refresh), refresh);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 1.1 * refresh), 2 * refresh);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 2.5 * refresh), 3 * refresh);
}

TEST(Scenario, InterruptionsTakeTheirTimeWhateverIsDrawn) {
    const Scenario hitch = make_scenario("hitch");
    EXPECT_EQ(measured_ms(hitch, 1, 600, 10), 4000);
    EXPECT_EQ(measured_ms(hitch, 2, 600, 20), 4000);
    EXPECT_LT(measured_ms(hitch, 1, 599, 10), 11);
    EXPECT_LT(measured_ms(hitch, 1, 601, 10), 11);
    const Scenario pause = make_scenario("pause");
    EXPECT_EQ(measured_ms(pause, 1, 600, 10), 0);
    EXPECT_TRUE(std::isnan(measured_ms(pause, 1, 606, 10)));
    EXPECT_TRUE(std::isinf(measured_ms(pause, 1, 618, 10)));
}

TEST(Scenario, ToyLoadStepsUpDownAndRamps) {
    const Scenario toy = make_scenario("toy");
    const double at_rest = toy.plant->cost_ms(0, {});
    const auto load = [&](std::int64_t frame) { return toy.plant->cost_ms(frame, {}) / at_rest; };
    EXPECT_DOUBLE_EQ(load(899), 1);
    EXPECT_DOUBLE_EQ(load(900), 1.6);
    EXPECT_DOUBLE_EQ(load(1799), 1.6);
    EXPECT_DOUBLE_EQ(load(1800), 1);
    EXPECT_DOUBLE_EQ(load(2700), 1);
    EXPECT_DOUBLE_EQ(load(3150), 1.25);
}

TEST(Scenario, NoFrameIsFasterThanACapAndSlowOnesDoNotWait) {
    Scenario scenario = make_scenario("frame-cap-5");
    scenario.noise = 0;
    const double cap = 1.05 * scenario.target.at(0);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 0.3 * cap), cap);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 0.99 * cap), cap);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 1.3 * cap), 1.3 * cap);
    EXPECT_DOUBLE_EQ(due_ms(scenario, 0), cap);
    scenario.cap_ms = 0.5 * cap;
    EXPECT_DOUBLE_EQ(due_ms(scenario, 0), scenario.target.at(0));
}

// A time is the difference of two stamps that are off by U(-1/2, 1/2) of the jitter.
TEST(Scenario, JitterIsOfTheStatedSpreadAndEvensOut) {
    Scenario scenario = make_scenario("vsync-jitter-3pct");
    scenario.noise = 0;
    EXPECT_NEAR(scenario.jitter_ms, 0.03 * scenario.refresh_ms, 1e-12);
    double sum = 0, squares = 0, most = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame) {
        const double off = measured_ms(scenario, 1, frame, 0.5 * scenario.refresh_ms) - scenario.refresh_ms;
        sum += off;
        squares += off * off;
        most = std::max(most, std::abs(off));
    }
    EXPECT_LE(std::abs(sum), scenario.jitter_ms + 1e-6) << "what one time has too much the next has too little";
    const double deviation = scenario.jitter_ms / std::sqrt(6.0);
    EXPECT_NEAR(std::sqrt(squares / samples), deviation, 0.05 * deviation);
    EXPECT_LE(most, scenario.jitter_ms);
    EXPECT_GT(most, 0.9 * scenario.jitter_ms);
}

TEST(Scenario, VariableRefreshShowsAtOnceWithinItsRange) {
    Scenario scenario = make_scenario("variable-refresh");
    scenario.noise = scenario.jitter_ms = 0;
    const double least = 1000.0 / 144, longest = 1000.0 / 48;
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 0.2 * least), least);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 1.7 * least), 1.7 * least);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, longest), longest);
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, longest + 0.1), longest + least) << "the last frame is shown again";
    EXPECT_DOUBLE_EQ(measured_ms(scenario, 1, 0, 2 * longest), 2 * longest);
}

TEST(Scenario, BurstsLastAsLongAsStated) {
    Scenario scenario = make_scenario("bursts");
    scenario.noise = 0;
    const double target = scenario.target.at(0);
    std::int64_t in_burst = 0;
    for (std::int64_t frame = 0; frame < 3000; ++frame) {
        const double on_top = measured_ms(scenario, 1, frame, target) / target - 1;
        if (on_top < 1e-9) continue;
        EXPECT_NEAR(on_top, 0.8, 1e-9);
        ++in_burst;
    }
    EXPECT_EQ(in_burst, 10 * 12);
}

TEST(Scenario, SwingingLoadsSwingByAThird) {
    for (const auto& [name, period] : {std::pair{"swing-100", 100}, {"swing-200", 200}, {"swing-400", 400}}) {
        const Scenario scenario = make_scenario(name);
        const double at_rest = scenario.plant->cost_ms(0, {});
        EXPECT_NEAR(scenario.plant->cost_ms(period / 2, {}) / at_rest, 4.0 / 3, 1e-9) << name;
        EXPECT_NEAR(scenario.plant->cost_ms(period, {}) / at_rest, 1, 1e-9) << name;
    }
}

TEST(Scenario, AHiddenCostMovesFromOneToSevenMilliseconds) {
    const Scenario scenario = make_scenario("hidden-cost");
    const Scenario plain = make_scenario("quiet-forecast");
    const auto hidden = [&](std::int64_t frame) {
        return scenario.plant->cost_ms(frame, {}) - plain.plant->cost_ms(frame, {});
    };
    EXPECT_NEAR(hidden(0), 1, 1e-9);
    EXPECT_NEAR(hidden(120), 7, 1e-9);
    EXPECT_NEAR(hidden(240), 1, 1e-9);
    EXPECT_EQ(scenario.plant->work(120, {}), plain.plant->work(120, {}));
}

TEST(Scenario, NothingMeetsATargetOutOfReach) {
    for (const char* name : {"out-of-reach", "out-of-reach-untold"}) {
        const Scenario scenario = make_scenario(name);
        const Decision coarsest = scenario.plant->optimum(0, 0);
        EXPECT_GT(scenario.plant->cost_ms(0, coarsest), 2.5 * scenario.target.at(0)) << name;
    }
}

}  // namespace
}  // namespace sfsm::simulate
