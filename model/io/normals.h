// Vertex normals for meshes that bring none. Internal to the loaders.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace model {

// Makes every normal unit. One without a direction (zero, NaN, infinite) becomes the sum of the normals of the
// triangles around its vertex, by area; if that has no direction either, +y.
//   places  one a vertex, below their count: vertices of equal places share the triangles around them, so that a change
//           of looks is no crease. Empty: none do.
void complete_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                      std::span<const std::uint32_t> places, std::span<glm::vec3> normals);

}  // namespace model
