// A scenario with what a clairvoyant would do in each of its frames, and the loop that puts a law through it.
#pragma once

#include <functional>
#include <vector>

#include "sfsm/controller.h"
#include "sfsm/simulate/scenario.h"

namespace sfsm::simulate {

// The decision of most detail that costs at most oracle_aim * due_ms().
struct Best {
    Decision decision;
    double cost_ms = 0;
    double detail = 0;
};

struct Course {
    Scenario scenario;
    std::vector<Best> best;  // of each frame
};
Course make_course(Scenario scenario);

// What became of a frame.
struct Outcome {
    double target_ms = 0;  // the user's
    double ms = 0;         // measured
    double cost_ms = 0;    // free of noise
    double detail = 0;
    double predicted_ms = 0;  // what the law expected; NaN: it can't say
    Decision decision;
};

struct RunOptions {
    std::uint64_t seed = 1;
    double target_factor = 1;        // the law is given this share of the target
    std::function<double()> now_us;  // a clock, if the law's own time is asked for
};

// One outcome a frame into `outcomes`, whose memory is used again. Returns the time that decide and observe took
// [us per frame]; 0 without a clock.
double run(const Course& course, Controller& law, const RunOptions& options, std::vector<Outcome>& outcomes);

}  // namespace sfsm::simulate
