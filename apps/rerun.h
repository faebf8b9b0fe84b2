// A recorded run with other decisions: what a law would have decided (open loop), and what would have come of it
// (closed).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sfsm/replay.h"
#include "sfsm/simulate/metrics.h"
#include "sfsm/simulate/scorecard.h"
#include "sfsm/trace.h"

namespace apps {

// What became of a frame. No more than that: there may be a million, of several laws.
struct RerunFrame {
    double target_ms = 0;
    double frame_ms = 0;      // NaN: not measured
    double predicted_ms = 0;  // NaN: the law can't say
    sfsm::Decision decision;
};

// What became of the recording under a law.
struct Rerun {
    std::string law;
    std::vector<RerunFrame> frames;
    std::optional<sfsm::simulate::Metrics> metrics;  // of a closed loop
};

// What the law decides at the row.
RerunFrame next_frame(sfsm::Replaying& replaying, const sfsm::TraceRow& row);

// Each recorded time is taken for the time of the law's own decision. `law` is none that looks ahead.
Rerun rerun_open(const sfsm::simulate::Contestant& law, const sfsm::RunRows& recorded, int delay,
                 sfsm::Drawing drawing);

// A law that is to decide without a course.
std::unique_ptr<sfsm::Controller> make_law(const sfsm::simulate::Contestant& law, sfsm::Drawing drawing);

Rerun rerun_closed(const sfsm::simulate::Contestant& law, const sfsm::simulate::Course& course);

// A frame of a closed loop as a trace has it, with the forecast that the plant gave before it.
sfsm::TraceRow trace_row(const sfsm::simulate::Plant& plant, std::int64_t frame, const RerunFrame& rerun);

}  // namespace apps
