// A recorded run as a simulated renderer. What was recorded is the load under its own detail; what a law would have met
// with decisions of its own is a cost model times that load:
//   cost(k, decision) = model(work(k, decision)) * load(k),   load(k) = recorded time / model(work(k, recorded
//   decision)).
// So the recorded decision costs the recorded time. Of our own traces the model is fitted, and the work of a decision
// is what the row's forecast says. Of anything else both are the reference crowd's.
#pragma once

#include <span>

#include "sfsm/simulate/cost_fit.h"
#include "sfsm/simulate/scenario.h"
#include "sfsm/trace.h"

namespace sfsm::simulate {

// The reference crowd: the 20,000 people of Lyu et al. 2018 (paper_crowd.h) on a machine on which a frame of state 0
// takes 1. State 1 at D = 3/4 L takes 0.31, state 2 at D = L / 6 and S = 1.5 px 0.10. It never moves: one forecast for
// all frames, L = 600 m.

struct RecordedOptions {
    int delay = 2;          // [frames] in [0, max_delay]
    bool has_work = false;  // rows are one of our traces'
};

// The run in a closed loop, without any noise but what the load brings; frame k is rows[k], whatever its number.
//
// Work is interpolated between the steps of a forecast as forecast.h says; a row whose forecast can't be used (none,
// not in order, not finite) has the one of the last row before it, the first rows that of the first that has one. Rows
// without a time and a range take theirs in the same way; times a frame can't take (cost_fit.h) are none. Traces of
// ours in which no row has a forecast are treated as foreign, each decision being read for the reference crowd's range.
//
// Throws std::runtime_error where no row has a time, as fit_costs does where it is needed, and std::invalid_argument
// where a target is not one (target.h).
Scenario recorded_scenario(std::span<const TraceRow> rows, const RecordedOptions& options);

}  // namespace sfsm::simulate
