// The line that everything in the stadium follows: two straights joined by half circles, and its parallels.
#pragma once

#include <glm/glm.hpp>

#include "scene/path.h"

namespace scene {

// Centred on the origin in the plane y = 0, straights along x. `offset` [m] is the distance outward from the inner
// line; every function holds for offset > -radius. Arc length runs counter-clockwise seen from above (+y), from the
// start of the straight at +z: along it towards +x, around the bend at +x, back along -z, and around the bend at -x.
struct Oval final : Path {
    float half_straight = 42.195f;  // [m] half of a standard track's 84.39 m straight
    float radius = 36.5f;           // [m] of the inner line's bends

    float length(float offset) const override;
    glm::vec2 position(float arc, float offset) const override;  // arc wraps
    glm::vec2 outward(float arc, float offset) const;            // unit
    glm::vec2 tangent(float arc, float offset) const override;
    float turning(float offset) const override;
    motion::Bounds bounds(float offset) const override;
    float offset_of(glm::vec2 xz) const;  // signed distance from the inner line, outward positive
};

}  // namespace scene
