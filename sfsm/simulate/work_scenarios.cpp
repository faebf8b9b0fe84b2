#include "sfsm/simulate/work_scenarios.h"

#include <algorithm>
#include <utility>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/episode.h"

namespace sfsm::simulate {
namespace {

// A desktop of today: a thousand million triangles a second, fewer points, baked poses.
constexpr Prices desktop{1.5, {/* person */ 2e-5, /* triangle */ 1e-6, /* point */ 1.4e-6, /* update */ 4e-4}};

constexpr std::int64_t pouring = 30;

}  // namespace

// The whole bowl from the roof: 44 ms in state 0.
const View wide{.people = 30000,
                .range = 300,
                .farness = 4,
                .theta = 0.075,
                .triangles_each = 1000,
                .points_each = 300,
                .surface_px = 0.05};
// A bend from the stand across: 27 ms.
const View bend{.people = 18000,
                .range = 200,
                .farness = 3,
                .theta = 0.075,
                .triangles_each = 1000,
                .points_each = 350,
                .surface_px = 0.1};
// A block from the pitch: fewer people, with more triangles each; 20 ms.
const View block{.people = 9000,
                 .range = 80,
                 .farness = 2,
                 .theta = 0.075,
                 .triangles_each = 1600,
                 .points_each = 550,
                 .surface_px = 0.3};

Scenario work_scenario(const char* about, std::vector<View> views, WorkPlant::ViewAt view_at, Unforeseen unforeseen) {
    Scenario scenario;
    scenario.about = about;
    scenario.plant = std::make_shared<WorkPlant>(desktop, std::move(views), std::move(view_at), std::move(unforeseen));
    scenario.noise = usual_noise;
    scenario.frames = episode_frames;
    scenario.steady = around_episode();
    return scenario;
}

std::size_t only_view(std::int64_t) {
    return 0;
}

Scenario cutting(const char* about, std::vector<View> views, Unforeseen unforeseen) {
    const WorkPlant::ViewAt view_at = [](std::int64_t frame) -> std::size_t {
        if (frame < 600 || frame >= 1800) return 0;
        return frame < 1200 ? 1 : 2;
    };
    Scenario scenario = work_scenario(about, std::move(views), view_at, std::move(unforeseen));
    scenario.frames = 2400;
    scenario.steps = {{{600, 1200}, false}, {{1200, 1800}, true}, {{1800, 2400}, true}};
    scenario.steady = {{200, 600}, {800, 1200}, {1400, 1800}, {2000, 2400}};
    return scenario;
}

Scenario quiet_forecast() {
    constexpr double low_noise = 0.005;
    Scenario scenario = work_scenario("one view, 0.5 % noise, with forecast", {wide}, only_view);
    scenario.noise = low_noise;
    scenario.steady = {{200, 1800}};
    return scenario;
}

Scenario target_step_forecast() {
    Scenario scenario = work_scenario("the target steps, with forecast", {wide}, only_view);
    scenario.target = TargetSchedule::parse("16,10@600,16@1200");
    scenario.steps = there_and_back();
    return scenario;
}

Scenario camera_cut() {
    return cutting("cuts to a block, a bend and the whole bowl, with forecast", {wide, block, bend});
}

// Half a second of people coming, and another of them going.
Scenario crowd_pours_in() {
    View full = bend;
    full.people = 2 * bend.people;
    std::vector<View> views;
    for (std::int64_t i = 0; i <= pouring; ++i) {
        views.push_back(between(bend, full, static_cast<double>(i) / pouring));
    }
    const auto here = [](std::int64_t frame) -> std::size_t {
        const std::int64_t come = std::clamp<std::int64_t>(frame - episode.begin + 1, 0, pouring);
        const std::int64_t gone = std::clamp<std::int64_t>(frame - episode.end + 1, 0, pouring);
        return static_cast<std::size_t>(come - gone);
    };
    Scenario scenario =
        work_scenario("twice the people within half a second, for a third, with forecast", std::move(views), here);
    scenario.steps = there_and_back();
    return scenario;
}

// Prices change, the forecast doesn't: what was learned is wrong from here on.
Scenario throttled() {
    Scenario scenario = work_scenario("for a third, all prices are 1.4 times as high, with forecast", {wide}, only_view,
                                      {.load = [](std::int64_t frame) { return episode.contains(frame) ? 1.4 : 1.0; }});
    scenario.steps = there_and_back();
    return scenario;
}

// What the native demo meets on two cores of a shared machine: now and then somebody else's work comes first.
Scenario heavy_tail() {
    Scenario scenario = work_scenario("one view, 3 % noise; in 6 % of the frames 5 to 20 % of t on top, with forecast",
                                      {wide}, only_view);
    scenario.spike_share = 0.06;
    scenario.spike_low = 0.05;
    scenario.spike_high = 0.2;
    scenario.steady = {{200, 1800}};
    return scenario;
}

}  // namespace sfsm::simulate
