#include "sfsm/foresight.h"

#include <algorithm>

namespace sfsm {
namespace {

constexpr int memory = 16;             // [frames] that the mean is over
constexpr double most_surprise = 0.1;  // [ln] a frame that is off by more counts as this much
constexpr double most_bias = 0.3;      // [ln]

}  // namespace

void Foresight::foresee(std::int64_t frame, const Decision& decision, const Amounts& amounts) {
    foreseen_[static_cast<std::size_t>(frame) % foreseen_.size()] = {frame, decision, amounts};
}

void Foresight::observe(const FrameSample& sample, const Amounts& amounts, const CostModel& model) {
    const Foreseen& foreseen = foreseen_[static_cast<std::size_t>(sample.frame) % foreseen_.size()];
    if (foreseen.amounts.terms == 0 || foreseen.frame != sample.frame || foreseen.decision != sample.decision) return;
    const double error = model.predict(amounts).log_ms - model.predict(foreseen.amounts).log_ms;
    heard_ = std::min(heard_ + 1, memory);
    bias_ += std::clamp(error - bias_, -most_surprise, most_surprise) / heard_;
    bias_ = std::clamp(bias_, -most_bias, most_bias);
}

}  // namespace sfsm
