#include "sfsm/foresight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr int memory = 16;             // [frames] that the mean is over
constexpr double most_surprise = 0.1;  // [ln, or share of the time] a frame that is off by more counts as this much
constexpr double alike = 0.1;          // [share of the time] two frames that differ by less agree
constexpr double most_bias = 0.3;      // [ln]
constexpr double most_factor = 8;
constexpr double telling = 0.02;  // share of the time: of fewer pieces the share that is off says little of many

}  // namespace

void Foresight::foresee(std::int64_t frame, const Decision& decision, const Amounts& amounts) {
    foreseen_[static_cast<std::size_t>(frame) % foreseen_.size()] = {frame, decision, amounts};
}

void Foresight::observe(const FrameSample& sample, const Amounts& amounts, const CostModel& model) {
    const Foreseen& foreseen = foreseen_[static_cast<std::size_t>(sample.frame) % foreseen_.size()];
    if (foreseen.amounts.terms == 0 || foreseen.frame != sample.frame || foreseen.decision != sample.decision) return;
    if (learn_factors(foreseen.amounts, amounts, model)) bias_ = heard_ = 0;
    const double error = model.log_ms(amounts) - model.log_ms(corrected(foreseen.amounts));
    heard_ = std::min(heard_ + 1, memory);
    bias_ += std::clamp(error - bias_, -most_surprise, most_surprise) / heard_;
    bias_ = std::clamp(bias_, -most_bias, most_bias);
}

// Returns whether one has changed. What a kind takes is reckoned at a price that is a sigma up, as prices are learned
// while forecasts are off.
bool Foresight::learn_factors(const Amounts& foreseen, const Amounts& drawn, const CostModel& model) {
    const double total_ms = std::exp(model.log_ms(drawn));
    bool has_changed = false;
    for (int i = 1; i < drawn.terms; ++i) {
        const double most_ms = model.gain() * (model.price(i) + model.price_uncertainty(i));
        if (most_ms * foreseen.of[i] <= telling * total_ms) continue;
        const double surprise = most_ms * (drawn.of[i] - factor_[i] * foreseen.of[i]) / total_ms;
        const double before = std::exchange(surprise_[i], surprise);
        const bool is_wild = std::min(std::abs(surprise), std::abs(before)) > most_surprise;
        if (!is_wild || std::abs(surprise - before) > alike) continue;
        const double factor = std::clamp(drawn.of[i] / foreseen.of[i], 1 / most_factor, most_factor);
        has_changed = has_changed || factor != factor_[i];
        factor_[i] = factor;
    }
    return has_changed;
}

Amounts Foresight::corrected(Amounts foreseen) const {
    for (int i = 1; i < foreseen.terms; ++i) foreseen.of[i] *= factor_[i];
    return foreseen;
}

}  // namespace sfsm
