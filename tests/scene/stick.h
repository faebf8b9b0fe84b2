// A figure of boxes with hips, legs and arms, bound with its arms spread, and clips for it: made in memory.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "model/character.h"
#include "motion/pose.h"

namespace tests {

enum StickJoint : std::uint16_t { stick_hips, stick_leg_l, stick_leg_r, stick_arm_l, stick_arm_r };
inline constexpr float stick_height = 1.75f, stick_hip_height = 0.9f;  // [m]

// A cuboid that hangs on one palette entry.
inline void add_box(model::Mesh& mesh, glm::vec3 min, glm::vec3 max, std::uint16_t joint) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z);
        mesh.positions.push_back(at);
        mesh.normals.push_back(glm::normalize(at - 0.5f * (min + max)));
        mesh.uvs.emplace_back(0.0f);
        mesh.colors.emplace_back(255);
        mesh.slots.push_back({});
        mesh.material_ids.push_back(0);
        mesh.joints.emplace_back(joint, 0, 0, 0);
        mesh.weights.emplace_back(1, 0, 0, 0);
    }
    for (const std::uint32_t index :
         {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3})
        mesh.indices.push_back(first + index);
}

inline void add_joint(model::Skeleton& skeleton, int parent, glm::vec3 at, glm::vec3 parent_at) {
    model::Node node;
    node.parent = parent;
    node.rest.translation = at - parent_at;
    node.rest_matrix = glm::translate(glm::mat4(1.0f), at - parent_at);
    skeleton.nodes.push_back(node);
    skeleton.palette.push_back(
        {static_cast<std::int32_t>(skeleton.nodes.size()) - 1, glm::translate(glm::mat4(1.0f), -at)});
}

// 1.75 m tall, its feet at 0, facing +z, without clips.
inline model::Character make_stick() {
    model::Character stick;
    stick.name = "stick";
    stick.mesh.materials.emplace_back();
    add_box(stick.mesh, {-0.2f, 0.9f, -0.1f}, {0.2f, 1.75f, 0.1f}, stick_hips);
    add_box(stick.mesh, {0.02f, 0, -0.08f}, {0.18f, 0.9f, 0.08f}, stick_leg_l);
    add_box(stick.mesh, {-0.18f, 0, -0.08f}, {-0.02f, 0.9f, 0.08f}, stick_leg_r);
    add_box(stick.mesh, {0.2f, 1.4f, -0.05f}, {0.85f, 1.5f, 0.05f}, stick_arm_l);
    add_box(stick.mesh, {-0.85f, 1.4f, -0.05f}, {-0.2f, 1.5f, 0.05f}, stick_arm_r);
    const glm::vec3 hips(0, stick_hip_height, 0);
    add_joint(stick.skeleton, -1, hips, glm::vec3(0));
    add_joint(stick.skeleton, stick_hips, {0.1f, 0.9f, 0}, hips);
    add_joint(stick.skeleton, stick_hips, {-0.1f, 0.9f, 0}, hips);
    add_joint(stick.skeleton, stick_hips, {0.2f, 1.45f, 0}, hips);
    add_joint(stick.skeleton, stick_hips, {-0.2f, 1.45f, 0}, hips);
    return stick;
}

// How the stick is at a share of a clip, in [0, 1].
struct StickPose {
    glm::vec3 hips{0.0f};        // [m] away from where they rest
    float leg_l = 0, leg_r = 0;  // [rad] forward
    float arms = -1.4f;          // [rad] up from spread: down by default
};

inline void add_clip(model::Character& stick, const std::string& name, double duration,
                     const std::function<StickPose(float)>& pose_at) {
    constexpr int steps = 48;
    model::Clip clip{name, duration, {}};
    const auto channel = [&](StickJoint joint, model::Path path,
                             const std::function<std::vector<float>(float)>& value) {
        model::Channel made{joint, path, model::Interpolation::linear, {}, {}};
        for (int i = 0; i <= steps; ++i) {
            const float share = static_cast<float>(i) / steps;
            made.times.push_back(share * static_cast<float>(duration));
            for (const float part : value(share)) made.values.push_back(part);
        }
        clip.channels.push_back(made);
    };
    const auto turn = [](glm::vec3 axis, float angle) {
        const glm::quat q = glm::angleAxis(angle, axis);
        return std::vector<float>{q.x, q.y, q.z, q.w};
    };
    channel(stick_hips, model::Path::translation, [&](float s) {
        const glm::vec3 at = pose_at(s).hips;
        return std::vector<float>{at.x, at.y + stick_hip_height, at.z};
    });
    channel(stick_leg_l, model::Path::rotation, [&](float s) { return turn({1, 0, 0}, -pose_at(s).leg_l); });
    channel(stick_leg_r, model::Path::rotation, [&](float s) { return turn({1, 0, 0}, -pose_at(s).leg_r); });
    channel(stick_arm_l, model::Path::rotation, [&](float s) { return turn({0, 0, 1}, pose_at(s).arms); });
    channel(stick_arm_r, model::Path::rotation, [&](float s) { return turn({0, 0, 1}, -pose_at(s).arms); });
    stick.clips.push_back(clip);
}

inline float wave_of(float share) {
    return std::sin(6.2831853f * share);
}

// Legs that swing, while the body goes `drift` [m].
inline void add_gait(model::Character& stick, const std::string& name, double duration, float swing,
                     glm::vec3 drift = glm::vec3(0)) {
    add_clip(stick, name, duration, [=](float s) {
        const float angle = swing * wave_of(s);
        // The lower foot stays on the ground.
        return StickPose{s * drift - glm::vec3(0, stick_hip_height * (1 - std::cos(angle)), 0), angle, -angle};
    });
}

// Sways to and fro by `far` [m].
inline void add_sway(model::Character& stick, const std::string& name, float far) {
    add_clip(stick, name, 2, [=](float s) { return StickPose{{far * wave_of(s), 0, 0}}; });
}

inline void add_t_pose(model::Character& stick, const std::string& name) {
    add_clip(stick, name, 1, [](float) { return StickPose{{}, 0, 0, 0}; });
}

// On the ground, its legs ahead; from standing, if it only sits down.
inline void add_sitting(model::Character& stick, const std::string& name, bool sits_down) {
    add_clip(stick, name, 1, [=](float s) {
        const float how_far = sits_down ? s : 1.0f;
        return StickPose{{0, -0.8f * how_far, 0}, 1.5f * how_far, 1.5f * how_far};
    });
}

// Everything about it as if it were made elsewhere in other units: a new root node, as exporters add one.
inline void export_as(model::Character& stick, float units_a_metre, glm::vec3 at_metres) {
    model::Node root;
    root.rest.translation = units_a_metre * at_metres;
    root.rest.scale = glm::vec3(units_a_metre);
    root.rest_matrix = glm::scale(glm::translate(glm::mat4(1.0f), root.rest.translation), root.rest.scale);
    for (model::Node& node : stick.skeleton.nodes) ++node.parent;
    stick.skeleton.nodes.insert(stick.skeleton.nodes.begin(), root);
    for (model::PaletteEntry& entry : stick.skeleton.palette) ++entry.node;
    for (model::Clip& clip : stick.clips)
        for (model::Channel& channel : clip.channels) ++channel.node;
}

// Its posed vertices.
inline std::vector<glm::vec3> posed(const model::Character& character, const model::Clip* clip, double time) {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    if (clip)
        motion::evaluate(character, *clip, time, pose);
    else
        motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, positions, normals);
    return positions;
}

}  // namespace tests
