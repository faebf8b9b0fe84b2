// All laws through all scenarios on paired noise, and what they were worth: medians over the seeds.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sfsm/simulate/metrics.h"

namespace sfsm::simulate {

// A law, and how to make a fresh one for a run. A law may look at the course's drawing; at all of it, who looks ahead.
struct Contestant {
    std::string name;
    std::function<std::unique_ptr<Controller>(const Course&)> make;
    bool is_retuned = true;  // also takes part with equal-miss
};

// Laws aim at different set points. `own`: at the target, as they were written. `equal-miss`: at the share of the
// target at which they miss as often (T > 1.05 t) as the reference law; where none does so exactly, at one that misses
// less.
enum class Tuning { own, equal_miss };
const char* tuning_name(Tuning tuning);

struct Row {
    std::string scenario, law;
    Tuning tuning = Tuning::own;
    double target_factor = 1;
    bool is_equal = true;  // false: equal-miss asked for misses that the factor's range doesn't reach
    // Medians over the seeds, of each figure by itself. A missing figure counts as more than any number.
    Metrics median;
    Metrics worst;  // of all seeds, of each figure by itself: the largest, of those that are to be large the least
    int stuck_seeds = 0;          // Metrics::is_stuck
    double least_mean_ms = 0;     // of all seeds; the most is worst.mean_ms
    double oracle_over_5pct = 0;  // median
    double us_per_frame = 0;      // of decide and observe, in the fastest of ten runs; 0 without a clock
    bool has_step_down = false, has_step_up = false, has_interruption = false,
         has_regain = false;  // tells "never" from "not asked"
};

struct ScorecardOptions {
    std::vector<Scenario> scenarios;
    std::vector<Contestant> laws;
    Contestant reference;                        // whose misses the others are retuned to
    int seeds = 30;                              // 1, 2, ... seeds; >= 1
    std::function<double()> now_us;              // a clock; may be empty
    std::function<void(double share)> progress;  // from any thread, one at a time; may be empty
};

// Rows by scenario, then law, then tuning, in the order given; the same for any number of cores, but for the times.
// Works in two threads.
std::vector<Row> scorecard(const ScorecardOptions& options);

}  // namespace sfsm::simulate
