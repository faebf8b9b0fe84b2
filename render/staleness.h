// How far off a person's surface is if they last moved some ticks ago. Measured on the crowd itself, so that sitting,
// waving and running each count as what they are.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "motion/schedule.h"
#include "scene/crowd.h"

namespace render {

// [m] How far the surface is from where it should be, by update period f in [0, max_period] [ticks]: the mean over ages
// 0 to f - 1. 0 for f = 0 and 1.
using Staleness = std::array<float, motion::max_period + 1>;

// By character, then role; zero for a role that nobody has. A few hundred people of each are looked at, at ticks spread
// over some minutes: tens of milliseconds a character.
std::vector<std::array<Staleness, scene::role_count>> measure_staleness(const scene::Crowd& crowd,
                                                                        std::span<const scene::CastMember> cast,
                                                                        std::span<const figures::Figure> figures);

}  // namespace render
