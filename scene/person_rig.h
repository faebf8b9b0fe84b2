// Private to scene/person*.cpp: the joints of the built-in person, and the two things built on them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "model/clip.h"
#include "model/mesh.h"

namespace scene {

// Both the skeleton's nodes and its palette are in this order. The left is +x, the right -x.
enum Joint : int {
    hips,
    spine,
    chest,
    neck,
    head,
    clavicle_l,
    upper_arm_l,
    forearm_l,
    hand_l,
    clavicle_r,
    upper_arm_r,
    forearm_r,
    hand_r,
    thigh_l,
    shin_l,
    foot_l,
    thigh_r,
    shin_r,
    foot_r,
};
inline constexpr int joint_count = 19;

// The same joint on the other side.
Joint mirrored(Joint joint);

struct JointRest {
    const char* name;
    int parent;           // a Joint, or -1
    glm::dvec3 position;  // [m] at rest, in model space; no joint is turned at rest
};
extern const std::array<JointRest, joint_count> rest_joints;

// Of the left arm at rest: from shoulder to hand, and from its inner (palm) to its outer side.
glm::dvec3 rest_arm_axis();
glm::dvec3 rest_arm_outward();

// Where the shoe touches the ground, heel to toe: what the mesh is shaped by and the gait rolls on.
// Offsets from the ankle [m]: x = forward, y = up.
struct Sole {
    glm::dvec2 heel_back, heel, ball, toe;
};
inline constexpr double ankle_height = 0.075;  // [m]
inline constexpr Sole sole{{-0.072, -0.060}, {-0.050, -0.075}, {0.112, -0.075}, {0.188, -0.055}};

model::Mesh build_person_mesh();
std::vector<model::Clip> build_person_clips();

}  // namespace scene
