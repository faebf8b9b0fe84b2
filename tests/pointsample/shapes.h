// Meshes with known areas and normals.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "model/mesh.h"

namespace tests {

// Gives every vertex what a plain white mesh has.
inline void fill_looks(model::Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    mesh.uvs.resize(count);
    mesh.colors.resize(count, glm::u8vec4(255));
    mesh.slots.resize(count, model::no_slot);
    mesh.materials.resize(1);
    mesh.material_ids.resize(count);
    mesh.joints.resize(count, glm::u16vec4(0));
    mesh.weights.resize(count, glm::vec4(1, 0, 0, 0));
}

inline void append(model::Mesh& mesh, const model::Mesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (const std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
    fill_looks(mesh);
}

// A subdivided octahedron: 8 * 4^levels triangles of nearly equal area on the sphere.
inline model::Mesh make_sphere(float radius, int levels) {
    using glm::vec3;
    std::vector<vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<std::uint32_t> indices{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, added] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
            if (added) points.push_back(glm::normalize(points[a] + points[b]));
            return at->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        indices = finer;
    }
    model::Mesh mesh;
    for (const vec3& point : points) {
        mesh.positions.push_back(radius * point);
        mesh.normals.push_back(point);
    }
    mesh.indices = indices;
    fill_looks(mesh);
    return mesh;
}

// [0, 1]^3: two triangles a face, four vertices each.
inline model::Mesh make_cube() {
    model::Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {0.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            glm::vec3 normal(0);
            normal[axis] = side * 2 - 1;
            for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                glm::vec3 position;
                position[axis] = side;
                position[(axis + 1) % 3] = static_cast<float>(u);
                position[(axis + 2) % 3] = static_cast<float>(v);
                mesh.positions.push_back(position);
                mesh.normals.push_back(normal);
            }
            const bool out = side > 0;
            for (const std::uint32_t corner : {0, out ? 1 : 2, out ? 2 : 1, 0, out ? 2 : 3, out ? 3 : 2})
                mesh.indices.push_back(first + corner);
        }
    }
    fill_looks(mesh);
    return mesh;
}

// A triangle from explicit corners, facing their counter-clockwise side.
inline model::Mesh make_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    model::Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.normals.assign(3, glm::normalize(glm::cross(b - a, c - a)));
    mesh.indices = {0, 1, 2};
    fill_looks(mesh);
    return mesh;
}

}  // namespace tests
