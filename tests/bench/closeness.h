// How near points are to a surface and the surface to them, independently of the sampler: nearest distances by looking
// at all that could be nearest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "model/mesh.h"

namespace bench {

// Points of a mesh, one element a point.
struct Spots {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
};

// `count` independent points of the posed mesh, area-uniform. At least one triangle must have an area.
Spots random_spots(const model::Mesh& mesh, std::span<const glm::vec3> positions, std::size_t count,
                   std::uint64_t seed);

// Distances of spots of a surface to the nearest of some points [units].
struct Covering {
    double largest = 0, percentile_99 = 0, mean = 0;
};

// Neither may be empty.
Covering covering_of(std::span<const glm::vec3> spots, std::span<const glm::vec3> points);

// Mean distance of points to the nearest spot of any triangle [units]. Time is points * triangles.
double mean_distance_to_surface(std::span<const glm::vec3> points, const model::Mesh& mesh,
                                std::span<const glm::vec3> positions);

}  // namespace bench
