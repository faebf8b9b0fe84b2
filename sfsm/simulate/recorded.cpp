#include "sfsm/simulate/recorded.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sfsm/least_loss.h"
#include "sfsm/pair_plans.h"
#include "sfsm/rate_plans.h"
#include "sfsm/replay.h"
#include "sfsm/simulate/paper_crowd.h"
#include "sfsm/usable.h"

namespace sfsm::simulate {
namespace {

constexpr double least_model = 1e-3;  // of a usual frame: nothing is modelled as less, or a load would have no bounds
constexpr double rounding = 1e-12;
constexpr double longest_range = 1e9;      // [m]
constexpr double most_loss = 1e9;          // [px]
constexpr std::int64_t usual_start = 200;  // of statistics, or a tenth of a short run

// The candidates of a frame. Spans point into it, so it stays where it is.
struct Steps {
    std::vector<Step> motion, shapes;
    std::vector<RateStep> rates;
    Forecast forecast;

    explicit Steps(const Forecast& from)
        : motion(from.motion.begin(), from.motion.end()),
          shapes(from.shapes.begin(), from.shapes.end()),
          rates(from.rates.begin(), from.rates.end()),
          forecast{from.frame, motion, shapes, rates} {}
    Steps(const Steps&) = delete;
    Steps(Steps&&) = default;  // vectors keep their memory
};

// What a frame took that the model says takes `model_ms`.
struct Load {
    double ms = 1, model_ms = 1;
    double factor() const { return ms / model_ms; }
};

struct RecordedFrame {
    Load load;
    double range = 0;       // L [m]
    std::size_t steps = 0;  // an index
};

class RecordedPlant final : public Plant {
public:
    // Loads are still to be set.
    RecordedPlant(const Prices& prices, double usual_ms, std::vector<Steps> steps, std::vector<RecordedFrame> frames)
        : prices_(prices), least_ms_(least_model * usual_ms), steps_(std::move(steps)), frames_(std::move(frames)) {}

    // What frame `frame` took and how it was drawn.
    void record(std::int64_t frame, double ms, const Decision& decision) {
        at(frame).load = {ms, model_ms(plan(frame, decision))};
    }
    void set_load(std::int64_t frame, const Load& load) { at(frame).load = load; }
    const Load& load(std::int64_t frame) const { return at(frame).load; }

    double range(std::int64_t frame) const override { return at(frame).range; }
    const Forecast* forecast(std::int64_t frame) const override { return &steps_[at(frame).steps].forecast; }
    double cost_ms(std::int64_t frame, const Decision& decision) const override {
        // In this order the recorded decision takes the recorded time to the bit.
        return load(frame).ms * (model_ms(plan(frame, decision)) / load(frame).model_ms);
    }
    Work work(std::int64_t frame, const Decision& decision) const override;
    double detail(std::int64_t frame, const Decision& decision) const override {
        return 1 / (1 + plan(frame, decision).loss);
    }
    Decision optimum(std::int64_t frame, double limit_ms) const override;

private:
    RecordedFrame& at(std::int64_t frame) { return frames_[static_cast<std::size_t>(frame)]; }
    const RecordedFrame& at(std::int64_t frame) const { return frames_[static_cast<std::size_t>(frame)]; }
    Plan plan(std::int64_t frame, const Decision& decision) const;
    double model_ms(const Plan& plan) const { return std::max(plan_ms(plan, prices_), least_ms_); }

    Prices prices_;
    double least_ms_;
    std::vector<Steps> steps_;
    std::vector<RecordedFrame> frames_;
};

// A decision by D and S; of what is of no use the nearest, and the finest splats.
Decision usable(Decision decision, const Forecast& forecast) {
    if (decision.state == State::original) return {};
    if (!(decision.motion_distance > 0)) decision.motion_distance = 0;
    const double finest =
        decision.state == State::points && forecast.shapes.size() > 1 ? forecast.shapes[1].setting : 0;
    const bool is_finer = decision.state != State::points || !(decision.splat_size > finest);
    return {decision.state, decision.motion_distance, is_finer ? finest : decision.splat_size};
}

Plan RecordedPlant::plan(std::int64_t frame, const Decision& decision) const {
    const Forecast& forecast = *this->forecast(frame);
    const Decision by_pair = usable(decision, forecast);
    Plan plan = PairPlans(forecast, range(frame)).at(by_pair);
    if (forecast.rates.empty()) return plan;
    const RatePlans rates(forecast, range(frame));
    if (decision.rate > 0) return rates.at(decision);
    // As much as the rate that loses as many pixels, and no less than the best that can be done in its time.
    plan.loss = std::max(rates.at(by_pair).loss, rates.least_loss(prices_, plan_ms(plan, prices_)).loss);
    return plan;
}

Work RecordedPlant::work(std::int64_t frame, const Decision& decision) const {
    const Plan drawn = plan(frame, decision);
    Work work;
    for (std::size_t i = 0; i < work_kinds; ++i) work.counts[i] = std::llround(drawn.counts[i]);
    return work;
}

// The least a forecast's steps can cost, whatever the prices.
double least_plan_ms(const Forecast& forecast, const Prices& prices) {
    const auto least_of = [each = Prices{0, prices.each}](std::span<const Step> steps) {
        double least_ms = std::numeric_limits<double>::infinity();
        for (const Step& step : steps) least_ms = std::min(least_ms, cost_of(step.work, each));
        return least_ms;
    };
    return cost_of(forecast.frame, prices) + least_of(forecast.motion) + least_of(forecast.shapes);
}

Decision RecordedPlant::optimum(std::int64_t frame, double limit_ms) const {
    const Forecast& forecast = *this->forecast(frame);
    if (!forecast.rates.empty()) {
        const RatePlans rates(forecast, range(frame));
        const double least_ms = plan_ms(rates.cheapest(prices_), prices_) * (1 + rounding);
        return rates.decision_of(rates.least_loss(prices_, std::max(limit_ms / load(frame).factor(), least_ms)));
    }
    const double least_ms = least_plan_ms(forecast, prices_) * (1 + rounding);
    const Plan best =
        least_loss_plan(forecast, range(frame), prices_, std::max(limit_ms / load(frame).factor(), least_ms));
    return decision_of(best, range(frame));
}

bool is_count(std::int64_t count) {
    return count >= 0 && count <= most_count;
}

bool has_sound_numbers(const Step& step) {
    return std::ranges::all_of(step.work.counts, is_count) && step.loss_px >= 0 && step.loss_px <= most_loss;
}

// Rates rise; losses don't shrink, as the finest that fits is taken for the one of least loss.
bool are_sound(std::span<const RateStep> rates) {
    for (std::size_t i = 0; i < rates.size(); ++i) {
        const RateStep& step = rates[i];
        const bool has_sound_numbers = is_usable(step.rate) && step.motion_distance > 0 && step.splat_size >= 0 &&
                                       step.splat_size <= max_splat_size && step.loss >= 0 && step.loss <= most_loss;
        if (!has_sound_numbers || !std::ranges::all_of(step.work.counts, is_count)) return false;
        if (i > 0 && !(step.rate > rates[i - 1].rate && step.loss >= rates[i - 1].loss)) return false;
    }
    return true;
}

// Distances fall, only the first may be infinite; sizes rise from triangles on; all else is finite. Counts may do what
// they like.
bool has_sound_forecast(const TraceRow& row) {
    if (!are_sound(row.rates)) return false;
    if (!row.has_forecast() || !std::ranges::all_of(row.forecast().frame.counts, is_count)) return false;
    if (!std::ranges::all_of(row.motion, has_sound_numbers) || !std::ranges::all_of(row.shapes, has_sound_numbers))
        return false;
    for (std::size_t i = 0; i < row.motion.size(); ++i) {
        const double distance = row.motion[i].setting;
        if (!(distance > 0) || (i > 0 && !(distance < row.motion[i - 1].setting))) return false;
    }
    for (std::size_t i = 0; i < row.shapes.size(); ++i) {
        const double size = row.shapes[i].setting;
        if (i == 0 ? size != 0 : !(size > row.shapes[i - 1].setting && size <= max_splat_size)) return false;
    }
    return true;
}

bool is_range(double metres) {
    return is_usable(metres) && metres <= longest_range;
}

// For each row the last one up to it that has what is asked for; for the first ones, the first. Nothing: none has.
template <class Has>
std::vector<std::size_t> last_rows(const RunRows& rows, const Has& has) {
    std::size_t found = 0;
    while (found < rows.count && !has(rows.at(found))) ++found;
    if (found == rows.count) return {};
    std::vector<std::size_t> last(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
        if (has(rows.at(i))) found = i;
        last[i] = found;
    }
    return last;
}

bool has_time(const TraceRow& row) {
    return is_frame_time(row.frame_ms);
}

// Of our own rows: the model is fitted, the candidates are the rows'.
RecordedPlant own_plant(std::span<const TraceRow> rows, std::span<const std::size_t> forecast_of, Drawing drawing) {
    const CostFit fit = fit_costs(rows, drawing);
    const std::vector<std::size_t> range_of =
        last_rows(run_rows(rows), [](const TraceRow& row) { return is_range(row.range); });
    std::vector<Steps> steps;
    std::vector<RecordedFrame> frames;
    std::vector<std::size_t> place(rows.size());  // of a row's steps
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const TraceRow& row = rows[i];
        if (has_sound_forecast(row)) {
            place[i] = steps.size();
            steps.emplace_back(row.forecast());
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double range = range_of.empty() ? static_view.range : rows[range_of[i]].range;
        frames.push_back({{}, range, place[forecast_of[i]]});
    }
    return {fit.prices, fit.median_ms, std::move(steps), std::move(frames)};
}

// Of any other: one crowd for all, on a machine that takes 1 for all of its detail.
RecordedPlant reference_plant(std::size_t rows) {
    const WorkPlant crowd(paper_machine, {static_view}, [](std::int64_t) { return std::size_t{0}; });
    const double all_ms = crowd.cost_ms(0, Decision{});
    Prices prices = paper_machine;
    prices.frame /= all_ms;
    for (double& ms : prices.each) ms /= all_ms;
    std::vector<Steps> steps;
    steps.emplace_back(*crowd.forecast(0));
    return {prices, 1, std::move(steps), std::vector<RecordedFrame>(rows, {{}, static_view.range, 0})};
}

// The same share of another range.
Decision rescaled(Decision decision, double from, double to) {
    if (is_range(from)) decision.motion_distance *= to / from;
    return decision;
}

TargetSchedule targets_of(const RunRows& rows) {
    std::vector<double> ms;
    ms.reserve(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) ms.push_back(rows.at(i).target_ms);
    return TargetSchedule::of_frames(ms);
}

// Of each row the one that it takes its time from.
std::vector<std::size_t> times_of(const RunRows& rows) {
    std::vector<std::size_t> time_of = last_rows(rows, has_time);
    if (!time_of.empty()) return time_of;
    throw std::runtime_error("found no time in " + std::to_string(rows.count) +
                             " frames, expected at least one of 1e-6 to 1e9 ms");
}

void set_loads(RecordedPlant& plant, const RunRows& rows, std::span<const std::size_t> time_of, bool is_foreign) {
    for (std::size_t i = 0; i < rows.count; ++i) {
        const TraceRow& row = rows.at(i);
        const auto frame = static_cast<std::int64_t>(i);
        if (!has_time(row)) continue;
        const Decision decision = is_foreign ? rescaled(row.decision, row.range, plant.range(frame)) : row.decision;
        plant.record(frame, row.frame_ms, decision);
    }
    for (std::size_t i = 0; i < rows.count; ++i)
        plant.set_load(static_cast<std::int64_t>(i), plant.load(static_cast<std::int64_t>(time_of[i])));
}

Scenario scenario_of(std::shared_ptr<Plant> plant, const RunRows& rows, int delay, Drawing drawing) {
    assert(delay >= 0 && delay <= max_delay);
    Scenario scenario;
    scenario.name = "recorded";
    scenario.about = "a recorded run of " + std::to_string(rows.count) + " frames";
    scenario.plant = std::move(plant);
    scenario.drawing = drawing;
    scenario.target = targets_of(rows);
    scenario.frames = static_cast<std::int64_t>(rows.count);
    scenario.statistics_from = std::min(usual_start, scenario.frames / 10);
    scenario.delay = delay;
    return scenario;
}

}  // namespace

Scenario foreign_scenario(const RunRows& rows, int delay, Drawing drawing) {
    const std::vector<std::size_t> time_of = times_of(rows);
    auto plant = std::make_shared<RecordedPlant>(reference_plant(rows.count));
    set_loads(*plant, rows, time_of, true);
    return scenario_of(std::move(plant), rows, delay, drawing);
}

Scenario recorded_scenario(std::span<const TraceRow> rows, const RecordedOptions& options) {
    const RunRows all = run_rows(rows);
    std::vector<std::size_t> forecast_of;
    if (options.has_work) forecast_of = last_rows(all, has_sound_forecast);
    if (forecast_of.empty()) return foreign_scenario(all, options.delay, options.drawing);
    const std::vector<std::size_t> time_of = times_of(all);
    auto plant = std::make_shared<RecordedPlant>(own_plant(rows, forecast_of, options.drawing));
    set_loads(*plant, all, time_of, false);
    return scenario_of(std::move(plant), all, options.delay, options.drawing);
}

}  // namespace sfsm::simulate
