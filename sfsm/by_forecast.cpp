#include "sfsm/by_forecast.h"

#include <algorithm>
#include <cmath>

#include "sfsm/detail.h"
#include "sfsm/pair_plans.h"
#include "sfsm/rate_plans.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double first_slack = 1.5;  // over the least: the cheapest frame would teach too little of the others

constexpr double doubtful = 0.05;          // uncertainty of the way down that is worth a probe
constexpr double unknown_least = 0.0275;   // uncertainty of the cheapest plan that is worth one
constexpr int first_probe = 12;            // times before it: the noise of a frame has to be known
constexpr int quiet_before_probe = 8;      // decisions without change
constexpr int longest_wanted_wait = 1024;  // [decisions] without change before finer detail is tried again
constexpr double retested_share = 0.5;     // of the time that is predicted
constexpr int longest_wait = 24;           // decisions until a probe's time is given up

}  // namespace

void ForecastLaw::observe(const FrameSample& sample) {
    const bool is_counted = std::ranges::any_of(sample.work.counts, [](std::int64_t count) { return count > 0; });
    if (!is_counted) return;
    model_.observe(sample, aim_.asked_ms);
    if (sample.decision == probe_.decision) probe_.age = 0;
}

void ForecastLaw::decide(const Forecast& forecast, std::int64_t frame) {
    aim_.target_ms = model_.due_ms(aim_.asked_ms);
    if (forecast.rates.empty()) {
        decide_among(PairPlans(forecast, aim_.range), frame);
    } else {
        decide_among(RatePlans(forecast, aim_.range), frame);
    }
    tell();
}

// What is believed, for whoever reads the status.
void ForecastLaw::tell() const {
    aim_.believe_waiting(model_.refresh());
    if (!model_.costs().is_ready()) return;
    aim_.status.price_ms = model_.prices();
    aim_.status.price_sigma_ms = model_.price_sigmas();
    aim_.status.foreseen_bias = model_.foresight().bias();
    for (std::size_t i = 0; i < work_kinds; ++i)
        aim_.status.foreseen_factor[i] = model_.foresight().factor(static_cast<int>(i) + 1);
}

void ForecastLaw::decide_among(const Plans& plans, std::int64_t frame) {
    Decision& decision = aim_.status.decision;
    if (model_.costs().is_ready()) {
        choose(plans);
        decision = kept_;
    } else if (model_.costs().samples() == 0) {
        decision = kept_ = plans.decision_of(first_guess(plans));
        aim_.change(reason_to_guess);
    }
    // L may have shrunk below what is kept.
    if (decision.state != State::original) decision.motion_distance = std::min(decision.motion_distance, aim_.range);
    if (!model_.costs().is_ready()) return;
    probe(plans);
    model_.foresee(frame, decision, plans.at(decision));
}

// Nothing has been timed yet: better two coarse frames on a fast machine than two of a second each on a slow one. None
// is finer than points that are four times the finest, as a machine may be slower still.
Plan ForecastLaw::first_guess(const Plans& plans) const {
    const Prices guess = prices_of_a_slow_machine(drawing_);
    const double fine_ms = plan_ms(plans.at({State::points, aim_.range, first_splat}), guess);
    const double least_ms = plan_ms(plans.cheapest(guess), guess);
    if (least_ms > aim_.target_ms) return plans.worthwhile(guess, first_slack * least_ms);
    return plans.least_loss(guess, std::min(fine_ms, std::max(aim_.target_ms, first_slack * least_ms)));
}

// Of those that take at most so long. Where nothing meets the target, detail must be worth its time.
Plan ForecastLaw::best_plan(const Plans& plans, double least_ms, double budget_ms) const {
    const Prices prices = model_.foreseen_prices();
    if (aim_.is_out_of_reach(model_.costs(), least_ms)) return plans.worthwhile(prices, budget_ms);
    return plans.least_loss(prices, budget_ms);
}

void ForecastLaw::choose(const Plans& plans) {
    const CostModel& costs = model_.costs();
    const Prices prices = model_.foreseen_prices();
    const double least_ms = plan_ms(plans.cheapest(prices), prices);
    const double aim_ms = aim_.aim_ms(costs, least_ms, 0);
    aim_.status.least_ms = least_ms;
    aim_.status.aim_ms = aim_ms;
    wanted_.reset();
    kept_ = plans.renewed(kept_);
    const Plan now = plans.at(kept_);
    const Plan best = best_plan(plans, least_ms, aim_ms);
    const Prediction prediction = model_.predict(now);
    double now_may_take_ms = aim_ms;
    if (aim_.is_out_of_reach(costs, least_ms)) {
        const double ms_where_worth_as_much = ms_of_detail(best, plan_ms(best, prices)) / (1 + now.loss);
        now_may_take_ms = std::min(aim_ms, ms_where_worth_as_much);
    }
    aim_.believe(prediction, costs);
    const bool is_worth_it = plans.is_better(best, now, aim_.options.better);
    if (aim_.is_kept(plans.once_drawn(prediction, costs.noise()), now_may_take_ms) && !is_worth_it) return;
    const Plan plan = surely_fitting(plans, best, least_ms, aim_ms);
    // What is surely better moves with every time that is heard.
    const bool is_fast_enough = prediction.log_ms <= std::log(now_may_take_ms);
    if (is_worth_it && is_fast_enough && !plans.is_better(plan, now, aim_.options.better)) {
        wanted_ = best;
        return;
    }
    const Decision chosen = plans.decision_of(plan);
    if (chosen == kept_) return;
    kept_ = chosen;
    since_choice_ = 0;
    aim_.change(aim_.reason_to_move(prediction, aim_ms, least_ms));
    aim_.believe(model_.predict(plan), costs);
}

// The finest plan that would meet the aim even if it took a margin longer. Where `best` is known too little, a plan
// between it and the cheapest is known better, and drawing that one teaches more.
Plan ForecastLaw::surely_fitting(const Plans& plans, const Plan& best, double least_ms, double aim_ms) const {
    const auto is_sure = [&](const Plan& plan, double limit_ms) {
        const Prediction prediction = model_.predict(plan);
        const double ms = std::exp(prediction.log_ms);
        const double longest_ms = ms * std::exp(aim_.options.caution * prediction.uncertainty);
        return longest_ms <= limit_ms && ms <= aim_.leap_ms(prediction.uncertainty);
    };
    if (least_ms >= aim_ms || is_sure(best, aim_ms * (1 + aim_.options.band))) return best;
    double sure_ms = least_ms, unsure_ms = aim_ms;
    Plan sure = best_plan(plans, least_ms, sure_ms);
    constexpr int halvings = 5;
    for (int i = 0; i < halvings; ++i) {
        const double middle_ms = std::sqrt(sure_ms * unsure_ms);
        const Plan middle = best_plan(plans, least_ms, middle_ms);
        if (is_sure(middle, aim_ms)) {
            sure = middle;
            sure_ms = middle_ms;
        } else {
            unsure_ms = middle_ms;
        }
    }
    return sure;
}

// One frame with half the motion, or with points: what the way down would cost, before it is needed. Where the target
// is out of reach, with more detail than is believed to be worth its time, as that may be wrong.
// A cap that is slower than the target is tested again, as something else may have been taken for one.
void ForecastLaw::probe(const Plans& plans) {
    if (cap_retest_.step(aim_.is_capped(model_.refresh()), model_.costs().shifts())) {
        const Plan less = plans.least_loss(model_.foreseen_prices(), retested_share * aim_.status.predicted_ms);
        if (plans.decision_of(less) == kept_) return;
        aim_.status.reason = reason_to_test_cap;
        return draw_probe(plans, less);
    }
    if (!is_time_to_probe()) return;
    const std::optional<Plan> plan = next_probe(plans, plans.at(kept_));
    if (!plan) return;
    draw_probe(plans, *plan);
    probe_.decision = aim_.status.decision;
    probe_.age = 1;
}

void ForecastLaw::draw_probe(const Plans& plans, const Plan& plan) {
    aim_.believe(model_.predict(plan), model_.costs());
    aim_.status.decision = plans.decision_of(plan);
    aim_.status.is_probe = true;
}

// Counts this decision. A probe waits until the one before has been answered.
bool ForecastLaw::is_time_to_probe() {
    if (probe_.age > 0 && ++probe_.age < longest_wait) return false;
    probe_.age = 0;
    return model_.costs().samples() >= first_probe && ++since_choice_ >= quiet_before_probe;
}

std::optional<Plan> ForecastLaw::next_probe(const Plans& plans, const Plan& now) {
    const Prices prices = model_.foreseen_prices();
    const Plan cheapest = plans.cheapest(prices);
    const double least_ms = plan_ms(cheapest, prices);
    if (aim_.is_out_of_reach(model_.costs(), least_ms)) return probe_out_of_reach(plans, now, cheapest, least_ms);
    if (aim_.status.predicted_ms > aim_.target_ms) return {};
    for (const Lesson lesson : {Lesson::motion, Lesson::points}) {
        int& drawn = probe_.of[static_cast<std::size_t>(lesson)];
        if (drawn >= aim_.options.probes) continue;
        const std::optional<Plan> needed = plans.needed(lesson, now, cheapest);
        if (!needed || !is_doubtful(*needed)) continue;
        aim_.status.reason = lesson == Lesson::motion ? "learning what motion costs" : "learning what points cost";
        return plans.lesson(lesson, now, drawn++);
    }
    return wanted_probe();
}

std::optional<Plan> ForecastLaw::probe_out_of_reach(const Plans& plans, const Plan& now, const Plan& cheapest,
                                                    double least_ms) {
    if (since_choice_ % quiet_before_probe != 0) return {};
    if (is_least_unknown(cheapest)) return cheapest;
    return probe_.finer < aim_.options.probes ? finer_probe(plans, now, least_ms) : std::nullopt;
}

// Once in a while: what it would cost is not known until it is drawn.
std::optional<Plan> ForecastLaw::wanted_probe() {
    if (!wanted_ || since_choice_ < probe_.wanted_wait) return {};
    probe_.wanted_wait = std::min(2 * probe_.wanted_wait, longest_wanted_wait);
    aim_.status.reason = "learning what finer detail costs";
    return wanted_;
}

std::optional<Plan> ForecastLaw::finer_probe(const Plans& plans, const Plan& now, double least_ms) {
    const double most_ms = aim_.aim_ms(model_.costs(), least_ms, 0);
    const Plan plan = plans.least_loss(model_.foreseen_prices(), most_ms);
    const bool is_finer = plans.is_better(plan, now, aim_.options.better);
    if (!is_finer || !is_doubtful(plan)) return {};
    probe_.finer += 1;
    aim_.status.reason = "learning what finer detail costs";
    return plan;
}

// What detail may cost out of reach is measured by the least that a frame takes.
bool ForecastLaw::is_least_unknown(const Plan& cheapest) {
    if (model_.predict(cheapest).uncertainty <= unknown_least) return false;
    aim_.status.reason = "learning what the least costs";
    return true;
}

bool ForecastLaw::is_doubtful(const Plan& plan) const {
    return model_.predict(plan).uncertainty > doubtful;
}

}  // namespace sfsm
