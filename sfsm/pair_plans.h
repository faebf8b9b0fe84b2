// Plans by D and S, for everybody alike.
#pragma once

#include "sfsm/forecast.h"
#include "sfsm/plans.h"

namespace sfsm {

class PairPlans final : public Plans {
public:
    // The forecast must outlive this, and its lists motion and shapes have steps; `range` is L [m].
    PairPlans(const Forecast& forecast, double range) : forecast_(forecast), range_(range) {}

    Plan at(const Decision& decision) const override;
    Decision renewed(const Decision& decision) const override;
    Decision decision_of(const Plan& plan) const override;
    Plan cheapest(const Prices& prices) const override;
    Plan least_loss(const Prices& prices, double budget_ms) const override;
    Plan worthwhile(const Prices& prices, double budget_ms) const override;
    bool is_better(const Plan& plan, const Plan& than, double share) const override;
    Prediction once_drawn(const Prediction& prediction, double noise) const override;
    std::optional<Plan> needed(Lesson lesson, const Plan& now, const Plan& cheapest) const override;
    Plan lesson(Lesson lesson, const Plan& now, int drawn) const override;

private:
    const Forecast& forecast_;
    double range_;
};

}  // namespace sfsm
