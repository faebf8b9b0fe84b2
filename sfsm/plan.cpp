#include "sfsm/plan.h"

#include <algorithm>
#include <cmath>

#include "sfsm/between.h"
#include "sfsm/same_bits.h"
#include "sfsm/usable.h"

namespace sfsm {

double plan_ms(const Plan& plan, const Prices& prices) {
    double ms = prices.frame;
    for (std::size_t i = 0; i < work_kinds; ++i) ms += prices.each[i] * plan.counts[i];
    return ms;
}

double ms_of_detail(const Plan& plan, double ms) {
    return ms * (1 + plan.loss);
}

Decision decision_of(const Plan& plan, double range) {
    Decision decision;
    decision.state = plan.state;
    if (is_usable(plan.rate)) decision.rate = plan.rate;
    if (plan.state == State::original) return decision;
    decision.motion_distance = plan.distance > 0 && plan.distance < range ? plan.distance : range;
    if (plan.state == State::points)
        decision.splat_size = plan.size > 0 ? std::min(plan.size, max_splat_size) : max_splat_size;
    return decision;
}

bool is_cheaper(double ms, double other_ms) {
    constexpr double rounding = 1e-9;
    return ms < other_ms * (1 - rounding);
}

double power_between(double a, double b, double share) {
    return a > 0 && b > 0 ? a * std::pow(b / a, share) : between(a, b, share);
}

}  // namespace sfsm
