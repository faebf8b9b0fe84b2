// The default law behind displays and caps of any rate, with and without jitter.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "sfsm/controller.h"
#include "sfsm/simulate/knob_scenarios.h"
#include "sfsm/simulate/metrics.h"

namespace sfsm::simulate {
namespace {

constexpr int seeds = 4;

std::vector<Metrics> run_all(const Scenario& scenario) {
    const Course course = make_course(scenario);
    std::vector<Metrics> all;
    for (int seed = 1; seed <= seeds; ++seed) {
        std::vector<Outcome> outcomes;
        RunOptions options;
        options.seed = static_cast<std::uint64_t>(seed);
        run(course, *make_controller("predictive"), options, outcomes);
        all.push_back(measure(course, outcomes));
    }
    return all;
}

TargetSchedule target_of(double ms) {
    std::ostringstream text;
    text.precision(17);
    text << ms;
    return TargetSchedule::parse(text.str());
}

// Full detail takes 1.5 refreshes of those that fit, and for a third of the frames 1.6 times that.
Scenario synced(double hz, double jitter, double targets, int fitting) {
    const double period_ms = 1000 / hz, due_ms = fitting * period_ms;
    KnobModel model = model_of(raised(episode, 1.6));
    model.nominal_ms = due_ms;
    Scenario scenario = knob_scenario("sync", std::move(model), usual_noise, episode_frames);
    scenario.target = target_of(targets * period_ms);
    scenario.refresh_ms = period_ms;
    scenario.jitter_ms = jitter * period_ms;
    scenario.oracle_aim = 0.94 * due_ms / (targets * period_ms);
    return scenario;
}

struct Sync {
    double targets;  // [refreshes]
    int fitting;     // whole refreshes that do
};

TEST(DefaultLawBehindADisplay, HoldsWhatFitsTheTargetInEverySeed) {
    for (const double hz : {50.0, 60.0, 72.0, 90.0, 120.0, 144.0, 165.0}) {
        for (const double jitter : {0.0, 0.008, 0.03}) {
            for (const Sync sync : {Sync{0.985, 1}, Sync{1, 1}, Sync{1.02, 1}, Sync{2, 2}, Sync{2.4, 2}}) {
                for (const Metrics& metrics : run_all(synced(hz, jitter, sync.targets, sync.fitting))) {
                    const std::string at = std::to_string(hz) + " Hz, jitter " + std::to_string(jitter) + ", target " +
                                           std::to_string(sync.targets);
                    EXPECT_LE(metrics.over_5pct, 0.08) << at;
                    EXPECT_GE(metrics.quality, 0.85) << at;
                }
            }
        }
    }
}

TEST(DefaultLawBehindADisplay, LosesNothingByJitter) {
    const auto mean = [](const Scenario& scenario, double Metrics::*figure) {
        double sum = 0;
        for (const Metrics& metrics : run_all(scenario)) sum += metrics.*figure / seeds;
        return sum;
    };
    const Scenario exact = synced(60, 0, 1, 1), jittery = synced(60, 0.03, 1, 1);
    EXPECT_GE(mean(jittery, &Metrics::quality), mean(exact, &Metrics::quality) - 0.03);
    EXPECT_LE(mean(jittery, &Metrics::over_5pct), mean(exact, &Metrics::over_5pct) + 0.03);
    EXPECT_GE(mean(exact, &Metrics::quality), 0.92);
    EXPECT_LE(mean(exact, &Metrics::over_5pct), 0.045);
}

TEST(DefaultLawUnderACap, TakesWaitingForNoLoadAndMoreLoadForLoad) {
    for (const double cap : {1.02, 1.035, 1.05, 1.07, 1.1}) {
        for (const double heavy : {1.2, 1.6, 2.5}) {
            Scenario scenario = knob_scenario(
                "cap", model_of([=](std::int64_t frame) { return episode.contains(frame) ? heavy : 0.5; }), usual_noise,
                2400);
            scenario.cap_ms = cap * frame_ms;
            scenario.regained = {{0, episode.begin}, {episode.end, scenario.frames}};
            scenario.regained_share = 0.99;
            for (const Metrics& metrics : run_all(scenario)) {
                ASSERT_TRUE(metrics.regain) << "cap " << cap << ", load " << heavy;
                EXPECT_LE(*metrics.regain, 120) << "cap " << cap << ", load " << heavy;
                EXPECT_LE(metrics.over_5pct, 0.03) << "cap " << cap << ", load " << heavy;
                EXPECT_GE(metrics.quality, 0.93) << "cap " << cap << ", load " << heavy;
            }
        }
    }
}

TEST(DefaultLawBehindADisplay, OfVariableRefreshIsNearlyAsFineAsWithoutOne) {
    for (const double hz : {90.0, 120.0, 165.0}) {
        KnobModel model = model_of(raised(episode, 1.6));
        model.nominal_ms = 1000 / hz;
        Scenario scenario = knob_scenario("variable refresh", std::move(model), usual_noise, episode_frames);
        scenario.target = target_of(1000 / hz);
        scenario.refresh_ms = 1000 / hz;
        scenario.longest_refresh_ms = 1000.0 / 48;
        scenario.jitter_ms = 0.01 / hz * 1000;
        for (const Metrics& metrics : run_all(scenario)) {
            EXPECT_GE(metrics.quality, 0.9) << hz << " Hz";
            EXPECT_LE(metrics.over_5pct, 0.1) << hz << " Hz";
        }
    }
}

}  // namespace
}  // namespace sfsm::simulate
