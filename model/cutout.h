// Where a masked material leaves no surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "model/mesh.h"

namespace model {

// As OpenGL has it, the last corner of a triangle says what it is made of.
inline const Material& material_of_triangle(const Mesh& mesh, std::size_t triangle) {
    return mesh.material_of(mesh.indices[3 * triangle + 2]);
}

// Whether any triangle's material may leave some of it out.
bool has_cutouts(const Mesh& mesh);

// Whether there is a surface on a triangle where its second and third corner have these shares, 0 <= u, v, u + v <= 1.
bool has_surface(const Mesh& mesh, std::size_t triangle, float u, float v);

// [0, 1] How much of a triangle there is: looked at evenly, in at least 16 places and about four a texel, at most
// `most_places`.
double surface_share(const Mesh& mesh, std::size_t triangle, int most_places = 4096);

}  // namespace model
