// How near to each other points come: a grid, so that a million can be asked about.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <unordered_map>
#include <vector>

namespace tests {

// The least distance between any two of `points`, or `far` if none are nearer than that. [m]
inline float least_distance(const std::vector<glm::vec3>& points, float far) {
    const auto key = [](std::int64_t x, std::int64_t z) { return (x << 32) ^ (z & 0xffffffff); };
    const auto cell = [far](float at) { return static_cast<std::int64_t>(std::floor(at / far)); };
    std::unordered_map<std::int64_t, std::vector<glm::vec3>> cells;
    float least = far;
    for (const glm::vec3& point : points) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dz = -1; dz <= 1; ++dz) {
                const auto found = cells.find(key(cell(point.x) + dx, cell(point.z) + dz));
                if (found == cells.end()) continue;
                for (const glm::vec3& other : found->second) least = std::min(least, glm::distance(point, other));
            }
        }
        cells[key(cell(point.x), cell(point.z))].push_back(point);
    }
    return least;
}

}  // namespace tests
