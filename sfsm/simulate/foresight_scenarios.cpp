// Work that is counted, but foreseen wrongly, in part or not at all.
#include <cmath>
#include <numbers>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/work_scenarios.h"

namespace sfsm::simulate {
namespace {

View foreseen(View view, const Foresight& foresight) {
    view.foresight = foresight;
    return view;
}

Scenario misled(const char* about, const Foresight& foresight) {
    return cutting(about, {foreseen(wide, foresight), foreseen(block, foresight), foreseen(bend, foresight)});
}

constexpr Foresight all_by(double factor) {
    return {factor, factor, factor, factor};
}

double hundredfold(std::int64_t) {
    return 100;
}

}  // namespace

Scenario forecast_half() {
    return misled("camera-cut with all counts foreseen x 0.5", all_by(0.5));
}

Scenario forecast_double() {
    return misled("camera-cut with all counts foreseen x 2", all_by(2));
}

Scenario forecast_by_kind() {
    return misled("camera-cut with triangles foreseen x 2, points x 0.5, people x 1.5",
                  {.person = 1.5, .triangle = 2, .point = 0.5, .update = 1.5});
}

Scenario forecast_by_view() {
    return cutting("camera-cut with the bowl foreseen x 0.6, the block x 1.6, the bend x 1",
                   {foreseen(wide, all_by(0.6)), foreseen(block, all_by(1.6)), bend});
}

Scenario untold_cut() {
    return cutting("camera-cut with work counted but no forecast", {wide, block, bend}, {.is_silent = true});
}

Scenario hidden_cost() {
    const auto cost_ms = [](std::int64_t frame) {
        constexpr double period = 240, middle = 4, swing = 3;
        return middle - swing * std::cos(2 * std::numbers::pi * static_cast<double>(frame) / period);
    };
    Scenario scenario =
        work_scenario("a cost of no kind of work moves from 1 to 7 ms and back within 240 frames, with forecast",
                      {wide}, only_view, {.unpriced_ms = cost_ms});
    scenario.steady = {};
    return scenario;
}

Scenario correlated_forecast() {
    Scenario scenario =
        work_scenario("one view; 3 % noise that remembers, AR(1) with 0.9, with forecast", {wide}, only_view);
    scenario.correlation = 0.9;
    scenario.steady = {{200, 1800}};
    return scenario;
}

// A software renderer: what is believed of prices at first is far too low.
Scenario slow_machine() {
    Scenario scenario = work_scenario("one view, all prices 100 times as high, target 1667 ms, with forecast", {wide},
                                      only_view, {.load = hundredfold});
    scenario.target = TargetSchedule::parse("1667");
    scenario.steady = {{200, 1800}};
    return scenario;
}

// Even the coarsest drawing is too slow, and what is learned depends on what the first frames met.
Scenario out_of_reach() {
    Scenario scenario = work_scenario("no drawing meets the target: a third of the least; 10 % noise, with forecast",
                                      {wide}, only_view, {.load = hundredfold});
    scenario.target = TargetSchedule::parse("100");
    scenario.noise = 0.1;
    scenario.steady = {{200, 1800}};
    return scenario;
}

// The same without a forecast.
Scenario out_of_reach_untold() {
    Scenario scenario = out_of_reach();
    scenario.about = "out-of-reach without a forecast";
    scenario.plant = work_scenario("", {wide}, only_view, {.load = hundredfold, .is_silent = true}).plant;
    return scenario;
}

}  // namespace sfsm::simulate
