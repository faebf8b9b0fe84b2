#include "sfsm/least_loss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sfsm/between.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

// What a step's work on its own axis takes.
template <WorkAxis axis>
double step_ms(const Step& step, const Prices& prices) {
    double ms = 0;
    for (const WorkKind kind : work_on<axis>) ms += prices[kind] * counted(step.work[kind]);
    return ms;
}

// What each step of a list takes; the first of them are calculated only once.
template <WorkAxis axis>
class StepTimes {
public:
    StepTimes(std::span<const Step> steps, const Prices& prices) : steps_(steps), prices_(prices) {
        for (std::size_t i = 0; i < std::min(steps.size(), kept_.size()); ++i)
            kept_[i] = step_ms<axis>(steps[i], prices);
    }
    double operator[](std::size_t i) const { return i < kept_.size() ? kept_[i] : step_ms<axis>(steps_[i], prices_); }

private:
    std::span<const Step> steps_;
    const Prices& prices_;
    std::array<double, 64> kept_;  // none where there is no step
};

double distance_of(const Step& step, double range) {
    return std::min(range, step.setting);
}

// Between the steps `at - 1` and `at`; share in [0, 1], 1 is the latter.
struct Place {
    std::size_t at = 0;
    double share = 1;
};

void take_motion(Plan& plan, const Forecast& forecast, double range, const Place& place) {
    const Step& b = forecast.motion[place.at];
    const Step& a = place.share < 1 ? forecast.motion[place.at - 1] : b;
    plan.distance = between(distance_of(a, range), distance_of(b, range), place.share);
    for (const WorkKind kind : work_on<WorkAxis::motion>)
        plan.counts[index_of(kind)] = between(counted(a.work[kind]), counted(b.work[kind]), place.share);
    plan.loss += between(a.loss_px, b.loss_px, place.share);
}

void take_shapes(Plan& plan, const Forecast& forecast, const Place& place) {
    const Step& b = forecast.shapes[place.at];
    const Step& a = place.share < 1 ? forecast.shapes[place.at - 1] : b;
    plan.size = power_between(a.setting, b.setting, place.share);
    for (const WorkKind kind : work_on<WorkAxis::shape>)
        plan.counts[index_of(kind)] = power_between(counted(a.work[kind]), counted(b.work[kind]), place.share);
    plan.loss += between(a.loss_px, b.loss_px, place.share);
}

State state_of(const Plan& plan, double range) {
    if (plan.size > 0) return State::points;
    return plan.distance > 0 && plan.distance < range ? State::slowed : State::original;
}

Plan plan_of(const Forecast& forecast, double range, const Place& motion, const Place& shapes) {
    Plan plan;
    for (const WorkKind kind : work_on<WorkAxis::frame>) plan.counts[index_of(kind)] = counted(forecast.frame[kind]);
    take_motion(plan, forecast, range, motion);
    take_shapes(plan, forecast, shapes);
    plan.state = state_of(plan, range);
    return plan;
}

// The first place of a falling list of costs that takes at most `rest`; past the end where none does. Between steps
// only where `is_joined` says that there is a between.
template <class Times, class Joined>
Place fitting_place(std::span<const Step> steps, double rest, const Times& times, const Joined& is_joined) {
    double before = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double ms = times[i];
        if (ms <= rest) {
            if (i == 0 || !is_joined(steps[i - 1]) || !(before > ms)) return {i, 1};
            return {i, std::clamp((before - rest) / (before - ms), 0.0, 1.0)};
        }
        before = ms;
    }
    return {steps.size(), 1};
}

double loss_at(std::span<const Step> steps, const Place& place) {
    const double b = steps[place.at].loss_px;
    return place.share < 1 ? between(steps[place.at - 1].loss_px, b, place.share) : b;
}

// The cheapest place from there on that loses as little: a renderer may gain nothing from its finest steps.
template <class Times>
Place cheapest_alike(std::span<const Step> steps, Place place, const Times& times) {
    if (place.at >= steps.size()) return place;
    const double loss = loss_at(steps, place);
    double least_ms = times[place.at];
    if (place.share < 1) least_ms = between(times[place.at - 1], least_ms, place.share);
    for (std::size_t i = place.at; i < steps.size() && steps[i].loss_px <= loss; ++i) {
        const double ms = times[i];
        if (!is_cheaper(ms, least_ms)) continue;
        place = {i, 1};
        least_ms = ms;
    }
    return place;
}

}  // namespace

Plan plan_at(const Forecast& forecast, double range, double distance, double size) {
    const auto& motion = forecast.motion;
    const auto& shapes = forecast.shapes;
    std::size_t m = 0, s = 0;
    while (m + 1 < motion.size() && distance_of(motion[m], range) > distance) ++m;
    while (s + 1 < shapes.size() && shapes[s].setting < size) ++s;
    Place motion_place{m, 1}, shape_place{s, 1};
    if (m > 0 && distance_of(motion[m], range) < distance) {
        const double before = distance_of(motion[m - 1], range);
        motion_place.share = (before - distance) / (before - distance_of(motion[m], range));
    }
    if (s > 0 && shapes[s].setting > size && shapes[s - 1].setting > 0) {
        const double before = shapes[s - 1].setting;
        shape_place.share = std::log(size / before) / std::log(shapes[s].setting / before);
    }
    return plan_of(forecast, range, motion_place, shape_place);
}

Plan slower_plan(const Forecast& forecast, double range, const Plan& plan, double share) {
    const auto is_slow_enough = [&](const Step& step) {
        return std::ranges::all_of(work_on<WorkAxis::motion>,
                                   [&](WorkKind kind) { return counted(step.work[kind]) <= share * plan[kind]; });
    };
    const auto found = std::ranges::find_if(forecast.motion, is_slow_enough);
    const Step& step = found == forecast.motion.end() ? forecast.motion.back() : *found;
    return plan_at(forecast, range, distance_of(step, range), plan.size);
}

Plan cheapest_plan(const Forecast& forecast, double range) {
    return plan_of(forecast, range, {forecast.motion.size() - 1, 1}, {forecast.shapes.size() - 1, 1});
}

Plan least_loss_plan(const Forecast& forecast, double range, const Prices& prices, double budget_ms) {
    const StepTimes<WorkAxis::motion> motion_ms(forecast.motion, prices);
    const StepTimes<WorkAxis::shape> shape_ms(forecast.shapes, prices);
    const auto ms_of = [&](const Place& motion, const Place& shapes) {
        return plan_ms(plan_of(forecast, range, motion, shapes), prices);
    };
    const auto has_distance = [&](const Step& step) { return std::isfinite(distance_of(step, range)); };
    const auto has_size = [](const Step& step) { return step.setting > 0; };
    Place best_motion{forecast.motion.size() - 1, 1}, best_shapes{forecast.shapes.size() - 1, 1};
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Place& motion, const Place& shapes) {
        if (motion.at >= forecast.motion.size() || shapes.at >= forecast.shapes.size()) return;
        const double loss = loss_at(forecast.motion, motion) + loss_at(forecast.shapes, shapes);
        if (loss > least) return;
        if (loss == least && !is_cheaper(ms_of(motion, shapes), ms_of(best_motion, best_shapes))) return;
        least = loss;
        best_motion = motion;
        best_shapes = shapes;
    };
    const double rest = budget_ms - cost_of(only_on<WorkAxis::frame>(forecast.frame), prices);
    for (std::size_t m = 0; m < forecast.motion.size(); ++m) {
        const double left = rest - motion_ms[m];
        const Place fitting = fitting_place(forecast.shapes, left, shape_ms, has_size);
        consider({m, 1}, cheapest_alike(forecast.shapes, fitting, shape_ms));
    }
    for (std::size_t s = 0; s < forecast.shapes.size(); ++s) {
        const double left = rest - shape_ms[s];
        const Place fitting = fitting_place(forecast.motion, left, motion_ms, has_distance);
        consider(cheapest_alike(forecast.motion, fitting, motion_ms), {s, 1});
    }
    return plan_of(forecast, range, best_motion, best_shapes);
}

Plan worthwhile_plan(const Forecast& forecast, double range, const Prices& prices, double budget_ms) {
    Plan best = least_loss_plan(forecast, range, prices, budget_ms);
    double least = ms_of_detail(best, plan_ms(best, prices));
    const double every_ms = prices.frame + cost_of(only_on<WorkAxis::frame>(forecast.frame), {0, prices.each});
    const StepTimes<WorkAxis::motion> motion_ms(forecast.motion, prices);
    const StepTimes<WorkAxis::shape> shape_ms(forecast.shapes, prices);
    for (std::size_t m = 0; m < forecast.motion.size(); ++m) {
        const double before_ms = every_ms + motion_ms[m];
        for (std::size_t s = 0; s < forecast.shapes.size(); ++s) {
            const double ms = before_ms + shape_ms[s];
            if (ms > budget_ms) continue;
            const double loss = forecast.motion[m].loss_px + forecast.shapes[s].loss_px;
            if (!is_cheaper(ms * (1 + loss), least)) continue;
            best = plan_of(forecast, range, {m, 1}, {s, 1});
            least = ms_of_detail(best, ms);
        }
    }
    return best;
}

}  // namespace sfsm
