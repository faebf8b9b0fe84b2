#include "sfsm/rivals/one_knob.h"

#include <algorithm>
#include <cmath>

#include "sfsm/detail.h"
#include "sfsm/usable.h"

namespace sfsm {
namespace {

constexpr double shortest_target = 1e-6, longest_target = 1e9;  // [ms]
constexpr double largest_load = 1000;

}  // namespace

void OneKnob::observe(const FrameSample& sample) {
    if (!is_usable(sample.ms)) {
        ++status_.bad_samples;
        return;
    }
    status_.last_ms = sample.ms;
    if (target_ms_ == 0) return;
    const double load = std::clamp(sample.ms / target_ms_, 1 / largest_load, largest_load);
    const double drawn = detail_of(sample.decision, range_);
    learn({load * target_ms_, target_ms_, load, std::isfinite(drawn) ? drawn : detail_});
}

Decision OneKnob::decide(const FrameRequest& request) {
    if (is_usable(request.range)) range_ = request.range;
    if (is_usable(request.target_ms)) {
        status_.target_ms = request.target_ms;
        target_ms_ = std::clamp(request.target_ms, shortest_target, longest_target);
    }
    if (target_ms_ > 0) status_.decision = decision_at(detail_, range_);
    return status_.decision;
}

void OneKnob::reset() {
    const double target_ms = target_ms_, asked_ms = status_.target_ms, range = range_;
    forget();
    target_ms_ = target_ms;
    status_.target_ms = asked_ms;
    range_ = range;
}

bool OneKnob::turn_to(double detail, const char* reason) {
    status_.reason = reason;
    if (std::isnan(detail)) return true;
    detail_ = std::clamp(detail, least_detail, 1.0);
    return detail_ != detail;
}

}  // namespace sfsm
