#include "sfsm/simulate/scenario.h"

#include <algorithm>
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
    Entry{"cpu-bound-long", cpu_bound_long},
    Entry{"frame-cap-2", frame_cap_2},
    Entry{"frame-cap-5", frame_cap_5},
    Entry{"frame-cap-10", frame_cap_10},
    Entry{"vsync-jitter", vsync_jitter},
    Entry{"vsync-jitter-3pct", vsync_jitter_3pct},
    Entry{"vsync-target-16", vsync_target_16},
    Entry{"vsync-target-16-6", vsync_target_16_6},
    Entry{"vsync-target-17", vsync_target_17},
    Entry{"vsync-144", vsync_144},
    Entry{"variable-refresh", variable_refresh},
    Entry{"swing-100", swing_100},
    Entry{"swing-200", swing_200},
    Entry{"swing-400", swing_400},
    Entry{"correlated", correlated},
    Entry{"bursts", bursts},
    Entry{"heavy-tail-knob", heavy_tail_knob},
    Entry{"fallen-load", fallen_load},
    Entry{"fallen-load-stepped", fallen_load_stepped},
    Entry{"quiet-forecast", quiet_forecast},
    Entry{"target-step-forecast", target_step_forecast},
    Entry{"camera-cut", camera_cut},
    Entry{"crowd-pours-in", crowd_pours_in},
    Entry{"throttled", throttled},
    Entry{"heavy-tail", heavy_tail},
    Entry{"hidden-cost", hidden_cost},
    Entry{"correlated-forecast", correlated_forecast},
    Entry{"forecast-half", forecast_half},
    Entry{"forecast-double", forecast_double},
    Entry{"forecast-by-kind", forecast_by_kind},
    Entry{"forecast-by-view", forecast_by_view},
    Entry{"untold-cut", untold_cut},
    Entry{"slow-machine", slow_machine},
    Entry{"out-of-reach", out_of_reach},
    Entry{"out-of-reach-untold", out_of_reach_untold},
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

double noise_at(const Scenario& scenario, std::uint64_t seed, std::int64_t frame) {
    if (scenario.is_heavy_tailed) return heavy_tailed_at(seed, frame, Stream::noise);
    return correlated_normal_at(seed, frame, Stream::noise, scenario.correlation);
}

bool is_in_burst(const Burst& burst, std::int64_t frame) {
    return burst.period > 0 && frame % burst.period >= burst.period - burst.frames;
}

// When a display shows what took `ms`. One of variable refresh repeats the last frame when the next is late, and the
// late one waits until that has been shown.
double shown_ms(const Scenario& scenario, double ms) {
    const double refresh_ms = scenario.refresh_ms, longest_ms = scenario.longest_refresh_ms;
    if (refresh_ms <= 0) return ms;
    if (longest_ms <= 0) return std::ceil(ms / refresh_ms) * refresh_ms;
    return ms > longest_ms ? std::max(ms, longest_ms + refresh_ms) : std::max(ms, refresh_ms);
}

// A time lies between two stamps.
double jitter_ms(const Scenario& scenario, std::uint64_t seed, std::int64_t frame) {
    if (scenario.jitter_ms <= 0) return 0;
    return scenario.jitter_ms * (uniform_at(seed, frame, Stream::stamp) - uniform_at(seed, frame - 1, Stream::stamp));
}

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

double due_ms(const Scenario& scenario, std::int64_t frame) {
    return std::max(scenario.target.at(frame), scenario.cap_ms);
}

double measured_ms(const Scenario& scenario, std::uint64_t seed, std::int64_t frame, double cost_ms) {
    for (const Interruption& interruption : scenario.interruptions) {
        if (interruption.frames.contains(frame)) return interruption.ms;
    }
    const double target_ms = scenario.target.at(frame);
    double ms = cost_ms;
    if (scenario.noise > 0) ms *= std::exp(scenario.noise * noise_at(scenario, seed, frame));
    if (scenario.spike_share > 0 && uniform_at(seed, frame, Stream::spike) < scenario.spike_share) {
        const double share = uniform_at(seed, frame, Stream::spike_size);
        ms += target_ms * (scenario.spike_low + (scenario.spike_high - scenario.spike_low) * share);
    }
    if (is_in_burst(scenario.burst, frame)) ms += scenario.burst.share * target_ms;
    return shown_ms(scenario, std::max(ms, scenario.cap_ms)) + jitter_ms(scenario, seed, frame);
}

}  // namespace sfsm::simulate
