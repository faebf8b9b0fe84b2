// The one axis that all decisions lie on: detail from 1, nothing lost, to 0, the most that can be lost. Laws that know
// a single knob turn this one; so do all of them where no forecast says what the others would cost.
#pragma once

#include "sfsm/decision.h"

namespace sfsm {

inline constexpr double detail_of_points = 2.0 / 3;  // the paper's boundary between states 1 and 2, as D / L
inline constexpr double finest_splat = 0.5;          // [px] at that boundary

// State 0 at 1; state 1 with D = detail * L down to 2/3; below, state 2 with D = 2/3 L and S growing geometrically from
// finest_splat to max_splat_size at 0. `detail` in [0, 1], range > 0 [m]. Neighbouring details give neighbouring
// decisions, and detail_of gets any of them back.
Decision decision_at(double detail, double range);

// The detail of a decision of this axis; of another, that of the nearest one of its state.
double detail_of(const Decision& decision, double range);

}  // namespace sfsm
