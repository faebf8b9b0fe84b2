// What each kind of work costs, learned from frames that counted theirs; and from it, what a plan will take.
#pragma once

#include <array>
#include <cstdint>

#include "sfsm/cost_model.h"
#include "sfsm/foresight.h"
#include "sfsm/plan.h"
#include "sfsm/prices.h"
#include "sfsm/refresh.h"

namespace sfsm {

class WorkModel {
public:
    explicit WorkModel(Drawing drawing);

    // A frame whose work was counted, with a usable time.
    void observe(const FrameSample& sample, double target_ms);

    // What the plan is said to draw in decision number `frame`, counted from 0: what it then drew tells how far
    // forecasts are off.
    void foresee(std::int64_t frame, const Decision& decision, const Plan& plan);

    // These mean nothing before costs().is_ready().
    Prediction predict(const Plan& plan) const;  // forecasts' error made good
    Prices prices() const;                       // gain included
    Prices price_sigmas() const;                 // 1 sigma of each of them
    Prices foreseen_prices() const;              // of what a forecast says will be drawn: its error included

    // What can be had for a target [ms] (refresh.h).
    double due_ms(double target_ms) const { return refresh_.due_ms(target_ms); }

    const CostModel& costs() const { return costs_; }
    const Foresight& foresight() const { return foresight_; }
    const Refresh& refresh() const { return refresh_; }

private:
    Amounts amounts_of(const Plan& plan) const;
    Amounts amounts_of(const Work& work) const;
    Amounts amounts_from(const std::array<double, work_kinds>& counts) const;

    Drawing drawing_;
    CostModel costs_;          // term 0: what every frame has; then one a kind of work
    double frame_amount_ = 0;  // of term 0; 0 until work has been seen
    Foresight foresight_;
    Refresh refresh_{Refresh::Evidence::but_work};
};

// Times [ms] to plan by while nothing is known: a slow machine's that draws so.
Prices prices_of_a_slow_machine(Drawing drawing);

}  // namespace sfsm
