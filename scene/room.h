// How much room somebody needs among others.
#pragma once

#include <span>

#include "motion/pose_table.h"
#include "scene/crowd.h"

namespace scene {

// What one spectator takes up.
struct Room {
    float width = 0.52f;  // [m] from neighbour to neighbour, in [0.52, 3]
    float depth = 0.8f;   // [m] from row to row, in [0.8, 3]
    bool seats = true;    // else people stand where seats would be
};

// The room that the widest and the deepest of the cast need while they watch: a seat if all sit, else a place to stand.
// Sitters as wide and deep as people have seats of a person's size; others wider ones. Characters much longer than tall
// (a fox) still overlap. `poses`: one a member.
Room room_for(std::span<const CastMember> cast, std::span<const motion::PoseTable> poses);

}  // namespace scene
