// A file of a mesh read, checked and posed as a program would.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "model/io/mesh_file.h"
#include "motion/pose.h"

namespace tests {

inline void check_numbers(const model::Mesh& mesh) {
    const auto is_finite = [](const auto& v) {
        return glm::all(glm::lessThan(glm::abs(v), decltype(glm::abs(v))(INFINITY)));
    };
    if (!std::ranges::all_of(mesh.positions, is_finite)) throw std::logic_error("a position is no number");
    if (!std::ranges::all_of(mesh.normals, is_finite)) throw std::logic_error("a normal is no number");
    if (!std::ranges::all_of(mesh.uvs, is_finite)) throw std::logic_error("a texture coordinate is no number");
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        float sum = 0;
        mesh.visit_influences(i, [&](std::uint16_t, float weight) { sum += weight; });
        if (!(std::abs(sum - 1) < 1e-3f)) throw std::logic_error("weights that are no whole");
    }
}

// Throws what the loader throws, and std::logic_error for what no loader may hand on.
inline void use_mesh_file(const std::filesystem::path& path) {
    const model::Character character = model::load_mesh(path);
    const model::Mesh& mesh = character.mesh;
    const std::size_t count = mesh.vertex_count();
    if (mesh.indices.empty() || mesh.indices.size() % 3 != 0) throw std::logic_error("no triangles");
    for (const std::size_t size : {mesh.normals.size(), mesh.uvs.size(), mesh.colors.size(), mesh.slots.size(),
                                   mesh.material_ids.size(), mesh.joints.size(), mesh.weights.size()})
        if (size != count) throw std::logic_error("lists of different lengths");
    if ((!mesh.more_joints.empty() && mesh.more_joints.size() != count) ||
        mesh.more_weights.size() != mesh.more_joints.size())
        throw std::logic_error("influences of other vertices");
    for (const std::uint32_t index : mesh.indices)
        if (index >= count) throw std::logic_error("an index out of range");
    check_numbers(mesh);
    for (const std::uint16_t material : mesh.material_ids)
        if (material >= mesh.materials.size()) throw std::logic_error("a material out of range");
    for (const model::Material& material : mesh.materials)
        if (material.texture != model::no_texture && material.texture >= mesh.textures.size())
            throw std::logic_error("a texture out of range");
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate_rest(character, pose);
    for (const model::Clip& clip : character.clips) motion::evaluate(character, clip, 0.3 * clip.duration, pose);
    motion::skin(mesh, pose, positions, normals);
}

}  // namespace tests
