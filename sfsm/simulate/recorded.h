// A recorded run as a simulated renderer. What was recorded is the load under its own detail; what a law would have met
// with decisions of its own is a cost model times that load:
//   cost(k, decision) = model(work(k, decision)) * load(k),   load(k) = recorded time / model(recorded work).
// Of our own traces the model is fitted, and the work of every decision is what the trace's forecasts say. Of anything
// else the load is the time of a frame in which nothing is given up, and the model is the reference crowd below.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sfsm/simulate/scenario.h"
#include "sfsm/simulate/work_plant.h"
#include "sfsm/trace.h"

namespace sfsm::simulate {

// How well prices times counts explain the times of a trace.
struct CostFit {
    Prices prices;            // [ms] each >= 0: robust, non-negative least squares
    std::int64_t frames = 0;  // that were fitted
    double r2 = 0;            // 1 - residual / total sum of squares of the times; can be negative
    double median_ms = 0;     // of the times
    // Percentiles of the relative residual time / model - 1.
    static constexpr std::array<double, 7> percents{1, 5, 25, 50, 75, 95, 99};
    std::array<double, 7> residual{};
};

// Throws std::runtime_error where the rows can't tell: fewer than 16 measured, or no work counted in any.
CostFit fit_costs(std::span<const TraceRow> rows);

// The reference crowd: 20,000 people of Lyu et al. 2018 whose prices are in its proportions, so that states 0, 1 and 2
// cost about 1, 1/3 and 1/10 of the load.

struct RecordedOptions {
    int delay = 2;          // [frames] in [0, max_delay]
    bool has_work = false;  // rows are one of our traces'
};

// The run in a closed loop, without any noise but what the load brings. Targets are the rows' (all finite and > 0).
// Rows without a time have the load of the last one before them. Throws as fit_costs does, and std::runtime_error where
// no row has a time.
Scenario recorded_scenario(std::span<const TraceRow> rows, const RecordedOptions& options);

}  // namespace sfsm::simulate
