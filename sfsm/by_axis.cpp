#include "sfsm/by_axis.h"

#include <algorithm>
#include <cmath>

#include "sfsm/detail.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

// Believed at first: time grows in even steps of detail, to 1 + 1 / 0.3 = 4.3 times that of the coarsest.
constexpr double frame_amount = 0.3;
constexpr PriceBelief belief{1 + detail_steps, {1, 1, 1, 1, 1, 1, 1, 1, 1}, 0.7, {}};

constexpr double much_over = 1.03;          // [aim] at which a rise has failed
constexpr double out_of_reach_band = 0.05;  // over the aim, relative
constexpr double finest_points = 0.99 * detail_of_points;
constexpr double unknown_points = 0.1;  // uncertainty of what is beyond them
constexpr double most_ahead = 16;       // [frames] that the load is foreseen, of a drift
constexpr double retested_share = 0.5;  // of the detail
constexpr double least_retested = 0.1;  // detail
constexpr double near_by = 2;           // [sigmas] from what was predicted

Amounts amounts_of(double detail) {
    Amounts amounts;
    amounts.terms = 1 + detail_steps;
    amounts.of[0] = frame_amount;
    for (int i = 0; i < detail_steps; ++i)
        amounts.of[static_cast<std::size_t>(i + 1)] = std::clamp(detail_steps * detail - i, 0.0, 1.0) / detail_steps;
    return amounts;
}

}  // namespace

AxisLaw::AxisLaw(Aim& aim) : aim_(aim), costs_(belief) {}

void AxisLaw::observe(const FrameSample& sample) {
    if (aim_.range <= 0) return;
    const Drawn drawn = drawn_as(sample.decision);
    const Amounts amounts = amounts_of(drawn.detail);
    if (drawn.is_retest && !refresh_.is_waiting()) return hear_retest(amounts, sample.ms);
    refresh_.observe(costs_, amounts, {sample.ms, ms_of_known_load(sample, amounts, drawn.detail)}, aim_.asked_ms);
}

// A load that drifts is no price: detail goes down as it grows, so that times would tell that detail costs nothing. So
// the model is told times as they would be at the load that it knows.
double AxisLaw::ms_of_known_load(const FrameSample& sample, const Amounts& amounts, double detail) {
    if (!costs_.is_ready()) return sample.ms;
    if (refresh_.is_waiting() || is_out_of_reach()) {
        drift_ = {};
        newest_ = {};
        return sample.ms;
    }
    // By how much the load differs from the newest frame's, whatever has been learned of prices since.
    const double residual = std::log(sample.ms) - costs_.log_ms(amounts);
    if (newest_.ms > 0) newest_.log_load += residual - log_over_model(newest_);
    newest_ = {sample.frame, sample.ms, amounts, newest_.log_load};
    const double over_model = drift_.ahead(1) - (newest_.log_load - residual);
    const bool was_on = drift_.is_on();
    drift_.observe(newest_.log_load, detail, costs_.noise());
    if (drift_.is_on() && was_on) return sample.ms * std::exp(-over_model);
    if (drift_.is_on()) {
        costs_.relearn(amounts, sample.ms);
    } else if (was_on) {
        costs_.nudge(over_model);
    }
    return sample.ms;
}

double AxisLaw::log_over_model(const Heard& heard) const {
    return std::log(heard.ms) - costs_.log_ms(heard.amounts);
}

// Times that are far from what was predicted would be taken for another load. So those are kept from the model, unless
// they prove its prices wrong.
void AxisLaw::hear_retest(const Amounts& amounts, double ms) {
    const double residual = std::log(ms) - costs_.log_ms(amounts);
    if (reach_retest_.has_disproved(residual, costs_.noise())) {
        costs_.relearn(amounts, ms);
    } else if (std::abs(residual) < near_by * costs_.noise()) {
        costs_.observe(amounts, ms);
    }
}

void AxisLaw::decide(std::int64_t frame) {
    aim_.target_ms = refresh_.due_ms(aim_.asked_ms);
    bool is_given_up = false;
    if (costs_.is_ready() && is_following()) {
        follow(frame);
    } else if (costs_.is_ready()) {
        turn();
        is_given_up = aim_.status.least_ms > aim_.target_ms;
    } else if (costs_.samples() == 0) {
        detail_ = detail_of({State::points, aim_.range, first_splat}, aim_.range);
        aim_.change(reason_to_guess);
    }
    Drawn drawn = next_drawn(is_given_up);
    drawn.decision = decision_at(drawn.detail, aim_.range);
    if (drawn_count_ == 0 || drawn.decision != aim_.status.decision) remember(drawn);
    aim_.status.decision = drawn.decision;
    tell();
}

// What is believed, for whoever reads the status.
void AxisLaw::tell() const {
    Status& status = aim_.status;
    aim_.believe_waiting(refresh_);
    if (ceiling_.is_set()) status.ceiling = ceiling_.detail();
    if (is_following()) status.drift = drift_.slope();
    if (!costs_.is_ready()) return;
    const double gain = costs_.gain();
    const auto sigmas = costs_.cost_sigmas();
    status.price_ms.frame = gain * costs_.price(0) * frame_amount;
    status.price_sigma_ms.frame = sigmas[0] * frame_amount;
    for (std::size_t i = 0; i < detail_steps; ++i) {
        status.step_ms[i] = gain * costs_.price(static_cast<int>(i) + 1) / detail_steps;
        status.step_sigma_ms[i] = sigmas[i + 1] / detail_steps;
    }
}

// Where the target is out of reach, the detail that is kept is believed to cost little; under a cap, nothing.
AxisLaw::Drawn AxisLaw::next_drawn(bool is_given_up) {
    const bool has_less = costs_.is_ready() && detail_ > least_retested;
    const bool is_reach_tested = reach_retest_.step(is_given_up && has_less && !refresh_.is_waiting(), costs_.shifts());
    const bool is_cap_tested = cap_retest_.step(has_less && aim_.is_capped(refresh_), costs_.shifts());
    if (!is_reach_tested && !is_cap_tested) return {{}, detail_, false};
    aim_.status.is_probe = true;
    aim_.status.reason = is_cap_tested ? reason_to_test_cap : "out of reach: is less detail still in vain?";
    return {{}, retested_share * detail_, true};
}

void AxisLaw::turn() {
    const double least_ms = predicted_ms(0);
    const double aim_ms = aim_.aim_ms(costs_, least_ms, 0);
    const Prediction now = costs_.predict(amounts_of(detail_));
    ceiling_.step(predicted_ms(ceiling_.floor()), std::log(aim_ms) - now.log_ms);
    const double before = detail_;
    if (least_ms > aim_.target_ms) {
        turn_out_of_reach(detail_for(aim_ms), std::exp(now.log_ms) / aim_ms);
    } else if (!aim_.is_kept(now, aim_ms)) {
        turn_to(sure_detail(detail_for(aim_ms), least_ms), std::exp(now.log_ms), aim_ms);
    }
    aim_.status.least_ms = least_ms;
    aim_.status.aim_ms = aim_ms;
    if (detail_ != before) aim_.change(aim_.reason_to_move(now, aim_ms, least_ms));
    aim_.believe(detail_ != before ? costs_.predict(amounts_of(detail_)) : now, costs_);
}

// Every frame at the detail that meets the aim under the load that is due then.
void AxisLaw::follow(std::int64_t frame) {
    const double ahead = std::clamp(static_cast<double>(frame) - static_cast<double>(newest_.frame), 1.0, most_ahead);
    const double log_load = drift_.ahead(ahead) - newest_.log_load + log_over_model(newest_);
    const auto predict = [&](double detail) {
        Prediction prediction = costs_.predict(amounts_of(detail));
        prediction.log_ms += log_load;
        return prediction;
    };
    const double least_ms = std::exp(predict(0).log_ms);
    const double aim_ms = aim_.aim_ms(costs_, least_ms, 0);
    const double before = detail_;
    ceiling_.forget();
    detail_ = detail_for(aim_ms / std::exp(log_load));
    aim_.status.least_ms = least_ms;
    aim_.status.aim_ms = aim_ms;
    if (detail_ != before) aim_.change(aim_.reason_to_move(predict(before), aim_ms, least_ms));
    aim_.believe(predict(detail_), costs_);
}

// The detail to turn to where `wanted` is predicted to meet the aim: less while it is known little, and no triangles
// before their points are known, as cost may leap between the two.
double AxisLaw::sure_detail(double wanted, double least_ms) const {
    const double uncertainty = costs_.predict(amounts_of(wanted)).uncertainty;
    const double sure = detail_for(aim_.aim_ms(costs_, least_ms, uncertainty));
    const bool is_leap = detail_ < finest_points && sure > finest_points && uncertainty > unknown_points;
    return is_leap ? finest_points : sure;
}

void AxisLaw::turn_to(double detail, double now_ms, double aim_ms) {
    if (refresh_.is_waiting()) {
        detail_ = detail;
    } else if (detail > detail_) {
        detail_ = ceiling_.rise(detail_, detail, now_ms);
    } else if (detail < detail_) {
        detail_ = now_ms > much_over * aim_ms ? ceiling_.fall(detail_, detail) : detail;
    }
}

// Detail that seems to cost nothing is kept until it clearly does.
void AxisLaw::turn_out_of_reach(double detail, double over_aim) {
    if (detail > detail_ || over_aim > 1 + out_of_reach_band) detail_ = detail;
}

// Times of frames that wait, or are out of reach, don't tell how the load drifts.
bool AxisLaw::is_following() const {
    return drift_.is_on() && !refresh_.is_waiting() && !is_out_of_reach();
}

bool AxisLaw::is_out_of_reach() const {
    return predicted_ms(0) > aim_.target_ms;
}

double AxisLaw::predicted_ms(double detail) const {
    return std::exp(costs_.log_ms(amounts_of(detail)));
}

// The detail that takes `ms`, in [0, 1].
double AxisLaw::detail_for(double ms) const {
    const double gain = costs_.gain();
    double time = gain * costs_.price(0) * frame_amount;
    for (int i = 0; i < detail_steps; ++i) {
        const double step = gain * costs_.price(i + 1) / detail_steps;
        if (time + step > ms) return (i + std::clamp((ms - time) / step, 0.0, 1.0)) / detail_steps;
        time += step;
    }
    return 1;
}

AxisLaw::Drawn AxisLaw::drawn_as(const Decision& decision) const {
    for (std::size_t i = 0; i < drawn_count_; ++i) {
        if (drawn_[i].decision == decision) return drawn_[i];
    }
    const double detail = detail_of(decision, aim_.range);
    return {decision, std::isfinite(detail) ? detail : 1};
}

void AxisLaw::remember(const Drawn& drawn) {
    std::rotate(drawn_.begin(), drawn_.end() - 1, drawn_.end());
    drawn_.front() = drawn;
    drawn_count_ = std::min(drawn_count_ + 1, drawn_.size());
}

}  // namespace sfsm
