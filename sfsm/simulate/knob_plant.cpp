#include "sfsm/simulate/knob_plant.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sfsm/detail.h"

namespace sfsm::simulate {
namespace {

constexpr std::size_t curve_steps = 1024;
constexpr int bisections = 40;  // to less than a billionth of a step

double knob_at(std::size_t step) {
    return least_knob + (1 - least_knob) * static_cast<double>(step) / curve_steps;
}

}  // namespace

double toy_curve(double u) {
    return 0.3 + 1.2 * u;
}

double wavy_curve(double u) {
    constexpr double waves = 3, height = 0.12;  // slopes from -1.1 to 3.5 about the toy's 1.2
    return toy_curve(u) + height * std::sin(2 * std::numbers::pi * waves * u);
}

double stepped_curve(double u) {
    constexpr double levels = 8;
    return toy_curve(std::floor(u * levels) / levels);
}

KnobPlant::KnobPlant(KnobModel model) : model_(std::move(model)) {
    for (std::size_t i = 0; i <= curve_steps; ++i) curve_.push_back(model_.curve(knob_at(i)));
    least_ = *std::min_element(curve_.begin(), curve_.end());
}

double KnobPlant::range(std::int64_t frame) const {
    constexpr double usual_range = 200;
    return model_.range_m ? model_.range_m(frame) : usual_range;
}

double KnobPlant::detail(std::int64_t frame, const Decision& decision) const {
    return std::max(least_knob, detail_of(decision, range(frame)));
}

double KnobPlant::cost_ms(std::int64_t frame, const Decision& decision) const {
    const double gpu_ms = model_.load(frame) * model_.curve(detail(frame, decision)) * model_.nominal_ms;
    return model_.cpu_ms ? std::max(gpu_ms, model_.cpu_ms(frame)) : gpu_ms;
}

// The largest u with curve(u) <= limit >= least_: from the top down to the first step that holds, then between.
double KnobPlant::finest_knob(double limit) const {
    const auto found = std::find_if(curve_.rbegin(), curve_.rend(), [=](double share) { return share <= limit; });
    const auto step = static_cast<std::size_t>(curve_.rend() - found) - 1;
    if (step == curve_steps) return 1;
    double low = knob_at(step), high = knob_at(step + 1);
    for (int i = 0; i < bisections; ++i) {
        const double middle = (low + high) / 2;
        (model_.curve(middle) <= limit ? low : high) = middle;
    }
    return low;
}

Decision KnobPlant::optimum(std::int64_t frame, double limit_ms) const {
    const double full_ms = model_.load(frame) * model_.nominal_ms;
    const double least_ms = std::max(least_ * full_ms, model_.cpu_ms ? model_.cpu_ms(frame) : 0.0);
    const double limit = std::max(least_, std::max(limit_ms, least_ms) / full_ms);
    return decision_at(finest_knob(limit), range(frame));
}

}  // namespace sfsm::simulate
