// Triangles cut to what can be projected and put on the grid.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/native/fill.h"

namespace render::native {

// A corner before its projection. What Corner::depth is doesn't matter.
struct PlacedCorner {
    glm::dvec3 position;  // across and down: [grid steps m]; depth [m]
    Corner look;
};

// Cuts away what is nearer than near_plane or further than wide_reach from the view's middle, and appends what is left
// as clockwise triangles. Triangles that share an edge share what is left of it. `center_x`, `center_y`: of the
// picture [grid steps].
void append_clipped(const std::array<PlacedCorner, 3>& triangle, double center_x, double center_y, bool double_sided,
                    const Texturing& texturing, std::vector<WideTriangle>& out);

}  // namespace render::native
