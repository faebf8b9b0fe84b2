#include "sfsm/by_forecast.h"

#include <algorithm>
#include <cmath>

namespace sfsm {
namespace {

constexpr double first_slack = 1.5;  // over the least: the cheapest frame would teach too little of the others

constexpr double doubtful = 0.05;      // uncertainty of the way down that is worth a probe
constexpr double probe_share = 0.5;    // of the motion that such a frame has
constexpr double coarser_probe = 4;    // times the finest splat
constexpr int first_probe = 12;        // times before it: the noise of a frame has to be known
constexpr int quiet_before_probe = 8;  // decisions without change
constexpr int longest_wait = 24;       // decisions until a probe's time is given up

// [px] The largest that loses no more than the finest; 0 where there is none.
double finest_splat_of_use(const Forecast& forecast) {
    const auto& shapes = forecast.shapes;
    if (shapes.size() < 2) return 0;
    std::size_t step = 1;
    while (step + 1 < shapes.size() && shapes[step + 1].loss_px <= shapes[1].loss_px) ++step;
    return shapes[step].setting;
}

}  // namespace

void ForecastLaw::observe(const FrameSample& sample) {
    const bool is_counted = std::ranges::any_of(sample.work.counts, [](std::int64_t count) { return count > 0; });
    if (!is_counted) return;
    model_.observe(sample, aim_.target_ms);
    if (sample.decision == probe_.decision) probe_.age = 0;
}

void ForecastLaw::decide(const Forecast& forecast, std::int64_t frame) {
    Decision& decision = aim_.status.decision;
    if (model_.costs().is_ready()) {
        choose(forecast);
        decision = kept_;
    } else if (model_.costs().samples() == 0) {
        decision = kept_ = decision_of(first_guess(forecast));
    }
    // L may have shrunk below what is kept.
    if (decision.state != State::original) decision.motion_distance = std::min(decision.motion_distance, aim_.range);
    if (!model_.costs().is_ready()) return;
    probe(forecast);
    model_.foresee(frame, decision, plan_of(forecast, decision));
}

// Nothing has been timed yet: better two coarse frames on a fast machine than two of a second each on a slow one.
Plan ForecastLaw::first_guess(const Forecast& forecast) const {
    const Prices guess = prices_of_a_slow_machine(drawing_);
    const double least_ms = plan_ms(cheapest_plan(forecast, aim_.range), guess);
    if (least_ms > aim_.target_ms) return worthwhile_plan(forecast, aim_.range, guess, first_slack * least_ms);
    return least_loss_plan(forecast, aim_.range, guess, std::max(aim_.target_ms, first_slack * least_ms));
}

// Of those that take at most so long. Where nothing meets the target, detail must be worth its time.
Plan ForecastLaw::best_plan(const Forecast& forecast, double least_ms, double budget_ms) const {
    const bool is_out_of_reach = aim_.is_out_of_reach(model_.costs(), least_ms);
    const auto plan = is_out_of_reach ? worthwhile_plan : least_loss_plan;
    return plan(forecast, aim_.range, model_.foreseen_prices(), budget_ms);
}

void ForecastLaw::choose(const Forecast& forecast) {
    const CostModel& costs = model_.costs();
    aim_.status.price_ms = model_.prices();
    const Prices prices = model_.foreseen_prices();
    const double least_ms = plan_ms(cheapest_plan(forecast, aim_.range), prices);
    const double aim_ms = aim_.aim_ms(costs, least_ms, 0);
    const Plan now = plan_of(forecast, kept_);
    const Plan best = best_plan(forecast, least_ms, aim_ms);
    const Prediction prediction = model_.predict(now);
    double now_may_take_ms = aim_ms;
    if (aim_.is_out_of_reach(costs, least_ms)) {
        const double ms_where_worth_as_much = ms_of_detail(best, plan_ms(best, prices)) / (1 + now.loss_px);
        now_may_take_ms = std::min(aim_ms, ms_where_worth_as_much);
    }
    aim_.believe(prediction, costs);
    const bool is_worth_it = best.loss_px < now.loss_px * (1 - aim_.options.better);
    if (aim_.is_kept(prediction, now_may_take_ms) && !is_worth_it) return;
    const Plan plan = surely_fitting(forecast, best, least_ms, aim_ms);
    const Decision chosen = decision_of(plan);
    if (chosen == kept_) return;
    kept_ = chosen;
    since_choice_ = 0;
    aim_.status.reason = aim_.reason_to_move(prediction, aim_ms, least_ms);
    aim_.believe(model_.predict(plan), costs);
}

// The finest plan that would meet the aim even if it took `caution` sigmas longer. Where `best` is known too little,
// a plan between it and the cheapest is known better, and drawing that one teaches more.
Plan ForecastLaw::surely_fitting(const Forecast& forecast, const Plan& best, double least_ms, double aim_ms) const {
    const auto longest_ms = [&](const Plan& plan) {
        const Prediction prediction = model_.predict(plan);
        return std::exp(prediction.log_ms + aim_.options.caution * prediction.uncertainty);
    };
    if (least_ms >= aim_ms || longest_ms(best) <= aim_ms * (1 + aim_.options.band)) return best;
    double sure_ms = least_ms, unsure_ms = aim_ms;
    Plan sure = best_plan(forecast, least_ms, sure_ms);
    constexpr int halvings = 5;
    for (int i = 0; i < halvings; ++i) {
        const double middle_ms = std::sqrt(sure_ms * unsure_ms);
        const Plan middle = best_plan(forecast, least_ms, middle_ms);
        if (longest_ms(middle) <= aim_ms) {
            sure = middle;
            sure_ms = middle_ms;
        } else {
            unsure_ms = middle_ms;
        }
    }
    return sure;
}

// One frame with half the motion, or with the finest points: what the way down would cost, before it is needed. Where
// the target is out of reach, with more detail than is believed to be worth its time, as that may be wrong.
void ForecastLaw::probe(const Forecast& forecast) {
    if (!is_time_to_probe()) return;
    const Plan now = plan_of(forecast, kept_);
    const Plan cheapest = cheapest_plan(forecast, aim_.range);
    const double least_ms = plan_ms(cheapest, model_.foreseen_prices());
    Plan plan = now;
    if (aim_.is_out_of_reach(model_.costs(), least_ms)) {
        const double most_ms = aim_.aim_ms(model_.costs(), least_ms, 0);
        plan = least_loss_plan(forecast, aim_.range, model_.foreseen_prices(), most_ms);
        const bool is_finer = plan.loss_px < now.loss_px * (1 - aim_.options.better);
        if (probe_.finer >= aim_.options.probes || !is_finer || !is_doubtful(plan)) return;
        probe_.finer += 1;
        aim_.status.reason = "learning what finer detail costs";
    } else if (aim_.status.predicted_ms > aim_.target_ms) {
        return;
    } else if (probe_.motion < aim_.options.probes &&
               is_doubtful(plan_at(forecast, aim_.range, cheapest.distance, now.size))) {
        plan = slower_plan(forecast, aim_.range, now, probe_share);
        probe_.motion += 1;
        aim_.status.reason = "learning what motion costs";
    } else if (probe_.points < aim_.options.probes && now.size == 0 &&
               is_doubtful(plan_at(forecast, aim_.range, now.distance, cheapest.size))) {
        // The finest, then coarser ones: two sizes tell points from what every frame has.
        const double finest = finest_splat_of_use(forecast);
        plan = plan_at(forecast, aim_.range, now.distance, probe_.points == 0 ? finest : coarser_probe * finest);
        probe_.points += 1;
        aim_.status.reason = "learning what points cost";
    } else {
        return;
    }
    aim_.believe(model_.predict(plan), model_.costs());
    aim_.status.decision = probe_.decision = decision_of(plan);
    probe_.age = 1;
}

// Counts this decision. A probe waits until the one before has been answered.
bool ForecastLaw::is_time_to_probe() {
    if (probe_.age > 0 && ++probe_.age < longest_wait) return false;
    probe_.age = 0;
    return model_.costs().samples() >= first_probe && ++since_choice_ >= quiet_before_probe;
}

bool ForecastLaw::is_doubtful(const Plan& plan) const {
    return model_.predict(plan).uncertainty > doubtful;
}

Decision ForecastLaw::decision_of(const Plan& plan) const {
    const bool is_all_moving = !(plan.distance > 0 && plan.distance < aim_.range);
    if (!(plan.size > 0)) return is_all_moving ? Decision{} : Decision{State::slowed, plan.distance, 0};
    return {State::points, is_all_moving ? aim_.range : plan.distance, std::min(plan.size, max_splat_size)};
}

Plan ForecastLaw::plan_of(const Forecast& forecast, const Decision& decision) const {
    const bool is_all_moving = decision.state == State::original;
    const double distance = is_all_moving ? aim_.range : std::min(decision.motion_distance, aim_.range);
    return plan_at(forecast, aim_.range, distance, decision.splat_size);
}

}  // namespace sfsm
