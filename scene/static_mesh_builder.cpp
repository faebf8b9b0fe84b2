#include "scene/static_mesh_builder.h"

#include <array>
#include <cassert>
#include <span>

#include "scene/ground.h"

namespace scene {

void StaticMeshBuilder::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, Color color, float open) {
    const glm::vec3 normal = glm::normalize(glm::cross(c - a, d - b));
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec3& corner : {a, b, c, d}) mesh.vertices.push_back({corner, normal, color, open});
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + index);
}

void StaticMeshBuilder::column(glm::vec3 foot, glm::vec3 head, glm::vec3 x, float width, float head_width,
                               Color color) {
    const glm::vec3 axis = glm::normalize(head - foot);
    const glm::vec3 y = glm::normalize(glm::cross(axis, x));
    const glm::vec3 side = glm::cross(y, axis);
    const auto corner = [&](glm::vec3 end, float size, int i) {
        const float u = i == 0 || i == 3 ? -0.5f : 0.5f, v = i < 2 ? -0.5f : 0.5f;
        return end + size * (u * side + v * y);
    };
    for (int i = 0; i < 4; ++i) {
        const int next = (i + 1) % 4;
        quad(corner(foot, width, i), corner(foot, width, next), corner(head, head_width, next),
             corner(head, head_width, i), color);
    }
}

void StaticMeshBuilder::box(glm::vec3 center, glm::vec3 x, glm::vec3 y, glm::vec3 z, Color front, Color others) {
    const auto face = [&](glm::vec3 out, glm::vec3 right, glm::vec3 up, Color color) {
        const glm::vec3 middle = center + out;
        quad(middle - right - up, middle + right - up, middle + right + up, middle - right + up, color);
    };
    face(z, x, y, front);
    face(-z, -x, y, others);
    face(x, -z, y, others);
    face(-x, z, y, others);
    face(y, x, -z, others);
    face(-y, x, z, others);
}

// Finer where cameras are, so that x and z interpolate exactly enough to draw lines from.
void StaticMeshBuilder::ground() {
    constexpr Color unseen = {146, 143, 137, static_cast<std::uint8_t>(Surface::ground)};
    constexpr std::array lines{-250.0f, -120.0f, -80.0f, -40.0f, 0.0f, 40.0f, 80.0f, 120.0f, 250.0f};  // [m]
    constexpr std::size_t fields = lines.size() - 1;
    const std::size_t first = mesh.vertices.size();
    for (std::size_t i = 0; i < fields; ++i) {
        for (std::size_t j = 0; j < fields; ++j) {
            const float x0 = lines[i], x1 = lines[i + 1], z0 = lines[j], z1 = lines[j + 1];
            quad({x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0}, unseen);
        }
    }
    // Rings around it, whose quads grow with their distance, as far as OpenGL interpolates well.
    constexpr float growth = 8;
    for (float inner = 1; inner * lines.back() < ground_reach; inner *= growth) {
        const float outer = inner * growth;
        for (std::size_t i = 0; i < fields; ++i) {
            glm::vec3 a(lines[i], 0, lines.back()), b(lines[i + 1], 0, lines.back());
            for (int side = 0; side < 4; ++side) {
                quad(outer * a, outer * b, inner * b, inner * a, unseen);
                a = {a.z, 0, -a.x};
                b = {b.z, 0, -b.x};
            }
        }
    }
    for (StaticVertex& vertex : std::span(mesh.vertices).subspan(first)) vertex.normal = {0, 1, 0};  // without rounding
}

void StaticMeshBuilder::close_sector() {
    StaticSector sector;
    if (!mesh.sectors.empty()) sector.first_index = mesh.sectors.back().first_index + mesh.sectors.back().index_count;
    sector.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - sector.first_index;
    assert(sector.index_count > 0);
    sector.box.min = sector.box.max = mesh.vertices[mesh.indices[sector.first_index]].position;
    for (const std::uint32_t index : std::span(mesh.indices).subspan(sector.first_index)) {
        sector.box.min = glm::min(sector.box.min, mesh.vertices[index].position);
        sector.box.max = glm::max(sector.box.max, mesh.vertices[index].position);
    }
    mesh.sectors.push_back(sector);
}

}  // namespace scene
