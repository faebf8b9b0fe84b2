#include "sfsm/refresh.h"

#include <algorithm>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {

// How fast the gain is let down while frames are in time.
struct Refresh::Haste {
    double slow, fast;  // [ln gain] per frame
    int patience;       // [frames] in time for which it is slow
    double doubling;    // [frames] in which it then doubles
};

namespace {

constexpr Refresh::Haste rounded{4e-5, 1e-2, 80, 10};
constexpr Refresh::Haste capped{3e-4, 2e-2, 12, 5};

constexpr double slack = 1.05;       // [factor] by which a prediction may miss a refresh
constexpr double least_share = 0.6;  // [due] a shorter prediction has all detail
constexpr double another = 0.02;     // [share] by which a due time is another one
constexpr double pause = 8.5;        // [due] a longer time is no frame
constexpr int long_ago = 1 << 20;    // [frames]

// Of a display.
constexpr double late_per_drift = 60;            // [drifts] that a late frame takes back: 1.6 % are late then
constexpr double first_steps = 5, halving = 50;  // [slow drifts] after a climb; [frames] in which they halve
constexpr double overshoot = 7;                  // [drifts] of a climb that its first late frame takes back
constexpr int many_late = 3;                     // [frames] late in a row that are no chance: the load has risen
constexpr double more_load = 0.65;               // [share of a refresh, ln] by which a frame is then believed late
constexpr int in_time_after = 140;               // [frames] in time that count as gone by after that
constexpr int most_in_flight = 5;                // [frames] that were drawn before it was known

// Of any other floor.
constexpr double over_per_drift = 9;  // [drifts] that a frame over the floor takes back: 10 % are over it then
constexpr double noise_slack = 1.08;  // [prediction] up to which a time over the floor may be noise
constexpr int many_over = 6;          // [frames] over it in a row that are no chance

}  // namespace

void Refresh::observe(CostModel& model, const Amounts& amounts, const Time& time, double target_ms) {
    const double ms = time.ms;
    const bool is_known = evidence_ == Evidence::any && model.is_ready() && last_.terms > 0 && amounts != last_;
    const double log_step = is_known ? model.log_ms(amounts) - model.log_ms(last_) : 0;
    last_ = amounts;
    const bool was_waiting = is_waiting();
    floor_.observe(ms, log_step, target_ms);
    const double due_ms = floor_.due_ms(target_ms);
    if (!is_waiting() || !model.is_ready() || ms > pause * due_ms) return model.observe(amounts, time.known_ms);
    // Prices that were learned from such times say that nothing costs anything, or that a single step costs all.
    if (!was_waiting && evidence_ == Evidence::any) model.relearn(amounts, std::min(ms, floor_.ms()));
    if (!was_waiting || std::abs(due_ms / due_ms_ - 1) > another)
        in_time_ = floor_.is_deaf() ? long_ago : in_time_after;
    due_ms_ = due_ms;
    if (floor_.period_ms() > 0) {
        hear_rounded(model, amounts, ms);
    } else {
        hear_capped(model, amounts, ms);
    }
}

// Only the gain is moved: how prices compare can't be learned from such times.
void Refresh::hear_rounded(CostModel& model, const Amounts& amounts, double ms) {
    const double period_ms = floor_.period_ms();
    const double upper_ms = std::max(floor_.ms(), std::round(ms / period_ms) * period_ms);
    const double lower_ms = floor_.is_at(ms) ? 0 : upper_ms - period_ms;
    const double predicted_ms = std::exp(model.log_ms(amounts));
    const bool is_late = predicted_ms <= slack * lower_ms;
    late_ = is_late ? late_ + 1 : 0;
    if (late_ >= many_late) {
        const double log_ms = std::log(lower_ms) + more_load * std::log(upper_ms / lower_ms);
        model.nudge(log_ms - std::log(predicted_ms));
        late_ = 0;
        in_time_ = in_time_after;
        in_flight_ = most_in_flight;
        return;
    }
    if (is_late || predicted_ms <= slack * upper_ms) {
        model.observe(amounts, predicted_ms);
    } else {
        model.nudge(std::log(upper_ms / predicted_ms));
    }
    const bool is_old = is_late && in_flight_ > 0;
    in_flight_ = std::max(in_flight_ - 1, 0);
    if (!is_old && predicted_ms <= slack * due_ms_) seek(model, predicted_ms, is_late);
}

// Down while frames are in time, the faster the longer they were; back up when one is late, in steps that shrink.
void Refresh::seek(CostModel& model, double predicted_ms, bool is_late) {
    const double climb = drift(rounded);
    const double step = rounded.slow * std::max(1.0, first_steps * std::exp2(-since_climb_ / halving));
    since_climb_ += 1;
    if (is_late) {
        if (climb > step) since_climb_ = 0;
        model.nudge(std::max(late_per_drift * step, overshoot * climb));
        in_time_ = 0;
    } else {
        if (predicted_ms > least_share * due_ms_) model.nudge(-std::max(step, climb));
        in_time_ = std::min(in_time_ + 1, long_ago);
    }
}

// Well above the floor times are what the work took. Near it only the longer ones are seen, so they would mislead.
void Refresh::hear_capped(CostModel& model, const Amounts& amounts, double ms) {
    const double predicted_ms = std::exp(model.log_ms(amounts));
    const bool is_over = !floor_.is_at(ms);
    const bool is_near = predicted_ms <= slack * floor_.ms();
    late_ = is_over ? late_ + 1 : 0;
    in_time_ = is_over ? 0 : std::min(in_time_ + 1, long_ago);
    if (is_over && (!is_near || ms > noise_slack * predicted_ms || late_ >= many_over))
        return model.observe(amounts, ms);
    if (is_near) {
        model.observe(amounts, predicted_ms);
    } else {
        model.nudge(std::log(floor_.ms() / predicted_ms));
    }
    if (is_over) {
        model.nudge(over_per_drift * capped.slow);
    } else if (predicted_ms > least_share * due_ms_) {
        model.nudge(-drift(capped));
    }
}

// [ln gain] per frame in time.
double Refresh::drift(const Haste& haste) const {
    constexpr double most = 60;
    const double doublings = std::max(in_time_ - haste.patience, 0) / haste.doubling;
    return std::min(haste.slow * std::exp2(std::min(doublings, most)), haste.fast);
}

}  // namespace sfsm
