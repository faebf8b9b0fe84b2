#include "sfsm/simulate/knob_scenarios.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sfsm/simulate/catalogue.h"

namespace sfsm::simulate {
namespace {

constexpr double low_noise = 0.005;

// L(k) of the toy check: steps up and down by 1.6, then a ramp.
double toy_load(std::int64_t frame) {
    if (frame < 900) return 1;
    if (frame < 1800) return 1.6;
    if (frame < 2700) return 1;
    return 1 + 0.5 * static_cast<double>(frame - 2700) / 900;
}

Scenario toy_with(const char* about, int delay, double spike_share) {
    Scenario scenario = knob_scenario(about, model_of(toy_load), usual_noise, 3600);
    scenario.delay = delay;
    scenario.spike_share = spike_share;
    scenario.steps = {{{900, 1800}, true}, {{1800, 2700}, false}};
    scenario.steady = {{200, 900}, {1100, 1800}, {2000, 2700}};
    return scenario;
}

constexpr double toy_spikes = 0.005;

Scenario quiet_with(const char* about, double noise) {
    Scenario scenario = knob_scenario(about, model_of(constant_load), noise, 2000);
    scenario.steady = {{200, 2000}};
    return scenario;
}

Scenario interrupted(const char* about, std::vector<Interruption> interruptions) {
    Scenario scenario = knob_scenario(about, model_of(constant_load), low_noise, episode_frames);
    scenario.steady = {{200, 600}, {1000, 1800}};
    scenario.interruptions = std::move(interruptions);
    return scenario;
}

}  // namespace

double constant_load(std::int64_t) {
    return 1;
}

OverFrames raised(Frames frames, double load) {
    return [=](std::int64_t frame) { return frames.contains(frame) ? load : 1.0; };
}

KnobModel model_of(OverFrames load) {
    KnobModel model;
    model.load = std::move(load);
    return model;
}

Scenario knob_scenario(const char* about, KnobModel model, double noise, std::int64_t frames) {
    Scenario scenario;
    scenario.about = about;
    scenario.plant = std::make_shared<KnobPlant>(std::move(model));
    scenario.noise = noise;
    scenario.frames = frames;
    return scenario;
}

Scenario toy() {
    return toy_with("one knob, steps and a ramp of load, 3 % noise, spikes, 2 frames late", 2, toy_spikes);
}

Scenario delay_0() {
    return toy_with("toy with times at once", 0, toy_spikes);
}

Scenario delay_4() {
    return toy_with("toy with times 4 frames late", 4, toy_spikes);
}

Scenario spikes() {
    return toy_with("toy with a spike in 3 % of the frames", 2, 0.03);
}

Scenario quiet() {
    return quiet_with("constant load, no noise at all", 0);
}

Scenario quiet_noisy() {
    return quiet_with("constant load, 0.5 % noise", low_noise);
}

Scenario cpu_bound() {
    KnobModel model = model_of(constant_load);
    model.cpu_ms = [](std::int64_t frame) { return episode.contains(frame) ? 1.3 * frame_ms : 0.0; };
    Scenario scenario =
        knob_scenario("for a third, 1.3 t whatever the detail", std::move(model), usual_noise, episode_frames);
    scenario.steady = around_episode();
    return scenario;
}

// What was given up in vain has to be tested again, or nobody finds out that it is over.
Scenario cpu_bound_long() {
    Scenario scenario = cpu_bound();
    scenario.about = "cpu-bound, and 4800 frames after it";
    scenario.frames = episode.end + 4800;
    scenario.steady = {{200, 600}, {2000, scenario.frames}};
    scenario.regained = {{episode.end, scenario.frames}};
    return scenario;
}

Scenario unreachable() {
    Scenario scenario = knob_scenario("for a third, least detail takes 1.44 t", model_of(raised(episode, 4)),
                                      usual_noise, episode_frames);
    scenario.steps = {{{episode.end, episode_frames}, false}};
    scenario.steady = around_episode();
    return scenario;
}

Scenario light_load() {
    Scenario scenario = knob_scenario("for a third, full detail takes 0.75 t", model_of(raised(episode, 0.5)),
                                      usual_noise, episode_frames);
    scenario.steps = {{{episode.end, episode_frames}, true}};
    scenario.steady = around_episode();
    return scenario;
}

Scenario wavy() {
    KnobModel model = model_of(raised(episode, 1.3));
    model.curve = wavy_curve;
    Scenario scenario = knob_scenario("cost falls with detail in places; load 1.3 for a third", std::move(model),
                                      usual_noise, episode_frames);
    scenario.steps = there_and_back();
    scenario.steady = around_episode();
    return scenario;
}

Scenario stepped() {
    KnobModel model = model_of(raised(episode, 1.3));
    model.curve = stepped_curve;
    Scenario scenario = knob_scenario("cost in steps of 10 to 20 % of t; load 1.3 for a third", std::move(model),
                                      usual_noise, episode_frames);
    scenario.steady = around_episode();
    return scenario;
}

Scenario moving_range() {
    KnobModel model = model_of(constant_load);
    model.range_m = [](std::int64_t frame) {
        constexpr double period = 300;
        return 200 + 100 * std::sin(2 * std::numbers::pi * static_cast<double>(frame) / period);
    };
    return knob_scenario("L swings from 100 m to 300 m; cost depends on D / L", std::move(model), usual_noise,
                         episode_frames);
}

Scenario target_step() {
    Scenario scenario =
        knob_scenario("the target steps, the load does not", model_of(constant_load), usual_noise, episode_frames);
    scenario.target = TargetSchedule::parse("16,10@600,16@1200");
    scenario.steps = there_and_back();
    scenario.steady = around_episode();
    return scenario;
}

Scenario hitch() {
    return interrupted("one frame of 4 s", {{{600, 601}, 4000}});
}

Scenario pause() {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double endless = std::numeric_limits<double>::infinity();
    return interrupted(
        "30 frames of no time, 0, -5 ms, infinite and 1e9 ms",
        {{{600, 606}, 0}, {{606, 612}, none}, {{612, 618}, -5}, {{618, 624}, endless}, {{624, 630}, 1e9}});
}

// The bar of a loading screen is drawn fast, and the first frame after it waits for what was loaded.
Scenario loading() {
    return interrupted("a loading screen: 120 frames of 3 ms, one of 900 ms", {{{600, 720}, 3}, {{720, 721}, 900}});
}

}  // namespace sfsm::simulate
