// The decision of least loss among those that a forecast says take no more than a given time.
#pragma once

#include <array>

#include "sfsm/decision.h"
#include "sfsm/forecast.h"
#include "sfsm/prices.h"

namespace sfsm {

// A decision, what it draws and what it loses.
struct Plan {
    double distance = 0;                      // D [m], at most L, where everybody moves
    double size = 0;                          // S [px]; 0: triangles
    std::array<double, work_kinds> counts{};  // of each kind; fractions between two steps
    double loss_px = 0;                       // [px] of motion and shapes together

    constexpr double operator[](WorkKind kind) const { return counts[index_of(kind)]; }
};

// What the forecast says of a distance and a size; each lies between two of its steps or at an end. `range` is L [m].
// A step of a D over L counts as D = L: nobody is seen farther away, so everybody moves.
Plan plan_at(const Forecast& forecast, double range, double distance, double size);

// The plan with its motion cut to that share, or to the least there is.
Plan slower_plan(const Forecast& forecast, double range, const Plan& plan, double share);

double plan_ms(const Plan& plan, const Prices& prices);

// The end of both lists.
Plan cheapest_plan(const Forecast& forecast, double range);

// The plan of least summed loss that takes at most `budget_ms`: each step of D with the S that fits beside it, and each
// step of S with the D that fits; of equal losses the cheaper; the cheapest plan where none fits. Cost: steps times
// steps.
Plan least_loss_plan(const Forecast& forecast, double range, const Prices& prices, double budget_ms);

// What a plan's detail, 1 / (1 + loss_px), costs: the time of a whole one [ms].
double ms_of_detail(const Plan& plan, double ms);

// For a target that nothing meets: the plan whose detail costs the least, of all pairs of steps that take at most
// `budget_ms` and the plan of least loss. Twice the time is worth half the loss where that is most of (1 + loss_px),
// and a few thousandths of a pixel are worth none. Cost: steps times steps.
Plan worthwhile_plan(const Forecast& forecast, double range, const Prices& prices, double budget_ms);

}  // namespace sfsm
