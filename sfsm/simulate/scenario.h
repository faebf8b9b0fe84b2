// What a law is put through: a plant, a target, and all that comes between what a frame costs and the time that
// arrives. Everything is a function of the frame number and the seed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/drawing.h"
#include "sfsm/simulate/plant.h"
#include "sfsm/target.h"

namespace sfsm::simulate {

// Frames [begin, end).
struct Frames {
    std::int64_t begin = 0, end = 0;
    bool contains(std::int64_t frame) const { return frame >= begin && frame < end; }
};

// Frames that take a time of their own, whatever is drawn: a hitch, a pause, a loading screen. They count in no share.
// In the order of frames, the first not before frame 60.
struct Interruption {
    Frames frames;
    double ms = 0;  // any number, also none
};

// The load or the target changes at once, and stays so for a while.
struct LoadStep {
    Frames frames;         // under the new load
    bool is_down = false;  // detail has to go down to stay in time
};

// Other programs' work comes first in the last `frames` of every `period` frames, and takes `share` of the target.
struct Burst {
    std::int64_t period = 0, frames = 0;  // 0: never
    double share = 0;
};

struct Scenario {
    std::string name;
    std::string about;  // in a few words
    std::shared_ptr<const Plant> plant;
    Drawing drawing = Drawing::opengl;                                    // what laws are told that frames are drawn by
    TargetSchedule target = TargetSchedule::parse("16.666666666666668");  // [ms]
    std::int64_t frames = 3600;
    std::int64_t statistics_from = 200;  // laws may learn before
    int delay = 2;                       // a time arrives before the decision of the frame 1 + delay later, [0, 16]

    // Measured = cost * exp(noise * N(0, 1)). In a share of the frames a spike of target * U(spike_low, spike_high) is
    // added. The sum is rounded up to a multiple of refresh_ms.
    double noise = 0;
    bool is_heavy_tailed = false;  // N is Student's t of 3 degrees of freedom, of deviation 1
    double correlation = 0;        // of N from frame to frame, [0, 1): AR(1); its deviation stays 1
    double spike_share = 0;
    double spike_low = 0.7, spike_high = 2;
    Burst burst;
    double cap_ms = 0;      // an outside cap on the frame rate: no frame takes less
    double refresh_ms = 0;  // 0: no vertical sync
    double longest_refresh_ms =
        0;                 // over 0: a display of variable refresh, which shows a frame at once between the two
    double jitter_ms = 0;  // each stamp is off by up to half of this, so a time by up to all of it

    std::vector<Interruption> interruptions;
    std::vector<LoadStep> steps;
    std::vector<Frames> regained;  // from its begin on the best detail can be had again, at least this share of it:
    double regained_share = 0.9;
    std::vector<Frames> steady;  // nothing changes here but noise, and laws have had time to settle
    double oracle_aim = 1;       // what the oracle holds, in shares of the target; under 1 where times are quantised
};

// The target of a frame, or the cap where that is slower [ms].
double due_ms(const Scenario& scenario, std::int64_t frame);

std::span<const std::string_view> scenario_names();

// Throws std::invalid_argument naming the scenarios there are.
Scenario make_scenario(std::string_view name);

// The time of frame `frame` that was drawn at `cost_ms` [ms]; what a user of the renderer would measure.
double measured_ms(const Scenario& scenario, std::uint64_t seed, std::int64_t frame, double cost_ms);

}  // namespace sfsm::simulate
