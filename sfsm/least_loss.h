// The decision of least loss among those that a forecast says take no more than a given time.
#pragma once

#include "sfsm/decision.h"
#include "sfsm/forecast.h"

namespace sfsm {

// Times [ms] of one piece of each kind of work, >= 0.
struct WorkPrices {
    double frame = 0;  // whatever is drawn, people included
    double triangle = 0;
    double point = 0;
    double motion_update = 0;
};

// A decision, what it draws and what it loses. Counts are fractions where steps have been interpolated.
struct Plan {
    double distance = 0;  // D [m], at most L: everybody moves
    double size = 0;      // S [px]
    double triangles = 0, points = 0, motion_updates = 0;
    double loss_px = 0;
};

// What the forecast says of a distance and a size, each between two of its steps or at an end. `range` is L [m]: beyond
// it there is nobody, so everybody moving, at whatever distance the first step has it, is D = L.
Plan plan_at(const Forecast& forecast, double range, double distance, double size);

// The plan with its motion cut to that share, or to the least there is.
Plan slower_plan(const Forecast& forecast, double range, const Plan& plan, double share);

double plan_ms(const Plan& plan, const WorkPrices& prices);

// The end of both lists.
Plan cheapest_plan(const Forecast& forecast, double range);

// The plan of least summed loss that takes at most `budget_ms`: each motion step with the splat size that fits beside
// it, and each splat step with the distance that fits; the cheapest plan where none fits. Cost: steps times steps.
Plan least_loss_plan(const Forecast& forecast, double range, const WorkPrices& prices, double budget_ms);

}  // namespace sfsm
