// What choosing how to draw must know of a character.
#pragma once

#include <cstdint>

#include "motion/pose_table.h"
#include "scene/crowd.h"

namespace render {

struct Figure {
    const scene::CastMember* member = nullptr;
    const motion::PoseTable* poses = nullptr;
    std::uint32_t triangle_count = 0;
    float area = 0;  // what its points cover [model units^2]
};

}  // namespace render
