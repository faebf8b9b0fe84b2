// Every pose a crowd can strike, skinned once: posed vertices and posed points of each clip frame, packed to eight
// bytes. People share poses, so skinning never happens in a frame; a person is a pose index and a transform.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "model/character.h"
#include "motion/pose.h"

namespace motion {

// Position: 16 bits an axis over the table's box, unorm. Normal: octahedral about z, two signed bytes (127 = 1).
struct PosedVertex {
    std::uint16_t x, y, z;
    std::int8_t normal_u, normal_v;
};
static_assert(sizeof(PosedVertex) == 8);

// A point glued to a triangle: follows any animation of its mesh.
struct SurfacePoint {
    std::uint32_t triangle;
    float u, v;  // barycentrics of the triangle's second and third corner, >= 0, u + v <= 1
};

struct ClipPoses {
    int first_pose = 0;
    int pose_count = 1;
    int ticks_per_pose = 1;
    int ticks() const { return pose_count * ticks_per_pose; }  // the clip's period
    int pose_at(std::int64_t tick) const;                      // wraps
};

struct PoseTable {
    std::vector<ClipPoses> clips;  // in the order asked for
    int pose_count = 0, vertex_count = 0, point_count = 0;
    std::vector<PosedVertex> vertices;  // [pose * vertex_count + vertex]
    std::vector<PosedVertex> points;    // [pose * point_count + point]
    Bounds box;                         // holds every posed vertex of every pose: [model units]
    std::vector<Bounds> clip_boxes;     // the same for each clip
    // Of the first clip's first pose, in which the character stands [model units].
    float rest_height = 0;  // y extent, > 0: people's heights are scaled by it; of a flat pose the box's longest side
    float floor = 0;        // lowest y, which goes on the ground
    float area = 0;         // largest surface area over the poses, without cutouts [model units^2]

    // Of clip `clip` (into clips) at integer time `tick` of its own; wraps.
    int pose_at(int clip, std::int64_t tick) const {
        const ClipPoses& poses = clips[static_cast<std::size_t>(clip)];
        // Most are asked about their first period, pose by pose.
        if (tick < 0 || tick >= poses.pose_count || poses.ticks_per_pose != 1) return poses.pose_at(tick);
        return poses.first_pose + static_cast<int>(tick);
    }
};

// Skins all poses.
//   clips        indices into character.clips; none: the rest pose alone
//   points       may be none
//   byte_budget  [bytes] for vertices and points: poses come at 60 Hz, or at the first of 30, 20, 15 Hz ... that fits
//   progress     gets fractions in [0, 1]
// A clip is a loop: it lasts its duration, rounded to whole poses (at least one), and then its first pose comes again.
// The same bits on every thread count. Throws std::runtime_error if one pose a clip is more than the budget, or if the
// mesh is empty or flat in every pose.
PoseTable bake_poses(const model::Character& character, std::span<const int> clips,
                     std::span<const SurfacePoint> points, std::size_t byte_budget,
                     const std::function<void(double)>& progress = {});

// What the shaders do, for tests and CPU paths.
glm::vec3 unpack_position(const PosedVertex& vertex, const Bounds& box);
glm::vec3 unpack_normal(const PosedVertex& vertex);

}  // namespace motion
