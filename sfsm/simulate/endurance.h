// Runs too long to keep every frame of: a scenario over and over, which shows what creeps.
#pragma once

#include <vector>

#include "sfsm/simulate/course.h"

namespace sfsm::simulate {

// One of the equal parts of a run.
struct Stretch {
    std::int64_t end = 0;  // the first frame after it
    double gain = 0;       // what the law multiplies every price by, at the end; NaN: it has none
    double over_5pct = 0;  // share of all its frames with T > 1.05 t
    double quality = 0;    // sum of detail over the sum of the best
};

// Frame k meets plant and target of frame k modulo the scenario's length, and noise of its own. `frames` > 0 are cut
// into at most `stretches` > 0 parts. Memory: constant.
std::vector<Stretch> endure(const Course& course, Controller& law, std::uint64_t seed, std::int64_t frames,
                            int stretches);

}  // namespace sfsm::simulate
