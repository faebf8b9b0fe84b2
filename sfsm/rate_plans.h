// Plans by the one rate at which error is exchanged for work: the steps of Forecast::rates, and the places between two.
//
// A kind that ends between two steps is taken to be nearly gone half way. Were it foreseen to the end in a straight
// line, a place there would be foreseen to draw what it no longer draws: the price of that would never be learned, nor
// what such a place takes.
#pragma once

#include "sfsm/forecast.h"
#include "sfsm/plans.h"

namespace sfsm {

class RatePlans final : public Plans {
public:
    // The forecast must outlive this, and all of its lists have steps; `range` is L [m].
    RatePlans(const Forecast& forecast, double range) : forecast_(forecast), range_(range) {}

    // A decision by D and S comes to the first place that loses as many pixels as it does.
    Plan at(const Decision& decision) const override;

    // D and S become what the rate comes to now.
    Decision renewed(const Decision& decision) const override;

    Decision decision_of(const Plan& plan) const override;

    // By learned prices the last step need not be the cheapest.
    Plan cheapest(const Prices& prices) const override;

    // The finest that fits, within a thousandth of the budget: time need not fall along the list.
    Plan least_loss(const Prices& prices, double budget_ms) const override;

    Plan worthwhile(const Prices& prices, double budget_ms) const override;
    bool is_better(const Plan& plan, const Plan& than, double share) const override;
    Prediction once_drawn(const Prediction& prediction, double noise) const override;
    std::optional<Plan> needed(Lesson lesson, const Plan& now, const Plan& cheapest) const override;
    Plan lesson(Lesson lesson, const Plan& now, int drawn) const override;

private:
    // Between the steps `at - 1` and `at`; share in [0, 1], 1 is the latter.
    struct Place {
        std::size_t at = 0;
        double share = 1;
    };

    Plan plan_of(const Place& place) const;
    std::array<double, work_kinds> counts_at(const Place& place) const;
    double loss_at(const Place& place) const;
    bool is_leap(std::size_t at) const;
    double lost_px(std::size_t step) const;
    double step_ms(std::size_t step, const Prices& prices) const;
    Place place_at_rate(double rate) const;
    Place place_at_px(double px) const;
    Place cheapest_place(const Prices& prices) const;
    Place fitting_place(const Prices& prices, double budget_ms) const;
    Place filling_place(std::size_t at, double before_ms, double ms, const Prices& prices, double budget_ms) const;
    Place cheapest_alike(Place place, const Prices& prices) const;
    std::size_t step_of_most_points(double rate) const;

    const Forecast& forecast_;
    double range_;
};

}  // namespace sfsm
