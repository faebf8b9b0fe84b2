#include "sfsm/aim.h"

#include <algorithm>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

// Leaps: a frame takes no twice the target even if it is two sigmas longer than predicted.
constexpr double surely = 2;        // [sigmas]
constexpr double most_over = 1.9;   // [targets]
constexpr double unsure = 0.2;      // uncertainty from which all that was learned may be wrong
constexpr double longest_leap = 4;  // [times of the newest frame]
constexpr double no_leap = 1.25;    // [times of the newest frame]

constexpr double clearly = 1.01;  // [target] slower

}  // namespace

void Aim::begin() {
    static_cast<Beliefs&>(status) = {};
    status.reason = kept_reason;
    status.kept_for += 1;
    status.is_probe = false;
}

void Aim::change(const char* reason) {
    status.reason = kept_reason = reason;
    status.kept_for = 0;
}

double Aim::wanted_ms(const CostModel& model) const {
    const double for_noise = 1 - std::min(options.headroom * model.noise(), options.most_headroom);
    const double for_tail = std::max(options.tail_limit * std::exp(-model.tail()), options.lowest_aim);
    return target_ms * std::min(for_noise, for_tail);
}

double Aim::aim_ms(const CostModel& model, double least_ms, double uncertainty) const {
    const double wanted = wanted_ms(model);
    if (least_ms > wanted) return least_ms + options.worthwhile * (least_ms - wanted);
    return std::max(std::min(wanted * std::exp(-options.caution * uncertainty), leap_ms(uncertainty)), least_ms);
}

double Aim::leap_ms(double uncertainty) const {
    const double surely_ms = target_ms * most_over * std::exp(-surely * uncertainty);
    const double far_ms = uncertainty > unsure ? longest_leap * status.last_ms : surely_ms;
    return std::max(no_leap * status.last_ms, std::min(surely_ms, far_ms));
}

bool Aim::is_kept(const Prediction& prediction, double aim_ms) const {
    const double band = std::max(options.band, options.band_sigmas * prediction.uncertainty);
    return std::abs(prediction.log_ms - std::log(aim_ms)) <= band;
}

bool Aim::is_capped(const Refresh& refresh) const {
    return refresh.is_capped() && target_ms > clearly * asked_ms;
}

const char* Aim::reason_to_move(const Prediction& kept, double aim_ms, double least_ms) const {
    if (least_ms > target_ms) return "out of reach: as fast as detail makes it";
    return kept.log_ms > std::log(aim_ms) ? "would be slow: coarser" : "has time to spare: finer";
}

void Aim::believe_waiting(const Refresh& refresh) {
    status.due_ms = target_ms;
    if (!refresh.is_waiting()) return;
    status.floor_ms = refresh.floor().ms();
    if (!refresh.is_capped()) status.refresh_ms = refresh.floor().period_ms();
}

void Aim::believe(const Prediction& prediction, const CostModel& model) {
    status.predicted_ms = std::exp(prediction.log_ms);
    status.uncertainty = prediction.uncertainty;
    status.noise = model.noise();
    status.gain = model.gain();
}

}  // namespace sfsm
