// What a forecast offers, by either of its two ways to decide: pairs of D and S (pair_plans.h) or rates (rate_plans.h).
#pragma once

#include <optional>

#include "sfsm/cost_model.h"
#include "sfsm/plan.h"

namespace sfsm {

// What a frame can be drawn to learn.
enum class Lesson : int { motion, points };
inline constexpr int lessons = 2;

class Plans {
public:
    virtual ~Plans() = default;

    // What a decision comes to; between two steps of the forecast or at an end.
    virtual Plan at(const Decision& decision) const = 0;

    // The same decision for this forecast: one by D and S where those decide, one by rate where that does.
    virtual Decision renewed(const Decision& decision) const = 0;

    virtual Decision decision_of(const Plan& plan) const = 0;

    virtual Plan cheapest(const Prices& prices) const = 0;

    // The plan of least loss that takes at most `budget_ms`; of equal losses the cheaper; the cheapest where none fits.
    virtual Plan least_loss(const Prices& prices, double budget_ms) const = 0;

    // For a target that nothing meets: the plan whose detail costs the least (ms_of_detail), of the steps that take at
    // most `budget_ms` and the plan of least loss.
    virtual Plan worthwhile(const Prices& prices, double budget_ms) const = 0;

    // Whether `plan` saves at least `share` of what can be seen of the other's loss.
    virtual bool is_better(const Plan& plan, const Plan& than, double share) const = 0;

    // The prediction of a plan that is drawn all the time, by one who knows that; `noise` is a frame's.
    virtual Prediction once_drawn(const Prediction& prediction, double noise) const = 0;

    // The plan on the way from `now` to the cheapest whose time must be known before a lesson can be done without;
    // nothing: there is nothing to learn.
    virtual std::optional<Plan> needed(Lesson lesson, const Plan& now, const Plan& cheapest) const = 0;

    // The frame to draw for a lesson that is needed, after `drawn` of them.
    virtual Plan lesson(Lesson lesson, const Plan& now, int drawn) const = 0;
};

}  // namespace sfsm
