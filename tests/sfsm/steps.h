// Steps of a forecast, number by number.
#pragma once

#include "sfsm/forecast.h"

namespace sfsm {

inline Step motion_step(double distance, std::int64_t updates, double loss_px) {
    Step step{distance, {}, loss_px};
    step.work[WorkKind::motion_update] = updates;
    return step;
}

inline Step shape_step(double size, std::int64_t triangles, std::int64_t points, double loss_px) {
    Step step{size, {}, loss_px};
    step.work[WorkKind::triangle] = triangles;
    step.work[WorkKind::point] = points;
    return step;
}

inline RateStep rate_step(double rate, std::int64_t points, std::int64_t updates, double loss) {
    RateStep step{rate, State::points, 100, 1, {}, loss};
    step.work[WorkKind::point] = points;
    step.work[WorkKind::motion_update] = updates;
    return step;
}

}  // namespace sfsm
