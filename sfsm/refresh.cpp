#include "sfsm/refresh.h"

#include <algorithm>
#include <cmath>

namespace sfsm {
namespace {

constexpr double same = 1e-6;                           // [share] by which a rounded time may be off
constexpr int convincing = 4;                           // [times] in a row that must be whole refreshes
constexpr double slack = 1.05;                          // [factor] by which a prediction may miss a refresh
constexpr int many_late = 3;                            // [frames] late in a row that are no chance
constexpr double many = 8;                              // [refreshes] a longer time is no frame
constexpr double fast_drift = 2e-3, slow_drift = 4e-5;  // [ln gain] per frame in time: far from a miss, and near one
constexpr double late_per_drift = 49;                   // [slow drifts] that a late frame takes back: 2 % are late then
constexpr int nearness = 250;                           // [frames] in time until a miss is long ago
constexpr double first_late = 0.03;                     // [ln gain] that a miss takes back after a long time without

}  // namespace

void Refresh::observe(CostModel& model, const Amounts& amounts, double ms, double target_ms) {
    const double refreshes = target_ms > 0 ? std::round(ms / target_ms) : 0;
    const bool is_whole = refreshes >= 1 && refreshes <= many && std::abs(ms - refreshes * target_ms) <= same * ms;
    rounded_ = is_whole ? std::min(rounded_ + 1, convincing) : 0;
    if (rounded_ < convincing || !model.is_ready()) return model.observe(amounts, ms);
    if (target_ms != target_ms_) near_ = 0;
    target_ms_ = target_ms;
    const double predicted_ms = std::exp(model.predict(amounts).log_ms);
    const double least_ms = (refreshes - 1) * target_ms;
    const bool is_late = predicted_ms <= slack * least_ms;
    const bool is_expected = !is_late && predicted_ms <= slack * ms;
    late_ = is_late ? late_ + 1 : 0;
    if (is_expected || (is_late && late_ < many_late)) {
        model.observe(amounts, predicted_ms);
    } else {
        model.observe(amounts, least_ms > 0 ? std::sqrt(least_ms * ms) : ms);
    }
    if (predicted_ms <= slack * target_ms) drift(model, is_late);
}

void Refresh::drift(CostModel& model, bool is_late) {
    if (is_late) {
        model.nudge(near_ > 0 ? late_per_drift * slow_drift : first_late);
        near_ = nearness;
    } else {
        model.nudge(near_ > 0 ? -slow_drift : -fast_drift);
        near_ = std::max(near_ - 1, 0);
    }
}

}  // namespace sfsm
