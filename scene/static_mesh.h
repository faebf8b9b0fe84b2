// What stands in a place and never moves, ready to be drawn. Plain data, no GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "motion/pose.h"

namespace scene {

// What the ground shader draws instead of a plain colour.
enum class Surface : std::uint8_t { painted, ground };

struct StaticVertex {
    glm::vec3 position;  // [m] from the mesh's origin
    glm::vec3 normal;    // unit
    glm::u8vec4 color;   // sRGB; alpha: static_cast of Surface
    float open = 1;      // how much reaches it of the light from above and below, [0, 1]; the sun's is not meant
};

// Part of the structure that is drawn or culled as one.
struct StaticSector {
    motion::Bounds box;
    std::uint32_t first_index = 0, index_count = 0;
};

struct StaticMesh {
    std::vector<StaticVertex> vertices;
    std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from outside
    std::vector<StaticSector> sectors;
    glm::dvec3 origin{0.0};  // [m] world: of vertices and boxes, and of where the ground's shader looks
};

}  // namespace scene
