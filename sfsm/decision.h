// The words that the controller and the renderer speak with each other: plain data.
#pragma once

#include <cstdint>
#include <limits>

#include "sfsm/work.h"

namespace sfsm {

// Lyu et al. 2018, section 3.3. Lower to higher: less picture, less time.
enum class State : int {
    original = 0,  // original triangles, everybody moves every frame
    slowed = 1,    // triangles; beyond D people move at the reduced frequency of eq. 1
    points = 2,    // that, and people are drawn as points of size S
};

// How the next frame is drawn.
struct Decision {
    State state = State::original;
    // D [m], view depth; > 0. Means nothing in state 0.
    double motion_distance = std::numeric_limits<double>::infinity();
    double splat_size = 0;  // S [px] in [0, max_splat_size]; 0 outside state 2
    // [px / piece] > 0: each class of people is drawn and moved so that the next piece of work (WorkPrior) would save
    // less error than this; state, D and S then say what that comes to. 0: D and S decide, for everybody alike.
    double rate = 0;

    bool operator==(const Decision&) const = default;
};
inline constexpr double max_splat_size = 32;  // [px]

// A measured time with the decision and the work it belongs to, however late it arrives.
struct FrameSample {
    std::int64_t frame = 0;
    double ms = 0;
    Decision decision;
    Work work;
};

}  // namespace sfsm
