// The pairs of D and S that a forecast offers; of those that it says take no more than a given time, that of least
// loss.
#pragma once

#include "sfsm/forecast.h"
#include "sfsm/plan.h"

namespace sfsm {

// What the forecast says of a distance and a size; each lies between two of its steps or at an end. `range` is L [m].
// A step of a D over L counts as D = L: nobody is seen farther away, so everybody moves.
Plan plan_at(const Forecast& forecast, double range, double distance, double size);

// The plan with its motion cut to that share, or to the least there is.
Plan slower_plan(const Forecast& forecast, double range, const Plan& plan, double share);

// The end of both lists.
Plan cheapest_plan(const Forecast& forecast, double range);

// The plan of least summed loss that takes at most `budget_ms`: each step of D with the S that fits beside it, and each
// step of S with the D that fits; of equal losses the cheaper; the cheapest plan where none fits. Cost: steps times
// steps.
Plan least_loss_plan(const Forecast& forecast, double range, const Prices& prices, double budget_ms);

// For a target that nothing meets: the plan whose detail costs the least, of all pairs of steps that take at most
// `budget_ms` and the plan of least loss. Twice the time is worth half the loss where that is most of (1 + loss),
// and a few thousandths of a pixel are worth none. Cost: steps times steps.
Plan worthwhile_plan(const Forecast& forecast, double range, const Prices& prices, double budget_ms);

}  // namespace sfsm
