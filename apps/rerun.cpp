#include "apps/rerun.h"

#include <limits>
#include <memory>

namespace apps {

namespace sim = sfsm::simulate;

std::unique_ptr<sfsm::Controller> make_law(const sim::Contestant& law, sfsm::Drawing drawing) {
    sim::Course nowhere;
    nowhere.scenario.drawing = drawing;
    return law.make(nowhere);
}

RerunFrame next_frame(sfsm::Replaying& replaying, const sfsm::TraceRow& row) {
    const sfsm::Replayed replayed = replaying.next(row);
    return {row.target_ms, row.frame_ms, replayed.predicted_ms, replayed.decision};
}

Rerun rerun_open(const sim::Contestant& law, const sfsm::RunRows& recorded, int delay, sfsm::Drawing drawing) {
    const std::unique_ptr<sfsm::Controller> controller = make_law(law, drawing);
    sfsm::Replaying replaying(*controller, delay);
    Rerun rerun{law.name, {}, {}};
    rerun.frames.reserve(recorded.count);
    for (std::size_t i = 0; i < recorded.count; ++i) rerun.frames.push_back(next_frame(replaying, recorded.at(i)));
    return rerun;
}

Rerun rerun_closed(const sim::Contestant& law, const sim::Course& course) {
    std::vector<sim::Outcome> outcomes;
    sim::run(course, *law.make(course), {}, outcomes);
    Rerun rerun{law.name, {}, sim::measure(course, outcomes)};
    rerun.frames.reserve(outcomes.size());
    for (const sim::Outcome& outcome : outcomes)
        rerun.frames.push_back({outcome.target_ms, outcome.ms, outcome.predicted_ms, outcome.decision});
    return rerun;
}

sfsm::TraceRow trace_row(const sim::Plant& plant, std::int64_t frame, const RerunFrame& rerun) {
    sfsm::TraceRow row;
    row.frame = frame;
    row.target_ms = rerun.target_ms;
    row.frame_ms = rerun.frame_ms;
    row.cpu_ms = row.gpu_ms = std::numeric_limits<double>::quiet_NaN();
    row.predicted_ms = rerun.predicted_ms;
    row.decision = rerun.decision;
    row.range = plant.range(frame);
    row.work = plant.work(frame, row.decision);
    const sfsm::Forecast* forecast = plant.forecast(frame);
    if (!forecast) return row;
    row.motion.assign(forecast->motion.begin(), forecast->motion.end());
    row.shapes.assign(forecast->shapes.begin(), forecast->shapes.end());
    row.rates.assign(forecast->rates.begin(), forecast->rates.end());
    return row;
}

}  // namespace apps
