// The scenarios there are, each made by a function of its name; scenario.h finds them by name.
#pragma once

#include "sfsm/simulate/scenario.h"

namespace sfsm::simulate {

// One knob and no forecast: knob_scenarios.cpp.
Scenario toy();
Scenario delay_0();
Scenario delay_4();
Scenario spikes();
Scenario quiet();
Scenario quiet_noisy();
Scenario vsync();
Scenario cpu_bound();
Scenario unreachable();
Scenario light_load();
Scenario wavy();
Scenario stepped();
Scenario moving_range();
Scenario target_step();
Scenario hitch();
Scenario pause();
Scenario loading();

// Work that is known beforehand, at prices that are not: work_scenarios.cpp.
Scenario quiet_forecast();
Scenario target_step_forecast();
Scenario camera_cut();
Scenario crowd_pours_in();
Scenario throttled();
Scenario heavy_tail();

// The experiments of Lyu et al. 2018, section 4: paper_scenarios.cpp.
Scenario paper_1();
Scenario paper_1_noisy();
Scenario paper_2();
Scenario paper_2_noisy();

}  // namespace sfsm::simulate
