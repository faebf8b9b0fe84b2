// The crowd of the first experiment of Lyu et al. 2018, section 4, and a machine that draws it in the paper's times.
#pragma once

#include "sfsm/simulate/work_plant.h"

namespace sfsm::simulate {

// Calibrated to the times the paper reports of its machine for 20,000 people of 1,000 triangles; it has no prices.
// - State 0 "1.0 fps" with a target of 1000 ms: 980 ms, four sigma of 0.5 % noise under the target, or that alone
//   would leave the state that the paper stays in for 30 frames.
// - State 1 reaches 300 ms ("3.3 fps"), so motion must be most of the 980: at D = 0.75 L, above the paper's boundary
//   of 2/3 L, with nearly everybody on the far stands (farness 16).
// - State 2 reaches 95 ms "(+-10)" ("10.5 fps"): with D at L / 6 between S = 1.5 px and 3 px, one and two steps of its
//   tau, which take 99 ms and 82 ms; with D at 2/3 L at S = 7 px.
// - Time goes with 1 / S, as between its 21.3 fps at 0.2 px and 65.5 fps at 1 px; 7,773 points a person at 0.2 px are
//   1,555 at 1 px.
inline constexpr Prices paper_machine{
    31.5, {/* person */ 0.001, /* triangle */ 9.765e-6, /* point */ 1.576e-6, /* update */ 0.03665}};
inline constexpr View static_view{.people = 20000,
                                  .range = 600,
                                  .farness = 16,
                                  .theta = 0.1,
                                  .triangles_each = 1000,
                                  .points_each = 1555,
                                  .surface_px = 0.05};

}  // namespace sfsm::simulate
