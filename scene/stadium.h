// The stadium: where its seats are, and what it looks like without people. Plain data, no GL.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "motion/pose.h"
#include "scene/oval.h"

namespace scene {

struct Seat {
    glm::vec3 position;    // [m] where the hips go, on the floor of the row: the seat's surface is person.h's seat_height above
    float yaw;             // [rad] facing (sin yaw, 0, cos yaw), towards the pitch
};

// Rows of seats in one or two tiers around the oval, in sections between aisles.
struct StadiumPlan {
    Oval oval;
    float stand_offset = 0;     // [m] outward from the inner line to the first row
    float outer_offset = 0;     // [m] to the outer wall
    float rim_height = 0;       // [m] highest built thing
    std::vector<Seat> seats;    // row by row, each row in the order of its arc
};

// As many rows as it takes to seat `people` with a few seats to spare, within 8 to 60 rows.
StadiumPlan plan_stadium(std::int64_t people);

// What the ground shader draws instead of a plain colour.
enum class Surface : std::uint8_t { painted, ground };

struct StaticVertex {
    glm::vec3 position;   // [m]
    glm::vec3 normal;     // unit
    glm::u8vec4 color;    // sRGB; alpha: static_cast of Surface
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
};

// Steps, seats, walls, roof, rim, floodlights, and the ground: pitch, track and surroundings out to 1 km.
StaticMesh build_structure(const StadiumPlan& plan);

}  // namespace scene
