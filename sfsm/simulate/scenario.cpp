#include "sfsm/simulate/scenario.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/noise.h"

namespace sfsm::simulate {
namespace {

struct Entry {
    std::string_view name;
    Scenario (*make)();
};
constexpr std::array entries = {
    Entry{"toy", toy},
    Entry{"delay-0", delay_0},
    Entry{"delay-4", delay_4},
    Entry{"spikes", spikes},
    Entry{"quiet", quiet},
    Entry{"quiet-noisy", quiet_noisy},
    Entry{"vsync", vsync},
    Entry{"cpu-bound", cpu_bound},
    Entry{"unreachable", unreachable},
    Entry{"light-load", light_load},
    Entry{"wavy", wavy},
    Entry{"stepped", stepped},
    Entry{"moving-range", moving_range},
    Entry{"target-step", target_step},
    Entry{"hitch", hitch},
    Entry{"pause", pause},
    Entry{"loading", loading},
    Entry{"quiet-forecast", quiet_forecast},
    Entry{"target-step-forecast", target_step_forecast},
    Entry{"camera-cut", camera_cut},
    Entry{"crowd-pours-in", crowd_pours_in},
    Entry{"throttled", throttled},
    Entry{"heavy-tail", heavy_tail},
    Entry{"paper-1", paper_1},
    Entry{"paper-1-noisy", paper_1_noisy},
    Entry{"paper-2", paper_2},
    Entry{"paper-2-noisy", paper_2_noisy},
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
        if (entry.name != name) continue;
        Scenario scenario = entry.make();
        scenario.name = name;
        return scenario;
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
