// A person as the triangles of their mesh: one level, exact. Its elements are the mesh's indices.
#pragma once

#include "figures/representation.h"

namespace figures {

std::vector<Level> triangle_levels(const Figure& figure);

inline constexpr Representation triangles{"triangles", true, triangle_levels, [](double, double) { return 0.0; }};

}  // namespace figures
