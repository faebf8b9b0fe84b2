#include "sfsm/simulate/course.h"

#include <utility>

namespace sfsm::simulate {
namespace {

FrameSample sample_of(const Plant& plant, std::int64_t frame, const Outcome& outcome) {
    return {frame, outcome.ms, outcome.decision, plant.work(frame, outcome.decision)};
}

}  // namespace

Course make_course(Scenario scenario) {
    Course course{std::move(scenario), {}};
    const Scenario& made = course.scenario;
    const Plant& plant = *made.plant;
    for (std::int64_t frame = 0; frame < made.frames; ++frame) {
        Best best;
        best.decision = plant.optimum(frame, made.oracle_aim * due_ms(made, frame));
        best.cost_ms = plant.cost_ms(frame, best.decision);
        best.detail = plant.detail(frame, best.decision);
        course.best.push_back(best);
    }
    return course;
}

double run(const Course& course, Controller& law, const RunOptions& options, std::vector<Outcome>& outcomes) {
    const Scenario& scenario = course.scenario;
    const Plant& plant = *scenario.plant;
    const auto now = [&] { return options.now_us ? options.now_us() : 0.0; };
    double law_us = 0;
    outcomes.clear();
    for (std::int64_t frame = 0; frame < scenario.frames; ++frame) {
        Outcome outcome;
        outcome.target_ms = scenario.target.at(frame);
        const FrameRequest request{options.target_factor * outcome.target_ms, plant.range(frame),
                                   plant.forecast(frame)};
        const std::int64_t arrived = frame - 1 - scenario.delay;
        const FrameSample sample =
            arrived < 0 ? FrameSample{} : sample_of(plant, arrived, outcomes[static_cast<std::size_t>(arrived)]);
        const double begin_us = now();
        if (arrived >= 0) law.observe(sample);
        outcome.decision = law.decide(request);
        law_us += now() - begin_us;
        outcome.predicted_ms = law.status().predicted_ms;
        outcome.cost_ms = plant.cost_ms(frame, outcome.decision);
        outcome.ms = measured_ms(scenario, options.seed, frame, outcome.cost_ms);
        outcome.detail = plant.detail(frame, outcome.decision);
        outcomes.push_back(outcome);
    }
    return scenario.frames > 0 ? law_us / static_cast<double>(scenario.frames) : 0;
}

}  // namespace sfsm::simulate
