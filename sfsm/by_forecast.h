// The predictive law where the renderer says what it will draw: the decision of least loss that is predicted to meet
// the aim. It answers a camera cut, a new target or a crowd pouring in within the frame they happen.
#pragma once

#include <cstdint>

#include "sfsm/aim.h"
#include "sfsm/forecast.h"
#include "sfsm/least_loss.h"
#include "sfsm/work_model.h"

namespace sfsm {

class ForecastLaw {
public:
    // The aim must outlive the law.
    ForecastLaw(Aim& aim, Drawing drawing) : aim_(aim), drawing_(drawing), model_(drawing) {}

    // A frame with a usable time; ignored unless its work was counted.
    void observe(const FrameSample& sample);

    // Puts decision number `frame`, counted from 0, into the aim's status; its target and range are usable, and both
    // lists of the forecast have steps.
    void decide(const Forecast& forecast, std::int64_t frame);

private:
    // A frame drawn to learn from: while the target is met and the price of motion or of points is unknown, or while it
    // is out of reach and that of finer detail is.
    struct Probe {
        int motion = 0, points = 0, finer = 0;  // drawn so far
        Decision decision;
        int age = 0;  // decisions since; 0: none is on its way
    };

    void choose(const Forecast& forecast);
    Plan first_guess(const Forecast& forecast) const;
    Plan best_plan(const Forecast& forecast, double least_ms, double budget_ms) const;
    Plan surely_fitting(const Forecast& forecast, const Plan& best, double least_ms, double aim_ms) const;
    void probe(const Forecast& forecast);
    bool is_time_to_probe();
    bool is_doubtful(const Plan& plan) const;
    Decision decision_of(const Plan& plan) const;
    Plan plan_of(const Forecast& forecast, const Decision& decision) const;

    Aim& aim_;
    Drawing drawing_;
    WorkModel model_;
    Decision kept_;         // what is drawn between probes
    int since_choice_ = 0;  // decisions since kept_ changed
    Probe probe_;
};

}  // namespace sfsm
