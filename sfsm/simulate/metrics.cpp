#include "sfsm/simulate/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include "sfsm/detail.h"

namespace sfsm::simulate {
namespace {

constexpr std::int64_t settle_frames = 60, settle_needed = 57;
constexpr std::size_t median_frames = 9;
constexpr double settle_band = 0.10;
constexpr double recovery_band = 0.02;
constexpr double least_turn = 1e-9;  // of detail: less is rounding

using Holds = std::function<bool(std::int64_t frame)>;

const Outcome& at(std::span<const Outcome> outcomes, std::int64_t frame) {
    return outcomes[static_cast<std::size_t>(frame)];
}

double off_target(const Outcome& outcome) {
    return outcome.ms / outcome.target_ms - 1;
}

bool is_interrupted(const Scenario& scenario, std::int64_t frame) {
    return std::any_of(scenario.interruptions.begin(), scenario.interruptions.end(),
                       [=](const Interruption& interruption) { return interruption.frames.contains(frame); });
}

// t can be met in this frame.
bool is_in_reach(const Course& course, std::int64_t frame) {
    constexpr double rounding = 1e-6;
    const Scenario& scenario = course.scenario;
    return course.best[static_cast<std::size_t>(frame)].cost_ms <= (1 + rounding) * due_ms(scenario, frame);
}

bool is_judged(const Course& course, std::int64_t frame) {
    const Scenario& scenario = course.scenario;
    return frame >= scenario.statistics_from && !is_interrupted(scenario, frame) && is_in_reach(course, frame);
}

std::vector<Outcome> judged_frames(const Course& course, std::span<const Outcome> outcomes) {
    std::vector<Outcome> judged;
    for (std::int64_t frame = 0; frame < std::ssize(outcomes); ++frame) {
        if (is_judged(course, frame)) judged.push_back(at(outcomes, frame));
    }
    return judged;
}

bool is_over(const Outcome& outcome) {
    return off_target(outcome) > 0.05;
}

void measure_shares(Metrics& metrics, std::span<const Outcome> judged) {
    if (judged.empty()) return;
    double excess_ms = 0;
    for (const Outcome& outcome : judged) {
        const double off = off_target(outcome);
        metrics.over_target += off > 0 ? 1 : 0;
        metrics.over_5pct += is_over(outcome) ? 1 : 0;
        metrics.within_5pct += std::abs(off) <= 0.05 ? 1 : 0;
        metrics.within_10pct += std::abs(off) <= 0.10 ? 1 : 0;
        metrics.control_rate += std::max(0.0, 1 - std::abs(off));
        excess_ms += std::max(0.0, outcome.ms - outcome.target_ms);
        metrics.judged_ms += outcome.ms;
    }
    const auto frames = static_cast<double>(judged.size());
    for (double* share : {&metrics.over_target, &metrics.over_5pct, &metrics.within_5pct, &metrics.within_10pct,
                          &metrics.control_rate}) {
        *share /= frames;
    }
    metrics.hitch_ms_per_s = 1000 * excess_ms / metrics.judged_ms;
}

// For each frame the shortest stretch that ends with it and lasts a second; none that is shorter.
double worst_second(std::span<const Outcome> judged) {
    double worst = 0, lasts_ms = 0;
    std::int64_t over = 0;
    std::size_t begin = 0;
    for (std::size_t end = 0; end < judged.size(); ++end) {
        lasts_ms += judged[end].ms;
        over += is_over(judged[end]) ? 1 : 0;
        while (lasts_ms - judged[begin].ms >= 1000) {
            lasts_ms -= judged[begin].ms;
            over -= is_over(judged[begin]) ? 1 : 0;
            ++begin;
        }
        if (lasts_ms >= 1000) worst = std::max(worst, static_cast<double>(over) / static_cast<double>(end - begin + 1));
    }
    return worst;
}

// Of the frames from `first` on.
double quality(const Course& course, std::span<const Outcome> outcomes, std::int64_t first) {
    double detail = 0, best = 0;
    for (std::int64_t frame = first; frame < std::ssize(outcomes); ++frame) {
        if (is_interrupted(course.scenario, frame)) continue;
        detail += at(outcomes, frame).detail;
        best += course.best[static_cast<std::size_t>(frame)].detail;
    }
    return best > 0 ? detail / best : 0;
}

// Frames from `begin` until `holds` does in most of the next ones; all of these before `end`.
std::optional<double> frames_until(std::int64_t begin, std::int64_t end, const Holds& holds) {
    if (end - begin < settle_frames) return {};
    std::vector<std::int64_t> held(static_cast<std::size_t>(end - begin) + 1);  // how many of the frames before
    for (std::int64_t i = 0; i < end - begin; ++i) {
        held[static_cast<std::size_t>(i) + 1] = held[static_cast<std::size_t>(i)] + (holds(begin + i) ? 1 : 0);
    }
    for (std::int64_t i = 0; i + settle_frames <= end - begin; ++i) {
        const std::int64_t in_band =
            held[static_cast<std::size_t>(i + settle_frames)] - held[static_cast<std::size_t>(i)];
        if (holds(begin + i) && in_band >= settle_needed) return static_cast<double>(i);
    }
    return {};
}

double running_median(std::span<const Outcome> outcomes, std::int64_t frame) {
    std::array<double, median_frames> last{};
    const std::int64_t count = std::min<std::int64_t>(median_frames, frame + 1);
    for (std::int64_t i = 0; i < count; ++i) last[static_cast<std::size_t>(i)] = off_target(at(outcomes, frame - i));
    const auto middle = last.begin() + count / 2;
    std::nth_element(last.begin(), middle, last.begin() + count);
    return *middle;
}

// Of the steps in one direction, the slowest.
std::optional<double> settle(const Scenario& scenario, bool is_down, const Holds& holds) {
    std::optional<double> slowest;
    for (const LoadStep& step : scenario.steps) {
        if (step.is_down != is_down) continue;
        const std::optional<double> frames = frames_until(step.frames.begin, step.frames.end, holds);
        if (!frames) return {};
        slowest = std::max(slowest.value_or(0), *frames);
    }
    return slowest;
}

void measure_settling(Metrics& metrics, const Scenario& scenario, std::span<const Outcome> outcomes) {
    const Holds median_in_band = [=](std::int64_t frame) {
        return std::abs(running_median(outcomes, frame)) <= settle_band;
    };
    const Holds cost_in_band = [=](std::int64_t frame) {
        return std::abs(at(outcomes, frame).cost_ms / at(outcomes, frame).target_ms - 1) <= settle_band;
    };
    metrics.settle_down = settle(scenario, true, median_in_band);
    metrics.settle_up = settle(scenario, false, median_in_band);
    metrics.cost_settle_down = settle(scenario, true, cost_in_band);
    metrics.cost_settle_up = settle(scenario, false, cost_in_band);
}

// Frames whose load no law can have known of.
bool is_surprise(const Scenario& scenario, std::int64_t frame) {
    if (scenario.plant->forecast(frame)) return false;
    return std::any_of(scenario.steps.begin(), scenario.steps.end(), [&](const LoadStep& step) {
        return Frames{step.frames.begin, step.frames.begin + 1 + scenario.delay}.contains(frame);
    });
}

double overshoot_pct(const Course& course, std::span<const Outcome> outcomes) {
    double most = 0;
    for (std::int64_t frame = 0; frame < std::ssize(outcomes); ++frame) {
        if (!is_judged(course, frame) || is_surprise(course.scenario, frame)) continue;
        most = std::max(most, at(outcomes, frame).cost_ms / at(outcomes, frame).target_ms - 1);
    }
    return 100 * most;
}

void measure_rest(Metrics& metrics, const Scenario& scenario, std::span<const Outcome> outcomes) {
    std::int64_t frames = 0, reversals = 0, changes = 0;
    double variation = 0;
    for (const Frames& steady : scenario.steady) {
        double last_turn = 0;
        for (std::int64_t frame = steady.begin + 1; frame < steady.end; ++frame) {
            const Outcome &before = at(outcomes, frame - 1), &now = at(outcomes, frame);
            const double turn = now.detail - before.detail;
            ++frames;
            changes += now.decision != before.decision ? 1 : 0;
            variation += std::abs(turn);
            if (std::abs(turn) < least_turn) continue;
            reversals += turn * last_turn < 0 ? 1 : 0;
            last_turn = turn;
        }
    }
    if (frames == 0) return;
    const double per_1000 = 1000.0 / static_cast<double>(frames);
    metrics.reversals_per_1000 = per_1000 * static_cast<double>(reversals);
    metrics.variation_per_1000 = per_1000 * variation;
    metrics.changes_per_1000 = per_1000 * static_cast<double>(changes);
}

std::optional<double> recovery(const Scenario& scenario, std::span<const Outcome> outcomes) {
    if (scenario.interruptions.empty()) return {};
    const std::int64_t begin = scenario.interruptions.front().frames.begin;
    const std::int64_t end = scenario.interruptions.back().frames.end;
    double before = 0;
    for (std::int64_t frame = begin - settle_frames; frame < begin; ++frame) before += at(outcomes, frame).detail;
    before /= settle_frames;
    return frames_until(end, std::ssize(outcomes), [=](std::int64_t frame) {
        return std::abs(at(outcomes, frame).detail / before - 1) <= recovery_band;
    });
}

std::optional<double> regain(const Course& course, std::span<const Outcome> outcomes) {
    std::optional<double> slowest;
    for (const Frames& regained : course.scenario.regained) {
        const std::optional<double> frames = frames_until(regained.begin, regained.end, [&](std::int64_t frame) {
            return at(outcomes, frame).detail >=
                   course.scenario.regained_share * course.best[static_cast<std::size_t>(frame)].detail;
        });
        if (!frames) return {};
        slowest = std::max(slowest.value_or(0), *frames);
    }
    return slowest;
}

bool is_stuck(const Course& course, std::span<const Outcome> outcomes) {
    constexpr std::int64_t last = 600;
    const std::int64_t first = std::max<std::int64_t>(0, std::ssize(outcomes) - last);
    std::int64_t judged = 0, over = 0;
    for (std::int64_t frame = first; frame < std::ssize(outcomes); ++frame) {
        if (!is_judged(course, frame)) continue;
        ++judged;
        over += is_over(at(outcomes, frame)) ? 1 : 0;
    }
    const double kept = quality(course, outcomes, first);  // 0: nothing is to be kept
    return 2 * over > judged || (kept > 0 && kept < 0.5);
}

double mean_ms(const Scenario& scenario, std::span<const Outcome> outcomes) {
    double sum_ms = 0, frames = 0;
    for (std::int64_t frame = scenario.statistics_from; frame < std::ssize(outcomes); ++frame) {
        if (is_interrupted(scenario, frame)) continue;
        sum_ms += at(outcomes, frame).ms;
        ++frames;
    }
    return frames > 0 ? sum_ms / frames : 0;
}

double effective_splat(const Decision& decision) {
    return decision.state == State::points ? std::max(finest_splat, decision.splat_size) : finest_splat;
}

double octaves(double from, double to) {
    return from > 0 && to > 0 ? std::abs(std::log2(to / from)) : 0;
}

double octaves(const Work& from, const Work& to) {
    double most = 0;
    for (std::size_t kind = 0; kind < work_kinds; ++kind)
        most = std::max(most, octaves(counted(from.counts[kind]), counted(to.counts[kind])));
    return most;
}

// What forecasts offer at least and at most.
double octaves(const Forecast* from, const Forecast* to) {
    if (!from || !to || from == to) return 0;
    return std::max({octaves(from->frame, to->frame), octaves(from->motion.front().work, to->motion.front().work),
                     octaves(from->motion.back().work, to->motion.back().work),
                     octaves(from->shapes.front().work, to->shapes.front().work),
                     octaves(from->shapes.back().work, to->shapes.back().work)});
}

constexpr std::int64_t first_frames = 10;

double largest_step(const Scenario& scenario, std::span<const Outcome> outcomes) {
    double largest = 0;
    for (std::int64_t frame = first_frames; frame < std::ssize(outcomes); ++frame) {
        const Outcome &before = at(outcomes, frame - 1), &now = at(outcomes, frame);
        const double told = octaves(before.target_ms, now.target_ms) +
                            octaves(scenario.plant->forecast(frame - 1), scenario.plant->forecast(frame));
        const double step = octaves(effective_splat(before.decision), effective_splat(now.decision));
        largest = std::max(largest, step - told);
    }
    return largest;
}

void measure_first(Metrics& metrics, const Course& course, std::span<const Outcome> outcomes) {
    std::vector<double> settled;
    for (std::int64_t frame = first_frames; frame < std::ssize(outcomes); ++frame) {
        if (is_judged(course, frame)) settled.push_back(effective_splat(at(outcomes, frame).decision));
    }
    if (settled.empty()) return;
    const auto middle = settled.begin() + std::ssize(settled) / 2;
    std::nth_element(settled.begin(), middle, settled.end());
    for (std::int64_t frame = 0; frame < std::min(first_frames, std::ssize(outcomes)); ++frame) {
        if (!is_in_reach(course, frame)) continue;
        const Outcome& outcome = at(outcomes, frame);
        metrics.first_over = std::max(metrics.first_over, outcome.cost_ms / outcome.target_ms);
        metrics.first_coarse = std::max(metrics.first_coarse, effective_splat(outcome.decision) / *middle);
    }
}

// Under a cap nothing can be faster than it.
std::vector<Outcome> with_due_times(const Scenario& scenario, std::span<const Outcome> outcomes) {
    std::vector<Outcome> due(outcomes.begin(), outcomes.end());
    for (Outcome& outcome : due) outcome.target_ms = std::max(outcome.target_ms, scenario.cap_ms);
    return due;
}

Metrics measure_due(const Course& course, std::span<const Outcome> outcomes) {
    Metrics metrics;
    const std::vector<Outcome> judged = judged_frames(course, outcomes);
    measure_shares(metrics, judged);
    metrics.worst_second = worst_second(judged);
    metrics.quality = quality(course, outcomes, course.scenario.statistics_from);
    measure_settling(metrics, course.scenario, outcomes);
    metrics.overshoot_pct = overshoot_pct(course, outcomes);
    measure_rest(metrics, course.scenario, outcomes);
    metrics.recovery = recovery(course.scenario, outcomes);
    metrics.regain = regain(course, outcomes);
    metrics.is_stuck = is_stuck(course, outcomes) ? 1 : 0;
    metrics.mean_ms = mean_ms(course.scenario, outcomes);
    metrics.largest_step = largest_step(course.scenario, outcomes);
    measure_first(metrics, course, outcomes);
    return metrics;
}

}  // namespace

Metrics measure(const Course& course, std::span<const Outcome> outcomes) {
    if (course.scenario.cap_ms <= 0) return measure_due(course, outcomes);
    return measure_due(course, with_due_times(course.scenario, outcomes));
}

}  // namespace sfsm::simulate
