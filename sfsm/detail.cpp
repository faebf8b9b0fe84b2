#include "sfsm/detail.h"

#include <algorithm>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

// Not known to the compiler: Clang would make exp2(6 x) of pow(64, x), which rounds otherwise.
const volatile double coarsest_over_finest = max_splat_size / finest_splat;

}  // namespace

Decision decision_at(double detail, double range) {
    Decision decision;
    if (detail >= 1) return decision;
    if (detail >= detail_of_points) {
        decision.state = State::slowed;
        decision.motion_distance = detail * range;
        return decision;
    }
    decision.state = State::points;
    decision.motion_distance = detail_of_points * range;
    const double coarseness = 1 - std::max(detail, 0.0) / detail_of_points;
    decision.splat_size = finest_splat * std::pow(coarsest_over_finest, coarseness);
    return decision;
}

double detail_of(const Decision& decision, double range) {
    switch (decision.state) {
        case State::original:
            return 1;
        case State::slowed:
            // Just below 1: 1 itself is state 0.
            return std::clamp(decision.motion_distance / range, detail_of_points, std::nextafter(1.0, 0.0));
        case State::points:
            break;
    }
    const double size = std::clamp(decision.splat_size, finest_splat, max_splat_size);
    const double coarseness = std::log(size / finest_splat) / std::log(max_splat_size / finest_splat);
    return std::min(detail_of_points * (1 - coarseness), std::nextafter(detail_of_points, 0.0));
}

}  // namespace sfsm
