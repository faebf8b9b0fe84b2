#include "sfsm/least_loss.h"

#include <algorithm>
#include <cmath>

namespace sfsm {
namespace {

double count(std::int64_t n) {
    return static_cast<double>(std::max<std::int64_t>(n, 0));
}

double motion_ms(const MotionStep& step, const WorkPrices& prices) {
    return prices.motion_update * count(step.updates);
}

double splat_ms(const SplatStep& step, const WorkPrices& prices) {
    return prices.triangle * count(step.triangles) + prices.point * count(step.points);
}

// Straight in logarithms, or straight where there are none.
double power_between(double a, double b, double share) {
    return a > 0 && b > 0 ? a * std::pow(b / a, share) : std::lerp(a, b, share);
}

double distance_of(const MotionStep& step, double range) {
    return std::min(range, step.distance);
}

// Between the steps `at - 1` and `at`; share in [0, 1], 1 is the latter.
struct Place {
    std::size_t at = 0;
    double share = 1;
};

void take_motion(Plan& plan, const Forecast& forecast, double range, const Place& place) {
    const MotionStep& b = forecast.motion[place.at];
    const MotionStep& a = place.share < 1 ? forecast.motion[place.at - 1] : b;
    plan.distance = std::lerp(distance_of(a, range), distance_of(b, range), place.share);
    plan.motion_updates = std::lerp(count(a.updates), count(b.updates), place.share);
    plan.loss_px += std::lerp(a.loss_px, b.loss_px, place.share);
}

void take_splats(Plan& plan, const Forecast& forecast, const Place& place) {
    const SplatStep& b = forecast.splats[place.at];
    const SplatStep& a = place.share < 1 ? forecast.splats[place.at - 1] : b;
    plan.size = power_between(a.size, b.size, place.share);
    plan.triangles = power_between(count(a.triangles), count(b.triangles), place.share);
    plan.points = power_between(count(a.points), count(b.points), place.share);
    plan.loss_px += std::lerp(a.loss_px, b.loss_px, place.share);
}

Plan plan_of(const Forecast& forecast, double range, const Place& motion, const Place& splats) {
    Plan plan;
    take_motion(plan, forecast, range, motion);
    take_splats(plan, forecast, splats);
    return plan;
}

// The first place of a falling list of costs that takes at most `rest`; past the end where none does. Between steps
// only where `is_joined` says that there is a between.
template <class Step, class Cost, class Joined>
Place fitting_place(std::span<const Step> steps, double rest, const Cost& cost, const Joined& is_joined) {
    double before = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double ms = cost(steps[i]);
        if (ms <= rest) {
            if (i == 0 || !is_joined(steps[i - 1]) || !(before > ms)) return {i, 1};
            return {i, std::clamp((before - rest) / (before - ms), 0.0, 1.0)};
        }
        before = ms;
    }
    return {steps.size(), 1};
}

template <class Step>
double loss_at(std::span<const Step> steps, const Place& place) {
    const double b = steps[place.at].loss_px;
    return place.share < 1 ? std::lerp(steps[place.at - 1].loss_px, b, place.share) : b;
}

}  // namespace

Plan plan_at(const Forecast& forecast, double range, double distance, double size) {
    const auto& motion = forecast.motion;
    const auto& splats = forecast.splats;
    std::size_t m = 0, s = 0;
    while (m + 1 < motion.size() && distance_of(motion[m], range) > distance) ++m;
    while (s + 1 < splats.size() && splats[s].size < size) ++s;
    Place motion_place{m, 1}, splat_place{s, 1};
    if (m > 0 && distance_of(motion[m], range) < distance) {
        const double before = distance_of(motion[m - 1], range);
        motion_place.share = (before - distance) / (before - distance_of(motion[m], range));
    }
    if (s > 0 && splats[s].size > size && splats[s - 1].size > 0) {
        splat_place.share = std::log(size / splats[s - 1].size) / std::log(splats[s].size / splats[s - 1].size);
    }
    return plan_of(forecast, range, motion_place, splat_place);
}

Plan slower_plan(const Forecast& forecast, double range, const Plan& plan, double share) {
    for (const MotionStep& step : forecast.motion) {
        if (count(step.updates) <= share * plan.motion_updates)
            return plan_at(forecast, range, distance_of(step, range), plan.size);
    }
    return plan_at(forecast, range, distance_of(forecast.motion.back(), range), plan.size);
}

double plan_ms(const Plan& plan, const WorkPrices& prices) {
    return prices.frame + prices.triangle * plan.triangles + prices.point * plan.points +
           prices.motion_update * plan.motion_updates;
}

Plan cheapest_plan(const Forecast& forecast, double range) {
    return plan_of(forecast, range, {forecast.motion.size() - 1, 1}, {forecast.splats.size() - 1, 1});
}

Plan least_loss_plan(const Forecast& forecast, double range, const WorkPrices& prices, double budget_ms) {
    const auto motion_cost = [&](const MotionStep& step) { return motion_ms(step, prices); };
    const auto splat_cost = [&](const SplatStep& step) { return splat_ms(step, prices); };
    const auto has_distance = [&](const MotionStep& step) { return std::isfinite(distance_of(step, range)); };
    const auto has_size = [](const SplatStep& step) { return step.size > 0; };
    Place best_motion{forecast.motion.size() - 1, 1}, best_splats{forecast.splats.size() - 1, 1};
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Place& motion, const Place& splats) {
        if (motion.at >= forecast.motion.size() || splats.at >= forecast.splats.size()) return;
        const double loss = loss_at(forecast.motion, motion) + loss_at(forecast.splats, splats);
        if (!(loss < least)) return;
        least = loss;
        best_motion = motion;
        best_splats = splats;
    };
    const double rest = budget_ms - prices.frame;
    for (std::size_t m = 0; m < forecast.motion.size(); ++m)
        consider({m, 1}, fitting_place(forecast.splats, rest - motion_cost(forecast.motion[m]), splat_cost, has_size));
    for (std::size_t s = 0; s < forecast.splats.size(); ++s)
        consider(fitting_place(forecast.motion, rest - splat_cost(forecast.splats[s]), motion_cost, has_distance),
                 {s, 1});
    return plan_of(forecast, range, best_motion, best_splats);
}

}  // namespace sfsm
