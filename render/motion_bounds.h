// How far at most a person's surface is drawn from where it is, if they don't move in every frame: not a mean, as in
// render/staleness.h, but what no vertex of anybody ever exceeds.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "motion/schedule.h"
#include "scene/crowd.h"

namespace render {

// The poses that far blocks show are asked for every so many ticks (FarBlock::tick).
inline constexpr int ticks_a_key = 8;

// [model units] By update period f in [0, max_period] [ticks]: who moved last up to f - 1 ticks ago. Never falls with
// f. For who is known to have moved `age` ticks ago element age + 1 holds as well.
using MotionBound = std::array<float, motion::max_period + 1>;

// Of one character.
struct MotionBounds {
    std::array<MotionBound, scene::role_count> single{};  // of people drawn one by one; 0 for f = 0 and 1
    // Of a far block's: up to ticks_a_key - 1 ticks more ago, and in the key pose that is next to theirs.
    std::array<MotionBound, scene::role_count> far{};
};

// By character; zero for a role that nobody has. A person's are theirs times their scale [m / model unit]. Every pair
// of poses that so many ticks can lie between is looked at, for every vertex, so it holds at any tick, whatever follows
// what: 2 to 45 ms a character on two cores. To that, of walkers and runners, comes their way, their turning, and the
// rounding of places to floats; not the jump of who begins a path anew that isn't closed.
std::vector<MotionBounds> measure_motion_bounds(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                                                std::span<const figures::Figure> figures);

}  // namespace render
