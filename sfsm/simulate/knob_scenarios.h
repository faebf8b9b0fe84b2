// What scenarios of one knob share: knob_scenarios.cpp and the kinds beside it.
#pragma once

#include <utility>
#include <vector>

#include "sfsm/simulate/knob_plant.h"
#include "sfsm/simulate/scenario.h"

namespace sfsm::simulate {

inline constexpr double frame_ms = 1000.0 / 60;  // the nominal time, and the usual target
inline constexpr double usual_noise = 0.03;      // the toy check's

// Most scenarios: a third of the frames is something else, and then it is over.
inline constexpr std::int64_t episode_frames = 1800;
inline constexpr Frames episode{600, 1200};
std::vector<LoadStep> there_and_back();
std::vector<Frames> around_episode();

double constant_load(std::int64_t frame);       // 1
OverFrames raised(Frames frames, double load);  // 1 elsewhere
KnobModel model_of(OverFrames load);
Scenario knob_scenario(const char* about, KnobModel model, double noise, std::int64_t frames);

}  // namespace sfsm::simulate
