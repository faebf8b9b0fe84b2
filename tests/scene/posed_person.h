// The built-in person and what its tests ask of it: joints and vertices by name, posed at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion/pose.h"
#include "scene/person.h"

namespace tests {

inline const model::Character& person() {
    static const model::Character character = scene::make_person();
    return character;
}

inline const model::Clip& clip_named(const std::string& name) {
    const auto& clips = person().clips;
    const auto found =
        std::find_if(clips.begin(), clips.end(), [&](const model::Clip& clip) { return clip.name == name; });
    if (found == clips.end()) throw std::runtime_error("the person has no clip " + name);
    return *found;
}

inline int node_named(const std::string& name) {
    const auto& nodes = person().skeleton.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].name == name) return static_cast<int>(i);
    throw std::runtime_error("the person has no joint " + name);
}

inline const std::array<std::string, 4> seated_clips{"sit", "clap", "cheer", "wave"};

// One id a vertex: equal positions, bit by bit, are one.
inline std::vector<std::uint32_t> welded(const model::Mesh& mesh) {
    std::map<std::array<float, 3>, std::uint32_t> ids;
    std::vector<std::uint32_t> result;
    for (const glm::vec3& p : mesh.positions)
        result.push_back(ids.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(ids.size())).first->second);
    return result;
}

inline glm::vec3 face_cross(const model::Mesh& mesh, std::size_t first) {
    const glm::vec3 a = mesh.positions[mesh.indices[first]];
    return glm::cross(mesh.positions[mesh.indices[first + 1]] - a, mesh.positions[mesh.indices[first + 2]] - a);
}

inline std::vector<glm::vec3> posed(const model::Clip& clip, double time) {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate(person(), clip, time, pose);
    motion::skin(person().mesh, pose, positions, normals);
    return positions;
}

inline std::vector<glm::vec3> joints_at(const model::Clip& clip, double time) {
    motion::Pose pose;
    motion::evaluate(person(), clip, time, pose);
    std::vector<glm::vec3> result;
    for (const glm::mat4& world : pose.world) result.emplace_back(world[3]);
    return result;
}

inline std::vector<std::size_t> vertices_of(const std::string& joint) {
    const model::Mesh& mesh = person().mesh;
    const int node = node_named(joint);
    std::vector<std::size_t> result;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.joints[v][0] == node && mesh.weights[v][0] > 0.5f) result.push_back(v);
    return result;
}

inline constexpr double fine_step = 1.0 / 240.0;  // [s] four times a table's rate

inline void for_every_instant(const model::Clip& clip, const std::function<void(double)>& look) {
    const auto steps = static_cast<int>(std::lround(clip.duration / fine_step));
    for (int i = 0; i < steps; ++i) look(i * fine_step);
}

}  // namespace tests
