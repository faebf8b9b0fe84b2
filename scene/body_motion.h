// How a character's body goes through a clip, measured on its posed surface.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "model/character.h"
#include "motion/pose.h"

namespace scene {

// One element a moment, evenly from the clip's beginning to its end; a single one of a still. [model units]
struct BodyMotion {
    std::vector<double> times;          // [s]
    std::vector<motion::Bounds> boxes;  // of all vertices
    std::vector<glm::vec2> middles;     // x, z of what the body covers of the ground, a thin spear or tail apart
    glm::vec2 drift{0.0f};              // x, z: how far the middle has gone at the end of the clip
    glm::vec2 tread{0.0f};              // [units/s] x, z: how fast feet go that touch the ground; 0 if they go nowhere
    double liveliness = 0;              // [1/s] mean speed of the surface beside the drift, in heights
    double gap = 0;  // mean distance between its last pose and its first, in heights, without the drift

    float height() const;  // median of how far the box is from bottom to top
    float floor() const;   // lowest y, but for moments in which a toe dips deeper: three in ten at most
    bool is_loop() const;  // ends about as it began; else it sits down, stands up or falls
    // [units/s] x, z: how fast the ground would have to go back under the feet; 0 if nothing says that it should.
    glm::vec2 gait() const;
};

// `clip` null: the rest pose. `most_moments` >= 2: fewer are measured of short clips. All zero without vertices.
BodyMotion measure_motion(const model::Character& character, const model::Clip* clip, std::size_t most_moments);

// x, z of the middle of what a surface covers of the ground: halfway between the edges beyond which 10 % of its area
// lie on either side. Of no surface: 0.
glm::vec2 middle_of(const model::Mesh& mesh, const std::vector<glm::vec3>& positions);

// Whether the clip never leaves the pose that the mesh was bound in, wherever that is put: a T-pose. False for who has
// but one bone.
bool strikes_bind_pose(const model::Character& character, const model::Clip& clip);

}  // namespace scene
