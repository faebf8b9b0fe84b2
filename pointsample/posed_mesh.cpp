#include "pointsample/posed_mesh.h"

#include <cassert>

#include "motion/pose.h"

namespace pointsample {

std::vector<PosedMesh> spread_poses(const model::Character& character, std::span<const int> clips, std::size_t count) {
    assert(count >= 1);
    std::vector<PosedMesh> poses(clips.empty() ? 1 : count);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        motion::Pose pose;
        if (clips.empty()) {
            motion::evaluate_rest(character, pose);
        } else {
            const model::Clip& clip = character.clips[static_cast<std::size_t>(clips[i % clips.size()])];
            const std::size_t rounds = (poses.size() + clips.size() - 1) / clips.size();
            const double share = static_cast<double>(i / clips.size()) / static_cast<double>(rounds);
            motion::evaluate(character, clip, share * clip.duration, pose);
        }
        motion::skin(character.mesh, pose, poses[i].positions, poses[i].normals);
    }
    return poses;
}

glm::vec3 face_normal(std::span<const std::uint32_t> indices, const PosedMesh& pose, std::size_t triangle) {
    const std::uint32_t* corner = &indices[3 * triangle];
    const glm::dvec3 a = pose.positions[corner[0]];
    const glm::dvec3 across =
        glm::cross(glm::dvec3(pose.positions[corner[1]]) - a, glm::dvec3(pose.positions[corner[2]]) - a);
    const double length = glm::length(across);
    if (!(length > 0)) return glm::vec3(0);
    const glm::vec3 normal(across / length);
    const glm::vec3 outward = pose.normals[corner[0]] + pose.normals[corner[1]] + pose.normals[corner[2]];
    return glm::dot(normal, outward) < 0 ? -normal : normal;
}

Place place_of(const motion::SurfacePoint& point, std::span<const std::uint32_t> indices, const PosedMesh& pose) {
    const std::uint32_t* corner = &indices[std::size_t{3} * point.triangle];
    const double u = point.u, v = point.v;
    const glm::dvec3 position = (1 - u - v) * glm::dvec3(pose.positions[corner[0]]) +
                                u * glm::dvec3(pose.positions[corner[1]]) + v * glm::dvec3(pose.positions[corner[2]]);
    return {glm::vec3(position), face_normal(indices, pose, point.triangle)};
}

}  // namespace pointsample
