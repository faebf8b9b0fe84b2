// The one axis that decisions lie on for laws with a single knob: detail, from 1 (nothing is lost) to 0 (the most is
// lost). A law without a forecast turns this knob.
#pragma once

#include "sfsm/decision.h"

namespace sfsm {

inline constexpr double detail_of_points = 2.0 / 3;  // the paper's boundary between states 1 and 2, as D / L
inline constexpr double finest_splat = 0.5;          // [px] at that boundary

// Where nothing but detail is known of frames, each of so many equal steps of it has a price.
inline constexpr int detail_steps = 8;

inline constexpr double first_splat = 4 * finest_splat;  // of frames whose time nobody knows yet

// L where nobody says how far people are visible: D is in hundredths of that.
inline constexpr double unknown_range = 100;

// `detail` in [0, 1], range > 0 [m]:
//   1             state 0
//   from 2/3      state 1, D = detail * L
//   below 2/3     state 2, D = 2/3 L, S growing geometrically from finest_splat to max_splat_size at 0
// Neighbouring details give neighbouring decisions; detail_of() is the way back.
Decision decision_at(double detail, double range);

// The detail that a decision has. For one that is not on this axis: the detail of the nearest one in its state.
// Without a range: of a law that was given none.
double detail_of(const Decision& decision, double range = unknown_range);

}  // namespace sfsm
