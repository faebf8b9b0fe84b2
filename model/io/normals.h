// Vertex normals for meshes that bring none. Internal to the loaders.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace model {

// Makes every normal unit. One without a direction (zero, NaN, infinite) becomes the sum of the normals of the
// triangles around its vertex, by area; where that has no direction either, +y. `places`: vertices of the same number,
// below their count, share the triangles around them (seams of looks are no creases); empty: none do.
void complete_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                      std::span<const std::uint32_t> places, std::span<glm::vec3> normals);

}  // namespace model
