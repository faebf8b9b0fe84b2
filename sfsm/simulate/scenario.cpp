#include "sfsm/simulate/scenario.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "sfsm/simulate/knob_plant.h"
#include "sfsm/simulate/noise.h"

namespace sfsm::simulate {
namespace {

// L(k) of the toy check: steps up and down by 1.6, then a ramp.
double toy_load(std::int64_t frame) {
    if (frame < 900) return 1;
    if (frame < 1800) return 1.6;
    if (frame < 2700) return 1;
    return 1 + 0.5 * static_cast<double>(frame - 2700) / 900;
}

Scenario toy() {
    Scenario scenario;
    scenario.name = "toy";
    scenario.about = "the toy check: one knob, steps and a ramp of load, 3 % noise, spikes, 2 frames late";
    scenario.plant = std::make_shared<KnobPlant>(KnobModel{.load = toy_load, .cpu_ms = {}, .range_m = {}});
    scenario.noise = 0.03;
    scenario.spike_share = 0.005;
    scenario.steps = {{900, true}, {1800, false}};
    scenario.steady = {{200, 900}, {1100, 1800}, {2000, 2700}};
    return scenario;
}

struct Entry {
    std::string_view name;
    Scenario (*make)();
};
constexpr std::array entries = {
    Entry{"toy", toy},
};
constexpr auto names = [] {
    std::array<std::string_view, entries.size()> list{};
    for (std::size_t i = 0; i < entries.size(); ++i) list[i] = entries[i].name;
    return list;
}();

}  // namespace

std::span<const std::string_view> scenario_names() {
    return names;
}

Scenario make_scenario(std::string_view name) {
    for (const Entry& entry : entries) {
        if (entry.name == name) return entry.make();
    }
    std::string message = "found scenario '" + std::string(name) + "', expected one of:";
    for (const std::string_view known : names) message.append(" ").append(known);
    throw std::invalid_argument(message);
}

double measured_ms(const Scenario& scenario, std::uint64_t seed, std::int64_t frame, double cost_ms) {
    for (const Interruption& interruption : scenario.interruptions) {
        if (interruption.frames.contains(frame)) return interruption.ms;
    }
    double ms = cost_ms;
    if (scenario.noise > 0) ms *= std::exp(scenario.noise * normal_at(seed, frame, Stream::noise));
    if (scenario.spike_share > 0 && uniform_at(seed, frame, Stream::spike) < scenario.spike_share) {
        const double share = uniform_at(seed, frame, Stream::spike_size);
        ms += scenario.target.at(frame) * (scenario.spike_low + (scenario.spike_high - scenario.spike_low) * share);
    }
    if (scenario.refresh_ms > 0) ms = std::ceil(ms / scenario.refresh_ms) * scenario.refresh_ms;
    return ms;
}

}  // namespace sfsm::simulate
