// The surface as a line whose length is area: runs of it are compact patches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pointsample/surface.h"

namespace pointsample {

// The triangles that have an area, along Hilbert's curve of their centroids (2^21 steps an axis); ties in the mesh's
// order. Linear time; 32 bytes a triangle while sorting, 4 afterwards.
std::vector<std::uint32_t> order_along_line(const Surface& surface);

// A cell of a triangle, in barycentrics of its second and third corner: a corner, and the ends of its longest side.
struct Cell {
    glm::vec2 from, to, apex;
};

// Where `along` in [0, 1) lies on Sierpinski's curve through a triangle with these corners, which runs from one end of
// its longest edge to the other: the triangle is halved `halvings` times, at the middle of that edge first. Cells have
// equal areas, so area is preserved.
Cell cell_along(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, double along, int halvings);

}  // namespace pointsample
