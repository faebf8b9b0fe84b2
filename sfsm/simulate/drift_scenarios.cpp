// Loads that never rest, noise that remembers, and other programs' bursts. No forecast tells of any of it.
#include <cmath>
#include <numbers>
#include <utility>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/knob_scenarios.h"

namespace sfsm::simulate {
namespace {

constexpr std::int64_t long_frames = 3600;

// From 1 to 4/3 and back within `period` frames.
Scenario swinging(const char* about, double period) {
    const OverFrames load = [=](std::int64_t frame) {
        return 1 + (1 - std::cos(2 * std::numbers::pi * static_cast<double>(frame) / period)) / 6;
    };
    return knob_scenario(about, model_of(load), usual_noise, long_frames);
}

Scenario falling(const char* about, KnobModel model) {
    Scenario scenario = knob_scenario(about, std::move(model), usual_noise, long_frames);
    scenario.is_heavy_tailed = true;
    scenario.steps = {{{1200, long_frames}, false}};
    scenario.regained = {{1200, long_frames}};
    return scenario;
}

}  // namespace

Scenario swing_100() {
    return swinging("load swings from 1 to 1.33 within 100 frames", 100);
}

Scenario swing_200() {
    return swinging("load swings from 1 to 1.33 within 200 frames", 200);
}

Scenario swing_400() {
    return swinging("load swings from 1 to 1.33 within 400 frames", 400);
}

Scenario correlated() {
    Scenario scenario = knob_scenario("constant load; 3 % noise that remembers, AR(1) with 0.9",
                                      model_of(constant_load), usual_noise, long_frames);
    scenario.correlation = 0.9;
    scenario.steady = {{200, long_frames}};
    return scenario;
}

Scenario bursts() {
    Scenario scenario = knob_scenario("constant load; 12 frames in 300 take 0.8 t longer", model_of(constant_load),
                                      usual_noise, long_frames);
    scenario.burst = {300, 12, 0.8};
    return scenario;
}

Scenario heavy_tail_knob() {
    Scenario scenario =
        knob_scenario("constant load, 3 % noise with the tails of Student's t of 3 degrees, no forecast",
                      model_of(constant_load), usual_noise, long_frames);
    scenario.is_heavy_tailed = true;
    scenario.steady = {{200, long_frames}};
    return scenario;
}

Scenario fallen_load() {
    return falling("heavy-tail-knob, and load 1.6 for the first 1200 frames", model_of(raised({0, 1200}, 1.6)));
}

Scenario fallen_load_stepped() {
    KnobModel model = model_of(raised({0, 1200}, 1.6));
    model.curve = stepped_curve;
    Scenario scenario = falling("fallen-load with cost in steps", std::move(model));
    scenario.regained_share = 0.8;  // some levels are 20 % of it apart
    return scenario;
}

}  // namespace sfsm::simulate
