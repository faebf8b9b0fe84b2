// A recorded run with other decisions: what a law would have decided (open loop), and what would have come of it
// (closed).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sfsm/simulate/metrics.h"
#include "sfsm/simulate/scorecard.h"
#include "sfsm/trace.h"

namespace apps {

// What became of the recording under a law. Rows are without forecasts: of a million frames they would fill the memory.
struct Rerun {
    std::string law;
    std::vector<sfsm::TraceRow> rows;
    std::optional<sfsm::simulate::Metrics> metrics;  // of a closed loop
};

// Each recorded time is taken for the time of the law's own decision. `law` is none that looks ahead.
Rerun rerun_open(const sfsm::simulate::Contestant& law, const std::vector<sfsm::TraceRow>& recorded, int delay,
                 sfsm::Drawing drawing);

// A law that is to decide without a course.
std::unique_ptr<sfsm::Controller> make_law(const sfsm::simulate::Contestant& law, sfsm::Drawing drawing);

Rerun rerun_closed(const sfsm::simulate::Contestant& law, const sfsm::simulate::Course& course);

// A frame of a closed loop as a trace has it, without its forecast.
sfsm::TraceRow trace_row(const sfsm::simulate::Plant& plant, std::int64_t frame,
                         const sfsm::simulate::Outcome& outcome);

// Gives a row the forecast that the plant gave before it; none leaves it without.
void add_forecast(sfsm::TraceRow& row, const sfsm::simulate::Plant& plant);

}  // namespace apps
