#include "apps/rerun.h"

#include <limits>
#include <memory>

#include "sfsm/replay.h"

namespace apps {

namespace sim = sfsm::simulate;

std::unique_ptr<sfsm::Controller> make_law(const sim::Contestant& law, sfsm::Drawing drawing) {
    sim::Course nowhere;
    nowhere.scenario.drawing = drawing;
    return law.make(nowhere);
}

Rerun rerun_open(const sim::Contestant& law, const std::vector<sfsm::TraceRow>& recorded, int delay,
                 sfsm::Drawing drawing) {
    const std::unique_ptr<sfsm::Controller> controller = make_law(law, drawing);
    const std::vector<sfsm::Replayed> replayed = sfsm::replay(*controller, recorded, delay);
    Rerun rerun{law.name, {}, {}};
    rerun.rows.reserve(recorded.size());
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        sfsm::TraceRow& row = rerun.rows.emplace_back();
        row.frame = recorded[i].frame;
        row.target_ms = recorded[i].target_ms;
        row.frame_ms = recorded[i].frame_ms;
        row.cpu_ms = recorded[i].cpu_ms;
        row.gpu_ms = recorded[i].gpu_ms;
        row.range = recorded[i].range;
        row.work = recorded[i].work;
        row.decision = replayed[i].decision;
        row.predicted_ms = replayed[i].predicted_ms;
    }
    return rerun;
}

Rerun rerun_closed(const sim::Contestant& law, const sim::Course& course) {
    std::vector<sim::Outcome> outcomes;
    sim::run(course, *law.make(course), {}, outcomes);
    Rerun rerun{law.name, {}, sim::measure(course, outcomes)};
    rerun.rows.reserve(outcomes.size());
    for (const sim::Outcome& outcome : outcomes)
        rerun.rows.push_back(trace_row(*course.scenario.plant, std::ssize(rerun.rows), outcome));
    return rerun;
}

sfsm::TraceRow trace_row(const sim::Plant& plant, std::int64_t frame, const sim::Outcome& outcome) {
    sfsm::TraceRow row;
    row.frame = frame;
    row.target_ms = outcome.target_ms;
    row.frame_ms = outcome.ms;
    row.cpu_ms = row.gpu_ms = std::numeric_limits<double>::quiet_NaN();
    row.predicted_ms = outcome.predicted_ms;
    row.decision = outcome.decision;
    row.range = plant.range(frame);
    row.work = plant.work(frame, row.decision);
    return row;
}

void add_forecast(sfsm::TraceRow& row, const sim::Plant& plant) {
    const sfsm::Forecast* forecast = plant.forecast(row.frame);
    if (!forecast) return;
    row.motion.assign(forecast->motion.begin(), forecast->motion.end());
    row.shapes.assign(forecast->shapes.begin(), forecast->shapes.end());
    row.rates.assign(forecast->rates.begin(), forecast->rates.end());
}

}  // namespace apps
