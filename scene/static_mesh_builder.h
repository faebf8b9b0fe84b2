// Puts a structure together from flat pieces. All surfaces are single-sided and flat-shaded: a quad has four vertices
// of its own. Internal to scene.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scene/static_mesh.h"

namespace scene {

using Color = glm::u8vec4;  // sRGB, and a Surface

constexpr Color painted(int red, int green, int blue) {
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue),
            static_cast<std::uint8_t>(Surface::painted)};
}

struct StaticMeshBuilder {
    StaticMesh mesh;

    // a, b, c, d counter-clockwise seen from the visible side; `open`: StaticVertex::open.
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, Color color, float open = 1);

    // A four-sided column from `foot` to `head`, `width` [m] wide, open at both ends. Its sides are parallel to `x`.
    void column(glm::vec3 foot, glm::vec3 head, glm::vec3 x, float width, float head_width, Color color);

    // All six sides of a box with half axes x, y, z, right-handed; the front looks along z.
    void box(glm::vec3 center, glm::vec3 x, glm::vec3 y, glm::vec3 z, Color front, Color others);

    // The flat sheet that the ground's shader paints: y = 0, out to ground_reach.
    void ground();

    // Everything added since the last sector, at least a triangle, becomes a sector.
    void close_sector();
};

}  // namespace scene
