#include "pointsample/point_model.h"

#include <algorithm>
#include <cmath>

namespace pointsample {

std::size_t PointModel::hole_free_points(float pixels_per_unit, float splat_px) const {
    // A square covers the disc in it, however it lies on the screen's grid.
    const double radius = 0.5 * static_cast<double>(splat_px) / static_cast<double>(pixels_per_unit);
    const auto covers = [&](const Coverage& at) { return static_cast<double>(at.radius) <= radius; };
    const auto first = std::find_if(coverage.begin(), coverage.end(), covers);
    if (first == coverage.end()) return size() + 1;
    if (first == coverage.begin()) return first->points;
    // Radii fall nearly as a power of the number of points.
    const Coverage &above = *(first - 1), &below = *first;
    const double share = std::log(static_cast<double>(above.radius) / radius) /
                         std::log(static_cast<double>(above.radius) / static_cast<double>(below.radius));
    const double points = static_cast<double>(above.points) *
                          std::pow(static_cast<double>(below.points) / static_cast<double>(above.points), share);
    return std::clamp(static_cast<std::size_t>(std::ceil(points)), std::size_t{above.points} + 1,
                      std::size_t{below.points});
}

}  // namespace pointsample
