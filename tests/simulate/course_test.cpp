// The loop around a law: what it is told and when, and what only the oracle knows.
#include "sfsm/simulate/course.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sfsm/simulate/knob_plant.h"
#include "sfsm/simulate/metrics.h"
#include "sfsm/simulate/oracle.h"

namespace sfsm::simulate {
namespace {

// Writes down what it is told; decides a detail that changes in every frame.
class Scribe final : public Controller {
public:
    void observe(const FrameSample& sample) override {
        samples.push_back(sample);
        heard_before.push_back(static_cast<std::int64_t>(requests.size()));
    }
    Decision decide(const FrameRequest& request) override {
        requests.push_back(request);
        status_.decision = {State::points, 100, 1 + static_cast<double>(requests.size() % 7)};
        decisions.push_back(status_.decision);
        return status_.decision;
    }
    void reset() override {}
    const Status& status() const override { return status_; }

    std::vector<FrameSample> samples;
    std::vector<std::int64_t> heard_before;  // the decision of which frame
    std::vector<FrameRequest> requests;
    std::vector<Decision> decisions;

private:
    Status status_;
};

TEST(Course, TimesArriveAsLateAsTheScenarioSaysWithTheirOwnDecisionAndWork) {
    for (int delay = 0; delay <= 4; ++delay) {
        Scenario scenario = make_scenario("camera-cut");
        scenario.delay = delay;
        scenario.frames = 100;
        const Course course = make_course(scenario);
        Scribe scribe;
        std::vector<Outcome> outcomes;
        run(course, scribe, {}, outcomes);
        ASSERT_EQ(scribe.samples.size(), static_cast<std::size_t>(100 - 1 - delay));
        for (std::size_t i = 0; i < scribe.samples.size(); ++i) {
            const FrameSample& sample = scribe.samples[i];
            EXPECT_EQ(sample.frame, static_cast<std::int64_t>(i));
            EXPECT_EQ(scribe.heard_before[i], sample.frame + 1 + delay);
            EXPECT_EQ(sample.decision, scribe.decisions[i]);
            EXPECT_EQ(sample.work, scenario.plant->work(sample.frame, sample.decision));
            EXPECT_EQ(sample.ms, outcomes[i].ms);
        }
    }
}

TEST(Course, AsksWithTheTargetTheRangeAndTheForecastOfTheFrame) {
    Scenario scenario = make_scenario("target-step-forecast");
    const Course course = make_course(scenario);
    Scribe scribe;
    std::vector<Outcome> outcomes;
    run(course, scribe, {.seed = 1, .target_factor = 0.5, .now_us = {}}, outcomes);
    for (const std::size_t frame : {std::size_t{0}, std::size_t{599}, std::size_t{600}, std::size_t{1200}}) {
        const auto number = static_cast<std::int64_t>(frame);
        EXPECT_DOUBLE_EQ(scribe.requests[frame].target_ms, 0.5 * scenario.target.at(number));
        EXPECT_DOUBLE_EQ(outcomes[frame].target_ms, scenario.target.at(number)) << "it is judged by the user's";
        EXPECT_EQ(scribe.requests[frame].range, scenario.plant->range(number));
        EXPECT_EQ(scribe.requests[frame].forecast, scenario.plant->forecast(number));
    }
}

TEST(Course, TheSameSeedGivesTheSameRunAndAnotherAnother) {
    const Course course = make_course(make_scenario("toy"));
    const auto times = [&](std::uint64_t seed) {
        Scribe scribe;
        std::vector<Outcome> outcomes;
        run(course, scribe, {.seed = seed, .target_factor = 1, .now_us = {}}, outcomes);
        std::vector<double> ms;
        for (const Outcome& outcome : outcomes) ms.push_back(outcome.ms);
        return ms;
    };
    EXPECT_EQ(times(1), times(1));
    EXPECT_NE(times(1), times(2));
}

TEST(Oracle, IsOverTheToysTargetInAboutFivePercent) {
    const Course course = make_course(make_scenario("toy"));
    double over = 0, quality = 0;
    constexpr int seeds = 10;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Oracle oracle(course);
        std::vector<Outcome> outcomes;
        run(course, oracle, {.seed = seed, .target_factor = 1, .now_us = {}}, outcomes);
        const Metrics metrics = measure(course, outcomes);
        over += metrics.over_5pct / seeds;
        quality += metrics.quality / seeds;
    }
    EXPECT_GT(over, 0.035);
    EXPECT_LT(over, 0.065);
    // In closed form: the noise over 5 %, or a spike.
    const double noise_over = std::erfc(std::log(1.05) / 0.03 / std::sqrt(2.0)) / 2;
    EXPECT_NEAR(over, noise_over + 0.005 * (1 - noise_over), 0.004);
    EXPECT_DOUBLE_EQ(quality, 1);
}

TEST(Oracle, NeverCostsMoreThanItsAimWhereThatCanBeMet) {
    for (const std::string_view name : scenario_names()) {
        if (name.starts_with("cpu-bound") || name == "unreachable" || name.starts_with("out-of-reach")) continue;
        const Course course = make_course(make_scenario(name));
        for (std::size_t frame = 0; frame < course.best.size(); ++frame) {
            const double aim = course.scenario.oracle_aim * due_ms(course.scenario, static_cast<std::int64_t>(frame));
            ASSERT_LE(course.best[frame].cost_ms, (1 + 1e-6) * aim) << name << " frame " << frame;
        }
    }
}

}  // namespace
}  // namespace sfsm::simulate
