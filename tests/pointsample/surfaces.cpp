#include "tests/pointsample/surfaces.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "sfsm/random.h"
#include "tests/pointsample/shapes.h"

namespace tests {
namespace {

// An icosahedron whose edges are cut into `cuts`, on the unit sphere; vertices shared.
model::Mesh geodesic(int cuts) {
    const float t = (1.0f + std::sqrt(5.0f)) / 2.0f;
    const glm::vec3 corner[12] = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                                  {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    const int face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    model::Mesh mesh;
    std::map<std::array<long, 3>, std::uint32_t> known;
    const auto vertex = [&](const glm::vec3& p) {
        const glm::vec3 n = glm::normalize(p);
        const std::array<long, 3> key{std::lround(n.x * 1e5f), std::lround(n.y * 1e5f), std::lround(n.z * 1e5f)};
        const auto [at, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
        if (fresh) mesh.positions.push_back(n);
        return at->second;
    };
    for (const auto& f : face) {
        const glm::vec3 a = corner[f[0]], b = (corner[f[1]] - a) / static_cast<float>(cuts),
                        c = (corner[f[2]] - a) / static_cast<float>(cuts);
        const auto at = [&](int i, int j) { return vertex(a + static_cast<float>(i) * b + static_cast<float>(j) * c); };
        for (int i = 0; i < cuts; ++i)
            for (int j = 0; i + j < cuts; ++j) {
                for (std::uint32_t v : {at(i, j), at(i + 1, j), at(i, j + 1)}) mesh.indices.push_back(v);
                if (i + j + 1 < cuts)
                    for (std::uint32_t v : {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) mesh.indices.push_back(v);
            }
    }
    return mesh;
}

float bumps(const glm::vec3& p, float height, float frequency, int octaves) {
    float sum = 0;
    for (int o = 0; o < octaves; ++o) {
        const glm::vec3 phase =
            frequency * p + static_cast<float>(o) * glm::vec3(1.7f, 0.9f, 2.3f) + glm::vec3(0, 1, 2);
        sum += height * std::sin(phase.x) * std::sin(phase.y) * std::sin(phase.z);
        height *= 0.5f;
        frequency *= 2.1f;
    }
    return sum;
}

void add_box(model::Mesh& mesh, const glm::vec3& low, const glm::vec3& high) {
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    for (std::uint32_t i :
         {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5})
        mesh.indices.push_back(first + i);
}

// Normals as the triangles around each vertex have it, by area; and plain looks.
model::Mesh finished(model::Mesh mesh) {
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 across =
            glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        for (std::size_t k = 0; k < 3; ++k) mesh.normals[mesh.indices[i + k]] += across;
    }
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
    fill_looks(mesh);
    return mesh;
}

}  // namespace

model::Mesh make_ball() {
    return finished(geodesic(32));
}

model::Mesh make_plane() {
    model::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return finished(mesh);
}

model::Mesh make_huge_among_tiny() {
    model::Mesh mesh;
    constexpr std::uint32_t columns = 100, rows = 50;
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i)
            mesh.positions.push_back({static_cast<float>(i) / columns, static_cast<float>(j) / rows, 0});
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t v = j * (columns + 1) + i, above = v + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {v, v + 1, above + 1, v, above + 1, above});
        }
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{1, 0, 0}, {3, 0, 0}, {1, 1, 0}});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
    return finished(mesh);
}

model::Mesh make_cube_and_plate() {
    model::Mesh mesh;
    add_box(mesh, {0, 0, 0}, {1, 1, 1});
    constexpr float thickness = 0.002f;
    const float side = -thickness + std::sqrt(thickness * thickness + 3.0f);  // 2 s^2 + 4 s t = 6
    add_box(mesh, {3, 0, 0}, {3 + side, side, thickness});
    return finished(mesh);
}

model::Mesh make_bumpy() {
    model::Mesh mesh = geodesic(17);
    for (glm::vec3& p : mesh.positions) p *= 1.0f + bumps(p, 0.35f, 3.0f, 2);
    return finished(mesh);
}

model::Mesh make_scan() {
    constexpr int cuts = 66;
    model::Mesh mesh = geodesic(cuts);
    constexpr float edge = 1.1f / cuts;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::uint64_t a = sfsm::stream(7, 2 * i), b = sfsm::stream(7, 2 * i + 1);
        const glm::vec3 astray(sfsm::upper_unit(a), sfsm::lower_unit(a), sfsm::upper_unit(b));
        glm::vec3& p = mesh.positions[i];
        p = glm::normalize(p + 0.6f * edge * (astray - 0.5f));
        p *= 1.0f + bumps(p, 0.35f, 3.0f, 4) + 0.15f * edge * (sfsm::lower_unit(b) - 0.5f);
        p.y *= 1.6f;
    }
    return finished(mesh);
}

}  // namespace tests
