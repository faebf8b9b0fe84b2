#include "sfsm/pair_plans.h"

#include <algorithm>

#include "sfsm/least_loss.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double lesson_share = 0.5;  // of the motion that a frame has which teaches what motion costs
constexpr double coarser_lesson = 4;  // times the finest splat

// [px] The largest that loses no more than the finest; 0 where there is none.
double finest_splat_of_use(const Forecast& forecast) {
    const auto& shapes = forecast.shapes;
    if (shapes.size() < 2) return 0;
    std::size_t step = 1;
    while (step + 1 < shapes.size() && shapes[step + 1].loss_px <= shapes[1].loss_px) ++step;
    return shapes[step].setting;
}

}  // namespace

Plan PairPlans::at(const Decision& decision) const {
    const bool is_all_moving = decision.state == State::original;
    const double distance = is_all_moving ? range_ : std::min(decision.motion_distance, range_);
    return plan_at(forecast_, range_, distance, decision.splat_size);
}

Decision PairPlans::renewed(const Decision& decision) const {
    Decision same = decision;
    same.rate = 0;
    return same;
}

Decision PairPlans::decision_of(const Plan& plan) const {
    return sfsm::decision_of(plan, range_);
}

Plan PairPlans::cheapest(const Prices&) const {
    return cheapest_plan(forecast_, range_);
}

Plan PairPlans::least_loss(const Prices& prices, double budget_ms) const {
    return least_loss_plan(forecast_, range_, prices, budget_ms);
}

Plan PairPlans::worthwhile(const Prices& prices, double budget_ms) const {
    return worthwhile_plan(forecast_, range_, prices, budget_ms);
}

bool PairPlans::is_better(const Plan& plan, const Plan& than, double share) const {
    return plan.loss < than.loss * (1 - share);
}

Prediction PairPlans::once_drawn(const Prediction& prediction, double) const {
    return prediction;
}

std::optional<Plan> PairPlans::needed(Lesson lesson, const Plan& now, const Plan& cheapest) const {
    if (lesson == Lesson::motion) return plan_at(forecast_, range_, cheapest.distance, now.size);
    if (now.size != 0) return {};
    return plan_at(forecast_, range_, now.distance, cheapest.size);
}

// Half the motion; or the finest points, then coarser ones: two sizes tell points from what every frame has.
Plan PairPlans::lesson(Lesson lesson, const Plan& now, int drawn) const {
    if (lesson == Lesson::motion) return slower_plan(forecast_, range_, now, lesson_share);
    const double finest = finest_splat_of_use(forecast_);
    return plan_at(forecast_, range_, now.distance, drawn == 0 ? finest : coarser_lesson * finest);
}

}  // namespace sfsm
