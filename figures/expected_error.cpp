#include "figures/expected_error.h"

#include <algorithm>
#include <cmath>

namespace figures {

double ExpectedError::of_points(double spacing, double cell) const {
    const double coarseness = std::hypot(spacing, blur * (cell - 1));
    const double points_a_cell = cell * cell / (spacing * spacing);
    return finest + growth * std::pow(coarseness, power) + hole * std::exp(-filling * points_a_cell);
}

double ExpectedError::of_mesh(double height) const {
    return mesh / (1 + std::pow(height / mesh_height, mesh_power));
}

double ExpectedError::of_splat(double height) const {
    return std::min(splat + splat_growth * height, splat_most);
}

double ExpectedError::of_motion(double off) const {
    return std::min(motion_growth * off, motion_most);
}

}  // namespace figures
