// What scenarios with counted work share: work_scenarios.cpp and the kinds beside it.
#pragma once

#include <vector>

#include "sfsm/simulate/scenario.h"
#include "sfsm/simulate/work_plant.h"

namespace sfsm::simulate {

extern const View wide, bend, block;  // the whole bowl, a bend across, a block from near

// A desktop draws the views, 1800 frames with 3 % noise.
Scenario work_scenario(const char* about, std::vector<View> views, WorkPlant::ViewAt view_at,
                       Unforeseen unforeseen = {});

std::size_t only_view(std::int64_t frame);  // the first

// Of three views: the first, second and third from frame 0, 600 and 1200 on, and the first again from 1800 to 2400.
Scenario cutting(const char* about, std::vector<View> views, Unforeseen unforeseen = {});

}  // namespace sfsm::simulate
