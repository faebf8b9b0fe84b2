#include "scene/person.h"

#include <cmath>

#include "scene/person_rig.h"

namespace scene {

// Stature 1.75 m; segment lengths after Winter, Biomechanics and Motor Control of Human Movement, fig. 4.1
// (shoulder 0.818, elbow 0.630, knee 0.285, ankle 0.039 of stature), rounded to the half centimetre.
// The arms point 43 degrees outward: midway between a lap and a cheer, so that the skin of the shoulders is
// stretched as little as possible in both. Upper arm and forearm are in line.
const std::array<JointRest, joint_count> rest_joints{{
    {"hips", -1, {0.0, 0.960, 0.0}},
    {"spine", hips, {0.0, 1.070, -0.010}},
    {"chest", spine, {0.0, 1.220, -0.015}},
    {"neck", chest, {0.0, 1.480, -0.020}},
    {"head", neck, {0.0, 1.555, 0.000}},
    {"clavicle_l", chest, {0.030, 1.425, 0.000}},
    {"upper_arm_l", clavicle_l, {0.175, 1.420, -0.015}},
    {"forearm_l", upper_arm_l, {0.3795, 1.2005, -0.015}},
    {"hand_l", forearm_l, {0.5533, 1.0139, -0.015}},
    {"clavicle_r", chest, {-0.030, 1.425, 0.000}},
    {"upper_arm_r", clavicle_r, {-0.175, 1.420, -0.015}},
    {"forearm_r", upper_arm_r, {-0.3795, 1.2005, -0.015}},
    {"hand_r", forearm_r, {-0.5533, 1.0139, -0.015}},
    {"thigh_l", hips, {0.090, 0.915, 0.0}},
    {"shin_l", thigh_l, {0.090, 0.495, 0.0}},
    {"foot_l", shin_l, {0.090, ankle_height, 0.0}},
    {"thigh_r", hips, {-0.090, 0.915, 0.0}},
    {"shin_r", thigh_r, {-0.090, 0.495, 0.0}},
    {"foot_r", shin_r, {-0.090, ankle_height, 0.0}},
}};

Joint mirrored(Joint joint) {
    constexpr int arm = clavicle_r - clavicle_l;
    constexpr int leg = thigh_r - thigh_l;
    if (joint >= clavicle_l && joint <= hand_l) return static_cast<Joint>(joint + arm);
    if (joint >= clavicle_r && joint <= hand_r) return static_cast<Joint>(joint - arm);
    if (joint >= thigh_l && joint <= foot_l) return static_cast<Joint>(joint + leg);
    if (joint >= thigh_r && joint <= foot_r) return static_cast<Joint>(joint - leg);
    return joint;
}

glm::dvec3 rest_arm_axis() {
    return glm::normalize(rest_joints[hand_l].position - rest_joints[upper_arm_l].position);
}

glm::dvec3 rest_arm_outward() {
    return glm::cross(glm::dvec3(0.0, 0.0, 1.0), rest_arm_axis());
}

namespace {

model::Skeleton build_skeleton() {
    model::Skeleton skeleton;
    for (int joint = 0; joint < joint_count; ++joint) {
        const JointRest& rest = rest_joints[joint];
        const glm::dvec3 parent = rest.parent < 0 ? glm::dvec3(0.0) : rest_joints[rest.parent].position;

        model::Node node;
        node.name = rest.name;
        node.parent = rest.parent;
        node.rest.translation = glm::vec3(rest.position - parent);
        node.rest_matrix[3] = glm::vec4(node.rest.translation, 1.0f);
        skeleton.nodes.push_back(node);

        model::PaletteEntry entry;
        entry.node = joint;
        entry.inverse_bind[3] = glm::vec4(-glm::vec3(rest.position), 1.0f);
        skeleton.palette.push_back(entry);
    }
    return skeleton;
}

}  // namespace

model::Character make_person() {
    model::Character person;
    person.name = "person";
    person.mesh = build_person_mesh();
    person.skeleton = build_skeleton();
    person.clips = build_person_clips();
    return person;
}

}  // namespace scene
