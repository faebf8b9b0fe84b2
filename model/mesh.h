// The surface of a character as plain data: triangles, their looks, and how they follow the skeleton.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "model/material.h"
#include "model/slot.h"

namespace model {

// An 8-bit image, rows from the top, four bytes a texel: sRGB red, green, blue and alpha. Read as Material::sampler
// says.
struct Texture {
    int width = 0, height = 0;  // [texels] > 0
    std::vector<glm::u8vec4> texels;
};

// Morph target: adds weight * offset to a run of vertices. `node` and `weight` name the animated weight.
struct MorphTarget {
    std::int32_t node = 0;    // the node of the skeleton that carries the weights
    std::int32_t weight = 0;  // which of the node's weights
    float rest_weight = 0;
    std::uint32_t first_vertex = 0;
    std::vector<glm::vec3> position_offsets;  // for vertices first_vertex ...
    std::vector<glm::vec3> normal_offsets;    // empty or as long as position_offsets
};

// Structure of arrays, one element a vertex unless it says otherwise. All arrays but more_joints and more_weights are
// always filled.
struct Mesh {
    glm::dvec3 origin{0.0};                   // [file's units] that all positions are relative to
    std::vector<glm::vec3> positions;         // [file's units], in bind space
    std::vector<glm::vec3> normals;           // unit, outward
    std::vector<glm::vec2> uvs;               // top-left origin
    std::vector<glm::u8vec4> colors;          // base colour factor x vertex colour, sRGB-encoded
    std::vector<Slot> slots;                  // of the person's colours (slot.h)
    std::vector<std::uint16_t> material_ids;  // into materials
    std::vector<glm::u16vec4> joints;         // into Skeleton::palette; unused ones have weight 0
    std::vector<glm::vec4> weights;           // >= 0, sum 1, more_weights with them
    std::vector<glm::u16vec4> more_joints;    // empty unless some vertex has more than four influences: the next four
    std::vector<glm::vec4> more_weights;      // as long as more_joints; 0 for vertices with up to four
    std::vector<std::uint32_t> indices;       // three a triangle, counter-clockwise seen from outside
    std::vector<Material> materials;          // no two alike
    std::vector<Texture> textures;
    std::vector<MorphTarget> morphs;

    std::size_t vertex_count() const { return positions.size(); }
    std::size_t triangle_count() const { return indices.size() / 3; }

    const Material& material_of(std::size_t vertex) const { return materials[material_ids[vertex]]; }
    // Calls visit(palette entry, weight) for all influences of a vertex; some may weigh 0.
    template <typename Visit>
    void visit_influences(std::size_t vertex, Visit visit) const {
        for (int i = 0; i < 4; ++i) visit(joints[vertex][i], weights[vertex][i]);
        if (more_joints.empty()) return;
        for (int i = 0; i < 4; ++i) visit(more_joints[vertex][i], more_weights[vertex][i]);
    }
    // Whether any of it is seen from both sides. Drawers take a mesh for one-sided or two-sided as a whole: sides.h.
    bool double_sided() const { return std::ranges::any_of(materials, &Material::double_sided); }
};

}  // namespace model
