// The one record that people are drawn from: a vertex or a point in one pose, its looks beside it. The base vertex of a
// draw shifts all attributes alike, so what doesn't change with the pose is repeated for each.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/pose_table.h"
#include "render/gl/objects.h"
#include "shaders/layout.h"

namespace render::gl {

struct BakedVertex {
    motion::PosedVertex posed;
    std::uint8_t red, green, blue;  // sRGB
    std::uint8_t look;              // shaders/layout.h's attribute_look
    // Of vertices: uv, half x 2; of points: shares of slots, unorm 8 x 4 each.
    std::array<std::uint32_t, slot_vectors> extra;
};
static_assert(sizeof(BakedVertex) == 12 + 4 * slot_vectors);

// What is drawn of every pose: one of its vertices or points, with its looks.
struct Record {
    std::uint32_t posed;  // which of the pose's
    BakedVertex look;     // `posed` is filled in pose by pose
};

// Pose after pose of `posed`, `per_pose` each, as the records ask for them.
Buffer upload_poses(std::span<const motion::PosedVertex> posed, int per_pose, std::span<const Record> records);

// What `extra` holds.
enum class Extra { nothing, uv, shares };

// What few characters need, for a pose after the other: of vertices a byte each, 255 = 1; of points own lights.
void add_alphas(const VertexArray& array, const Buffer& alphas);
void add_own_lights(const VertexArray& array, const Buffer& own_lights);

// Reads people: `vertices` a BakedVertex at a time, `instances` a person at a time (render::Instance).
VertexArray make_person_array(const Buffer& vertices, const Buffer& instances, Extra extra);

}  // namespace render::gl
