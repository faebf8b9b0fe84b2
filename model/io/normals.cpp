#include "model/io/normals.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace model {
namespace {

// In double: the squares of a tiny triangle's normal vanish in float.
float length_of(const glm::vec3& v) {
    return static_cast<float>(glm::length(glm::dvec3(v)));
}

bool is_direction(const glm::vec3& v) {
    const float length = length_of(v);
    return length > 0.0f && std::isfinite(length);
}

std::vector<glm::vec3> area_sums(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                                 std::span<const std::uint32_t> places) {
    std::vector<glm::vec3> sums(positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const auto at = [&](std::size_t corner) { return positions[triangles[i + corner]]; };
        const glm::vec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = triangles[i + corner];
            sums[places.empty() ? vertex : places[vertex]] += normal;
        }
    }
    return sums;
}

}  // namespace

void complete_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                      std::span<const std::uint32_t> places, std::span<glm::vec3> normals) {
    std::vector<glm::vec3> sums;
    if (!std::all_of(normals.begin(), normals.end(), is_direction)) sums = area_sums(positions, triangles, places);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        glm::vec3& normal = normals[i];
        if (!is_direction(normal)) normal = sums[places.empty() ? i : places[i]];
        normal = is_direction(normal) ? normal / length_of(normal) : glm::vec3(0, 1, 0);
    }
}

}  // namespace model
