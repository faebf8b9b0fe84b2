// A recorded run as a simulated renderer, for decisions that were not the recorded ones:
//   cost(k, decision) = model(work(k, decision)) * load(k)
//   load(k) = recorded time / model(work(k, recorded decision))
// So the recorded decision costs the recorded time. For our own traces the model is fitted, and the work of a decision
// is what the row's forecast says: of its rates for a decision by rate, of its D and S for any other or where the row
// has no rates. For anything else both are the reference crowd's.
//
// Detail is 1 / (1 + loss), with the loss in pixels, or where a row has rates in units of flip_of_a_pixel: so all laws'
// details in a row are in one unit. There a decision by D and S loses what the first rate does whose own D and S lose
// as many pixels, but no less than the best rate of its time.
#pragma once

#include <span>

#include "sfsm/replay.h"
#include "sfsm/simulate/cost_fit.h"
#include "sfsm/simulate/scenario.h"
#include "sfsm/trace.h"

namespace sfsm::simulate {

// The reference crowd: the 20,000 people of Lyu et al. 2018 (paper_crowd.h) on a machine on which a frame of state 0
// takes 1. State 1 at D = 3/4 L takes 0.31, state 2 at D = L / 6 and S = 1.5 px 0.10. It never moves: one forecast for
// all frames, L = 600 m.

struct RecordedOptions {
    int delay = 2;                      // [frames] in [0, max_delay]
    bool has_work = false;              // rows are one of our traces'
    Drawing drawing = Drawing::opengl;  // by which they were drawn
};

// The run in a closed loop, without any noise but what the load brings; frame k is rows[k], whatever its number.
//
// Work is interpolated between the steps of a forecast as forecast.h says. What a row lacks is taken from the last row
// before it that has it, or for the first rows from the first that has. A row lacks
// - a forecast that is empty, not in order or not finite,
// - a range that is not finite and over 0,
// - a time that no frame can take (is_frame_time).
// A trace of ours without any forecast is treated as foreign: its D are rescaled to the reference crowd's range.
//
// Throws std::runtime_error where no row has a time, as fit_costs does where it is needed, and std::invalid_argument
// where a target is not one (target.h).
Scenario recorded_scenario(std::span<const TraceRow> rows, const RecordedOptions& options);

// The same of rows without work.
Scenario foreign_scenario(const RunRows& rows, int delay, Drawing drawing = Drawing::opengl);

}  // namespace sfsm::simulate
