#include "sfsm/simulate/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

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

}  // namespace
}  // namespace sfsm::simulate
