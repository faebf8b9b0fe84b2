// A line on the ground that people walk and run along, and its parallels; from the origin of its people's block.
#pragma once

#include <glm/glm.hpp>

#include "motion/pose.h"

namespace scene {

// `offset` [m] says which parallel, outward positive; which of them there are is the path's own business. `arc` [m] is
// the way along a parallel, and wraps: who has gone its length is at arc 0 again. So a path that is no loop leads back
// along itself, or begins anew where nobody looks.
class Path {
public:
    virtual ~Path() = default;

    virtual float length(float offset) const = 0;                   // [m] of the parallel, above 0
    virtual glm::vec2 position(float arc, float offset) const = 0;  // x, z [m]
    virtual glm::vec2 tangent(float arc, float offset) const = 0;   // unit, in the direction of growing arc
    // [rad/m] How far the tangent turns on a metre of the parallel where it turns most; infinite if on the spot.
    virtual float turning(float offset) const = 0;
    virtual motion::Bounds bounds(float offset) const = 0;  // [m] of the whole parallel; flat, at y = 0
};

}  // namespace scene
