// Displays and caps between what a frame costs and the time that arrives: waiting is no load.
#include <utility>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/knob_scenarios.h"

namespace sfsm::simulate {
namespace {

constexpr double fast_refresh_ms = 1000.0 / 144;
constexpr double longest_refresh_ms = 1000.0 / 48;
constexpr double little_jitter_ms = 0.13;           // a refresh of 60 Hz is never over 1.05 * 16 ms
constexpr double some_jitter_ms = 0.37;             // 0.15 ms of deviation
constexpr double most_jitter_ms = 0.03 * frame_ms;  // 0.2 ms of deviation

// The best aim keeps all but 2 % of the noise under the refresh that it has to meet.
constexpr double aim_of_refresh = 0.94;

Scenario synced(const char* about, double jitter_ms) {
    Scenario scenario = knob_scenario(about, model_of(raised(episode, 1.6)), usual_noise, episode_frames);
    scenario.refresh_ms = frame_ms;
    scenario.jitter_ms = jitter_ms;
    scenario.oracle_aim = aim_of_refresh;
    scenario.steps = there_and_back();
    scenario.steady = around_episode();
    return scenario;
}

Scenario synced_at(const char* about, const char* target) {
    Scenario scenario = synced(about, little_jitter_ms);
    scenario.target = TargetSchedule::parse(target);
    scenario.oracle_aim = aim_of_refresh * scenario.refresh_ms / scenario.target.at(0);
    return scenario;
}

// Full detail takes 0.75 t, and too much for a third. Another program's cap is slower than the target throughout.
Scenario capped(const char* about, double cap) {
    constexpr double light = 0.5, heavy = 1.6;
    constexpr std::int64_t frames = 2400;
    KnobModel model = model_of([](std::int64_t frame) { return episode.contains(frame) ? heavy : light; });
    Scenario scenario = knob_scenario(about, std::move(model), usual_noise, frames);
    scenario.regained_share = 0.99;
    scenario.cap_ms = cap * frame_ms;
    scenario.steady = {{200, 600}, {1400, frames}};
    scenario.regained = {{0, episode.begin}, {episode.end, frames}};
    return scenario;
}

}  // namespace

Scenario vsync() {
    return synced("times come in whole refreshes of 60 Hz; load 1.6 for a third", 0);
}

Scenario vsync_jitter() {
    return synced("vsync, and times jitter by up to 0.37 ms (deviation 0.15)", some_jitter_ms);
}

Scenario vsync_jitter_3pct() {
    return synced("vsync, and times jitter by up to 3 % of a refresh", most_jitter_ms);
}

Scenario vsync_target_16() {
    return synced_at("vsync at 60 Hz, target 16 ms, up to 0.13 ms of jitter", "16");
}

Scenario vsync_target_16_6() {
    return synced_at("vsync at 60 Hz, target 16.6 ms, up to 0.13 ms of jitter", "16.6");
}

Scenario vsync_target_17() {
    return synced_at("vsync at 60 Hz, target 17 ms, up to 0.13 ms of jitter", "17");
}

// Two refreshes fit the target, a third doesn't.
Scenario vsync_144() {
    Scenario scenario = synced("vsync at 144 Hz, target 16.7 ms, up to 0.13 ms of jitter", little_jitter_ms);
    scenario.refresh_ms = fast_refresh_ms;
    scenario.oracle_aim = aim_of_refresh * 2 * fast_refresh_ms / frame_ms;
    return scenario;
}

Scenario variable_refresh() {
    KnobModel model = model_of(raised(episode, 1.6));
    model.nominal_ms = fast_refresh_ms;
    Scenario scenario = knob_scenario("variable refresh, 48 to 144 Hz, target 144 Hz; load 1.6 for a third",
                                      std::move(model), usual_noise, episode_frames);
    scenario.target = TargetSchedule::parse("6.944444444444445");
    scenario.refresh_ms = fast_refresh_ms;
    scenario.longest_refresh_ms = longest_refresh_ms;
    scenario.jitter_ms = little_jitter_ms;
    scenario.steps = there_and_back();
    scenario.steady = around_episode();
    return scenario;
}

Scenario frame_cap_2() {
    return capped("another program's cap, 2 % slower than the target; load 0.5, 1.6 for 600 frames", 1.02);
}

Scenario frame_cap_5() {
    return capped("another program's cap, 5 % slower than the target; load 0.5, 1.6 for 600 frames", 1.05);
}

Scenario frame_cap_10() {
    return capped("another program's cap, 10 % slower than the target; load 0.5, 1.6 for 600 frames", 1.1);
}

}  // namespace sfsm::simulate
