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
Scenario cpu_bound();
Scenario cpu_bound_long();
Scenario unreachable();
Scenario light_load();
Scenario wavy();
Scenario stepped();
Scenario moving_range();
Scenario target_step();
Scenario hitch();
Scenario pause();
Scenario loading();

// Displays and caps: display_scenarios.cpp.
Scenario vsync();
Scenario vsync_jitter();
Scenario vsync_jitter_3pct();
Scenario vsync_target_16();
Scenario vsync_target_16_6();
Scenario vsync_target_17();
Scenario vsync_144();
Scenario variable_refresh();
Scenario frame_cap_2();
Scenario frame_cap_5();
Scenario frame_cap_10();

// Drift, and noise that is not independent: drift_scenarios.cpp.
Scenario swing_100();
Scenario swing_200();
Scenario swing_400();
Scenario correlated();
Scenario bursts();
Scenario heavy_tail_knob();
Scenario fallen_load();
Scenario fallen_load_stepped();

// Work that is known beforehand, at prices that are not: work_scenarios.cpp.
Scenario quiet_forecast();
Scenario target_step_forecast();
Scenario camera_cut();
Scenario crowd_pours_in();
Scenario throttled();
Scenario heavy_tail();

// Work that is foreseen wrongly or in part: foresight_scenarios.cpp.
Scenario hidden_cost();
Scenario correlated_forecast();
Scenario forecast_half();
Scenario forecast_double();
Scenario forecast_by_kind();
Scenario forecast_by_view();
Scenario untold_cut();
Scenario slow_machine();
Scenario out_of_reach();
Scenario out_of_reach_untold();

// The experiments of Lyu et al. 2018, section 4: paper_scenarios.cpp.
Scenario paper_1();
Scenario paper_1_noisy();
Scenario paper_2();
Scenario paper_2_noisy();

}  // namespace sfsm::simulate
