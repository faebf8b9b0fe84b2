// What scenarios of one knob share: knob_scenarios.cpp and the kinds beside it.
#pragma once

#include "sfsm/simulate/episode.h"
#include "sfsm/simulate/knob_plant.h"
#include "sfsm/simulate/scenario.h"

namespace sfsm::simulate {

inline constexpr double frame_ms = 1000.0 / 60;  // the nominal time, and the usual target

double constant_load(std::int64_t frame);       // 1
OverFrames raised(Frames frames, double load);  // 1 elsewhere
KnobModel model_of(OverFrames load);
Scenario knob_scenario(const char* about, KnobModel model, double noise, std::int64_t frames);

}  // namespace sfsm::simulate
