// What characters that tests make by hand are of: vertices that all hang on one joint.
#pragma once

#include "model/character.h"

namespace tests {

// White, of the first material, without a texture or a slot. `position` in model units; `normal` unit.
inline void add_vertex(model::Mesh& mesh, const glm::vec3& position, const glm::vec3& normal) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.emplace_back(0);
    mesh.colors.emplace_back(255);
    mesh.slots.push_back(model::no_slot);
    mesh.material_ids.push_back(0);
    mesh.joints.emplace_back(0);
    mesh.weights.emplace_back(1, 0, 0, 0);
}

inline void add_only_joint(model::Character& character) {
    character.skeleton.nodes.resize(1);
    character.skeleton.palette.emplace_back();
}

}  // namespace tests
