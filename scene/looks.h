// What somebody looks like, drawn from random bits. Internal to scene.
#pragma once

#include <cstdint>

#include "scene/palette.h"

namespace scene {

// How many of those around wear a team's colours, in [0, 1].
struct Fans {
    float home, away;
};

Palette dress(Fans fans, std::uint64_t bits);

// [m] of a standing adult.
float draw_height(std::uint64_t bits);

}  // namespace scene
