// The crowd of the first experiment of Lyu et al. 2018, section 4, and a machine that draws it in the paper's times.
#pragma once

#include "sfsm/simulate/work_plant.h"

namespace sfsm::simulate {

// The paper reports times of its machine and no prices. These give its times for 20,000 people of 1,000 triangles:
//   state 0   980 ms ("1.0 fps"): under the target of 1000 ms by four sigma of 0.5 % noise, so that noise alone
//             does not leave the state, in which the paper stays for 30 frames.
//   state 1   300 ms ("3.3 fps") at D = 0.75 L, so most of the 980 ms are motion. That D is above the paper's
//             boundary of 2/3 L, so nearly everybody is on the far stands (farness 16).
//   state 2   95 ms ("10.5 fps", +-10) between S = 1.5 px (99 ms) and 3 px (82 ms), one and two of the paper's
//             steps tau, with D = L / 6; or at S = 7 px with D = 2/3 L.
// Points go with 1 / S, as between the paper's 21.3 fps at 0.2 px and 65.5 fps at 1 px: of its 7,773 points a person at
// 0.2 px, 1,555 are left at 1 px.
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
