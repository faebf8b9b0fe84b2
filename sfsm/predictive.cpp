#include "sfsm/predictive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "sfsm/detail.h"
#include "sfsm/usable.h"

namespace sfsm {

void PredictiveOptions::validate() const {
    const auto require = [](bool holds, const char* rule) {
        if (!holds) throw std::invalid_argument(std::string("predictive law: expected ") + rule);
    };
    require(headroom >= 0 && headroom <= 3, "headroom in [0, 3]");
    require(most_headroom >= 0 && most_headroom <= 0.5, "most_headroom in [0, 0.5]");
    require(caution >= 0 && caution <= 3, "caution in [0, 3]");
    require(probes >= 0, "probes from 0");
    require(band >= 0 && band <= 0.2, "band in [0, 0.2]");
    require(band_sigmas >= 0 && band_sigmas <= 6, "band_sigmas in [0, 6]");
    require(worthwhile >= 0 && worthwhile <= 1, "worthwhile in [0, 1]");
    require(better >= 0 && better <= 1, "better in [0, 1]");
}

namespace {

// What is believed of a renderer nobody has measured; the kinds of work are work_table's.
constexpr double first_piece_ms = 30e-6;  // until the first times are there: a slow machine's, since a second is long
constexpr double first_slack = 1.5;       // over the least: the cheapest frame would teach too little of the others
constexpr double frame_share = 0.05;      // of the first frame's pieces, for what is there in every frame
constexpr PriceBelief work_belief = [] {
    PriceBelief all;
    all.terms = 1 + static_cast<int>(work_kinds);
    all.spread[0] = 1;
    for (std::size_t i = 0; i < work_kinds; ++i) {
        all.spread[i + 1] = work_table[i].prior.spread;
        all.least[i + 1] = work_table[i].prior.least;
    }
    return all;
}();

// And of the axis: time grows in even steps of detail, to 1 + 1 / 0.3 = 4.3 times that of the coarsest.
constexpr int detail_steps = 8;
constexpr double axis_frame = 0.3;
constexpr PriceBelief axis_belief{1 + detail_steps, {1, 1, 1, 1, 1, 1, 1, 1, 1}, 0.7, {}};

constexpr double doubtful = 0.05;      // uncertainty of the way down that is worth a probe
constexpr double probe_share = 0.5;    // of the motion that such a frame has
constexpr double coarser_probe = 4;    // times the finest splat
constexpr int first_probe = 12;        // times before it: the noise of a frame has to be known
constexpr int quiet_before_probe = 8;  // decisions without change
constexpr int longest_wait = 24;       // decisions until a probe's time is given up

constexpr double much_over = 1.03;  // t at which a rise has failed

constexpr double out_of_reach_band = 0.05;  // over the aim, relative

Amounts axis_amounts(double detail) {
    Amounts amounts;
    amounts.terms = 1 + detail_steps;
    amounts.of[0] = axis_frame;
    for (int i = 0; i < detail_steps; ++i)
        amounts.of[static_cast<std::size_t>(i + 1)] = std::clamp(detail_steps * detail - i, 0.0, 1.0) / detail_steps;
    return amounts;
}

}  // namespace

PredictiveLaw::PredictiveLaw(const PredictiveOptions& options)
    : options_(options), work_(work_belief), axis_(axis_belief) {
    options_.validate();
}

void PredictiveLaw::observe(const FrameSample& sample) {
    if (!is_usable(sample.ms)) {
        ++status_.bad_samples;
        return;
    }
    status_.last_ms = sample.ms;
    if (std::ranges::any_of(sample.work.counts, [](std::int64_t count) { return count > 0; })) {
        std::array<double, work_kinds> counts;
        std::ranges::transform(sample.work.counts, counts.begin(), counted);
        if (frame_amount_ == 0) {
            double pieces = 0;
            for (const double amount : amounts_of(counts).of) pieces += amount;
            frame_amount_ = frame_share * pieces;
        }
        const Amounts amounts = amounts_of(counts);
        if (work_.is_ready()) foresight_.observe(sample, amounts, work_);
        work_refresh_.observe(work_, amounts, sample.ms, target_ms_);
        if (sample.decision == probe_.decision) probe_.age = 0;
    }
    if (!has_forecast_ && range_ > 0)
        axis_refresh_.observe(axis_, axis_amounts(drawn_detail(sample.decision)), sample.ms, target_ms_);
}

Decision PredictiveLaw::decide(const FrameRequest& request) {
    if (is_usable(request.target_ms)) {
        if (request.target_ms != target_ms_) ceiling_.forget();
        status_.target_ms = target_ms_ = request.target_ms;
    }
    if (is_usable(request.range)) range_ = request.range;
    has_forecast_ = request.forecast && !request.forecast->motion.empty() && !request.forecast->shapes.empty();
    if (target_ms_ > 0 && range_ > 0) {
        if (has_forecast_) {
            decide_from(*request.forecast);
        } else {
            decide_on_axis();
        }
    }
    ++decisions_;
    return status_.decision;
}

// Below the target for the noise, and lower for what is not known. Where even the coarsest is too slow, as near to that
// as is worth the detail.
double PredictiveLaw::aim(const CostModel& model, double least_ms, double uncertainty) const {
    const double headroom = std::min(options_.headroom * model.noise(), options_.most_headroom);
    const double aim_ms = target_ms_ * (1 - headroom);
    if (least_ms > aim_ms) return least_ms + options_.worthwhile * (least_ms - aim_ms);
    return std::max(aim_ms * std::exp(-options_.caution * uncertainty), least_ms);
}

const char* PredictiveLaw::reason_to_move(const Prediction& kept, double aim_ms, double least_ms) const {
    if (least_ms > target_ms_) return "out of reach: as fast as detail makes it";
    return kept.log_ms > std::log(aim_ms) ? "would be slow: coarser" : "has time to spare: finer";
}

bool PredictiveLaw::is_kept(const Prediction& prediction, double aim_ms) const {
    const double band = std::max(options_.band, options_.band_sigmas * prediction.uncertainty);
    return std::abs(prediction.log_ms - std::log(aim_ms)) <= band;
}

void PredictiveLaw::believe(const Prediction& prediction, const CostModel& model) {
    status_.predicted_ms = std::exp(prediction.log_ms);
    status_.uncertainty = prediction.uncertainty;
    status_.noise = model.noise();
    status_.gain = model.gain();
}

void PredictiveLaw::believe_prices() {
    status_.price_ms.frame = work_.gain() * work_.price(0) * frame_amount_;
    for (std::size_t i = 0; i < work_kinds; ++i)
        status_.price_ms.each[i] = work_.gain() * work_.price(static_cast<int>(i) + 1) * work_table[i].prior.pieces;
}

// The detail that takes `ms`, in [0, 1].
double PredictiveLaw::detail_for(double ms) const {
    double time = axis_.gain() * axis_.price(0) * axis_frame;
    for (int i = 0; i < detail_steps; ++i) {
        const double step = axis_.gain() * axis_.price(i + 1) / detail_steps;
        if (time + step > ms) return (i + std::clamp((ms - time) / step, 0.0, 1.0)) / detail_steps;
        time += step;
    }
    return 1;
}

double PredictiveLaw::drawn_detail(const Decision& decision) const {
    for (std::size_t i = 0; i < drawn_count_; ++i) {
        if (drawn_[i].decision == decision) return drawn_[i].detail;
    }
    const double detail = detail_of(decision, range_);
    return std::isfinite(detail) ? detail : 1;
}

double PredictiveLaw::axis_ms(double detail) const {
    return std::exp(axis_.predict(axis_amounts(detail)).log_ms);
}

void PredictiveLaw::turn_axis() {
    const double least_ms = axis_ms(0);
    const double aim_ms = aim(axis_, least_ms, 0);
    const Prediction now = axis_.predict(axis_amounts(detail_));
    ceiling_.step(axis_ms(ceiling_.floor()));
    const double sure_ms = aim(axis_, least_ms, axis_.predict(axis_amounts(detail_for(aim_ms))).uncertainty);
    const double before = detail_;
    if (least_ms > target_ms_) {
        turn_out_of_reach(detail_for(aim_ms), std::exp(now.log_ms) / aim_ms);
    } else if (!is_kept(now, aim_ms)) {
        turn_to(detail_for(sure_ms), std::exp(now.log_ms));
    }
    if (detail_ != before) status_.reason = reason_to_move(now, aim_ms, least_ms);
    believe(axis_.predict(axis_amounts(detail_)), axis_);
}

void PredictiveLaw::turn_to(double detail, double now_ms) {
    if (detail > detail_) {
        detail_ = ceiling_.rise(detail_, detail, now_ms);
    } else if (detail < detail_) {
        detail_ = now_ms > much_over * target_ms_ ? ceiling_.fall(detail_, detail) : detail;
    }
}

// Detail that seems to cost nothing is kept until it clearly does.
void PredictiveLaw::turn_out_of_reach(double detail, double over_aim) {
    if (detail > detail_ || over_aim > 1 + out_of_reach_band) detail_ = detail;
}

void PredictiveLaw::decide_on_axis() {
    if (axis_.is_ready()) turn_axis();
    const Decision decision = decision_at(detail_, range_);
    if (drawn_count_ == 0 || decision != status_.decision) {
        std::rotate(drawn_.begin(), drawn_.end() - 1, drawn_.end());
        drawn_.front() = {decision, detail_};
        drawn_count_ = std::min(drawn_count_ + 1, drawn_.size());
    }
    status_.decision = decision;
}

Amounts PredictiveLaw::amounts_of(const std::array<double, work_kinds>& counts) const {
    Amounts amounts;
    amounts.terms = work_belief.terms;
    amounts.of[0] = frame_amount_;
    for (std::size_t i = 0; i < work_kinds; ++i) amounts.of[i + 1] = work_table[i].prior.pieces * counts[i];
    return amounts;
}

Prediction PredictiveLaw::predicted(const Plan& plan) const {
    Prediction prediction = work_.predict(amounts_of(plan.counts));
    prediction.log_ms += foresight_.bias();
    return prediction;
}

Prices PredictiveLaw::prices() const {
    const double drawn = std::exp(foresight_.bias());  // for each that is foreseen
    return drawn * status_.price_ms;
}

Decision PredictiveLaw::decision_of(const Plan& plan) const {
    const bool is_all_moving = !(plan.distance > 0 && plan.distance < range_);
    if (!(plan.size > 0)) return is_all_moving ? Decision{} : Decision{State::slowed, plan.distance, 0};
    return {State::points, is_all_moving ? range_ : plan.distance, std::min(plan.size, max_splat_size)};
}

Plan PredictiveLaw::plan_of(const Forecast& forecast, const Decision& decision) const {
    const double distance = decision.state == State::original ? range_ : std::min(decision.motion_distance, range_);
    return plan_at(forecast, range_, distance, decision.splat_size);
}

void PredictiveLaw::decide_from(const Forecast& forecast) {
    if (work_.is_ready()) {
        choose(forecast);
        status_.decision = kept_;
    } else if (work_.samples() == 0) {
        status_.decision = kept_ = decision_of(first_guess(forecast));
    }
    // L may have shrunk below what is kept.
    Decision& decision = status_.decision;
    if (decision.state != State::original) decision.motion_distance = std::min(decision.motion_distance, range_);
    if (!work_.is_ready()) return;
    probe(forecast);
    foresight_.foresee(decisions_, decision, amounts_of(plan_of(forecast, decision).counts));
}

// The finest plan that would meet the aim even if it took `caution` sigmas longer. What is known little of is known
// better nearby: between the cheapest plan and `best` there is one that can be trusted, and drawing it teaches more.
Plan PredictiveLaw::surely_fitting(const Forecast& forecast, const Prices& prices, const Plan& best, double least_ms,
                                   double aim_ms) const {
    const auto longest_ms = [&](const Plan& plan) {
        const Prediction prediction = predicted(plan);
        return std::exp(prediction.log_ms + options_.caution * prediction.uncertainty);
    };
    if (least_ms >= aim_ms || longest_ms(best) <= aim_ms * (1 + options_.band)) return best;
    double sure_ms = least_ms, unsure_ms = aim_ms;
    Plan sure = least_loss_plan(forecast, range_, prices, sure_ms);
    constexpr int halvings = 5;
    for (int i = 0; i < halvings; ++i) {
        const double middle_ms = std::sqrt(sure_ms * unsure_ms);
        const Plan middle = least_loss_plan(forecast, range_, prices, middle_ms);
        if (longest_ms(middle) <= aim_ms) {
            sure = middle;
            sure_ms = middle_ms;
        } else {
            unsure_ms = middle_ms;
        }
    }
    return sure;
}

// Nothing has been timed yet: better two coarse frames on a fast machine than two of a second each on a slow one.
Plan PredictiveLaw::first_guess(const Forecast& forecast) const {
    Prices guess;
    for (std::size_t i = 0; i < work_kinds; ++i) guess.each[i] = first_piece_ms * work_table[i].prior.pieces;
    const double least_ms = plan_ms(cheapest_plan(forecast, range_), guess);
    return least_loss_plan(forecast, range_, guess, std::max(target_ms_, first_slack * least_ms));
}

void PredictiveLaw::choose(const Forecast& forecast) {
    believe_prices();
    const Prices prices = this->prices();
    const double least_ms = plan_ms(cheapest_plan(forecast, range_), prices);
    const double aim_ms = aim(work_, least_ms, 0);
    const Plan now = plan_of(forecast, kept_);
    const Plan best = least_loss_plan(forecast, range_, prices, aim_ms);
    const Prediction prediction = predicted(now);
    believe(prediction, work_);
    if (is_kept(prediction, aim_ms) && !(best.loss_px < now.loss_px * (1 - options_.better))) return;
    const Plan plan = surely_fitting(forecast, prices, best, least_ms, aim_ms);
    const Decision chosen = decision_of(plan);
    if (chosen == kept_) return;
    kept_ = chosen;
    since_choice_ = 0;
    status_.reason = reason_to_move(prediction, aim_ms, least_ms);
    believe(predicted(plan), work_);
}

bool PredictiveLaw::is_doubtful(const Plan& plan) const {
    return predicted(plan).uncertainty > doubtful;
}

// One frame with half the motion, or with the finest points: what the way down would cost, before it is needed. A
// probe waits until the one before has been answered.
void PredictiveLaw::probe(const Forecast& forecast) {
    if (probe_.age > 0 && ++probe_.age < longest_wait) return;
    probe_.age = 0;
    if (work_.samples() < first_probe || ++since_choice_ < quiet_before_probe || !(status_.predicted_ms <= target_ms_))
        return;
    const Plan now = plan_of(forecast, kept_);
    const Plan cheapest = cheapest_plan(forecast, range_);
    Plan plan = now;
    if (probe_.motion < options_.probes && is_doubtful(plan_at(forecast, range_, cheapest.distance, now.size))) {
        plan = slower_plan(forecast, range_, now, probe_share);
        probe_.motion += 1;
        status_.reason = "learning what motion costs";
    } else if (probe_.splats < options_.probes && now.size == 0 &&
               is_doubtful(plan_at(forecast, range_, now.distance, cheapest.size))) {
        // The finest, then coarser ones: two sizes tell points from what every frame has.
        const double size = forecast.shapes.size() > 1 ? forecast.shapes[1].setting : 0;
        plan = plan_at(forecast, range_, now.distance, probe_.splats == 0 ? size : coarser_probe * size);
        probe_.splats += 1;
        status_.reason = "learning what points cost";
    } else {
        return;
    }
    believe(predicted(plan), work_);
    status_.decision = probe_.decision = decision_of(plan);
    probe_.age = 1;
}

}  // namespace sfsm
