// The predictive law where the renderer says what it will draw: the decision of least loss that is predicted to meet
// the aim. It answers a camera cut, a new target or a crowd pouring in within the frame they happen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sfsm/aim.h"
#include "sfsm/forecast.h"
#include "sfsm/plans.h"
#include "sfsm/retest.h"
#include "sfsm/work_model.h"

namespace sfsm {

class ForecastLaw {
public:
    // The aim must outlive the law.
    ForecastLaw(Aim& aim, Drawing drawing) : aim_(aim), drawing_(drawing), model_(drawing) {}

    // A frame with a usable time; ignored unless its work was counted.
    void observe(const FrameSample& sample);

    // Puts decision number `frame`, counted from 0, into the aim's status; its target and range are usable, and the
    // forecast's lists motion and shapes have steps. By rate where it has rates, else by D and S.
    void decide(const Forecast& forecast, std::int64_t frame);

private:
    // A frame drawn to learn from: while the target is met and the price of motion, of points or of finer detail is
    // unknown, or while it is out of reach and that of finer detail is.
    struct Probe {
        std::array<int, lessons> of{};  // of each lesson, drawn so far
        int finer = 0;
        int wanted_wait = 16;  // [decisions] without change before wanted_ is drawn
        Decision decision;
        int age = 0;  // decisions since; 0: none is on its way
    };

    void decide_among(const Plans& plans, std::int64_t frame);
    void choose(const Plans& plans);
    Plan first_guess(const Plans& plans) const;
    Plan best_plan(const Plans& plans, double least_ms, double budget_ms) const;
    Plan surely_fitting(const Plans& plans, const Plan& best, double least_ms, double aim_ms) const;
    void probe(const Plans& plans);
    void draw_probe(const Plans& plans, const Plan& plan);
    bool is_time_to_probe();
    std::optional<Plan> next_probe(const Plans& plans, const Plan& now);
    std::optional<Plan> probe_out_of_reach(const Plans& plans, const Plan& now, const Plan& cheapest, double least_ms);
    std::optional<Plan> wanted_probe();
    std::optional<Plan> finer_probe(const Plans& plans, const Plan& now, double least_ms);
    bool is_least_unknown(const Plan& cheapest);
    bool is_doubtful(const Plan& plan) const;
    void tell() const;

    Aim& aim_;
    Drawing drawing_;
    WorkModel model_;
    Decision kept_;               // what is drawn between probes
    std::optional<Plan> wanted_;  // a better decision that is known too little to be chosen
    int since_choice_ = 0;        // decisions since kept_ changed
    Probe probe_;
    Retest cap_retest_{longest_cap_wait};
};

}  // namespace sfsm
