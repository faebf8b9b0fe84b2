// Whom a place is made for.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "motion/pose_table.h"
#include "scene/crowd.h"

namespace scene {

struct Audience {
    std::int64_t people = 1;  // in [1, 10'000'000]
    // Who they are: 1 to 256 characters, and the poses of each. Must outlive the making of the place.
    std::span<const CastMember> cast;
    std::span<const motion::PoseTable> poses;
    std::uint64_t seed = 0;                  // of all that chance decides
    std::function<void(double)> progress{};  // gets fractions in [0, 1] of the people who have their place
    std::span<const double> weights{};  // > 0: how many there are of each character, against the others; none: as many
};

}  // namespace scene
