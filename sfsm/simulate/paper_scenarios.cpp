#include <cstddef>
#include <utility>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/episode.h"
#include "sfsm/simulate/paper_crowd.h"
#include "sfsm/simulate/work_plant.h"

namespace sfsm::simulate {
namespace {

constexpr double low_noise = 0.005;

// Of the second experiment the paper reports the control rates alone. The people in view are ours, such that without
// control (state 0 throughout) it is the paper's 69.7 % at 95 ms, and so are their distances.
constexpr View close_view{.people = 1450,
                          .range = 200,
                          .farness = 2.5,
                          .theta = 0.1,
                          .triangles_each = 1000,
                          .points_each = 4000,
                          .surface_px = 0.3};
constexpr View medium_view{.people = 1920,
                           .range = 250,
                           .farness = 3,
                           .theta = 0.1,
                           .triangles_each = 1000,
                           .points_each = 2500,
                           .surface_px = 0.1};
constexpr View remote_view{.people = 2470,
                           .range = 300,
                           .farness = 4,
                           .theta = 0.1,
                           .triangles_each = 1000,
                           .points_each = 1555,
                           .surface_px = 0.05};

Scenario experiment(const char* about, WorkPlant plant, const char* target, double noise, std::int64_t frames) {
    Scenario scenario;
    scenario.about = about;
    scenario.plant = std::make_shared<WorkPlant>(std::move(plant));
    scenario.target = TargetSchedule::parse(target);
    scenario.noise = noise;
    scenario.frames = frames;
    scenario.delay = 0;  // equation 3 has T_{i-1} when it seeks D_i
    return scenario;
}

Scenario static_experiment(const char* about, double noise) {
    WorkPlant plant(paper_machine, {static_view}, [](std::int64_t) { return std::size_t{0}; });
    Scenario scenario = experiment(about, std::move(plant), "1000,300@30,95@100", noise, 300);
    scenario.statistics_from = 0;
    scenario.steps = {{{30, 100}, true}, {{100, 300}, true}};
    scenario.steady = {{150, 300}};
    return scenario;
}

// A round of close, medium and remote: 60 frames at each, 40 from one to the next.
std::vector<View> roaming() {
    constexpr int stay = 60, move = 40;
    constexpr View stops[] = {close_view, medium_view, remote_view};
    std::vector<View> views;
    for (int stop = 0; stop < 3; ++stop) {
        for (int i = 0; i < stay; ++i) views.push_back(stops[stop]);
        for (int i = 0; i < move; ++i) {
            views.push_back(between(stops[stop], stops[(stop + 1) % 3], static_cast<double>(i + 1) / (move + 1)));
        }
    }
    return views;
}

Scenario roaming_experiment(const char* about, double noise) {
    std::vector<View> views = roaming();
    const auto round = static_cast<std::int64_t>(views.size());
    WorkPlant plant(paper_machine, std::move(views),
                    [=](std::int64_t frame) { return static_cast<std::size_t>(frame % round); });
    Scenario scenario = experiment(about, std::move(plant), "95", noise, 1200);
    scenario.statistics_from = 10;  // the paper's system has left state 0 when it begins to count
    return scenario;
}

}  // namespace

Scenario paper_1() {
    return static_experiment("the paper's first experiment, 0.5 % noise", low_noise);
}

Scenario paper_1_noisy() {
    return static_experiment("the paper's first experiment, 3 % noise", usual_noise);
}

Scenario paper_2() {
    return roaming_experiment("the paper's second experiment, 0.5 % noise", low_noise);
}

Scenario paper_2_noisy() {
    return roaming_experiment("the paper's second experiment, 3 % noise", usual_noise);
}

}  // namespace sfsm::simulate
