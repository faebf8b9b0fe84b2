#include "pointsample/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pointsample {
namespace {

glm::dvec3 corner(std::span<const std::uint32_t> indices, const PosedMesh& pose, std::size_t i) {
    return pose.positions[indices[i]];
}

double area_in(std::span<const std::uint32_t> indices, const PosedMesh& pose, std::size_t triangle) {
    const glm::dvec3 a = corner(indices, pose, 3 * triangle);
    const double area = 0.5 * glm::length(glm::cross(corner(indices, pose, 3 * triangle + 1) - a,
                                                     corner(indices, pose, 3 * triangle + 2) - a));
    return std::isfinite(area) ? area : 0.0;
}

}  // namespace

Surface::Surface(std::span<const std::uint32_t> indices, std::span<const PosedMesh> poses)
    : indices_(indices), poses_(poses) {
    assert(!poses.empty());
    find_frame();
    if (poses_.size() > 1) find_stretch();
    for (std::size_t i = 0; i < triangle_count(); ++i) total_area_ += area(i);
}

double Surface::first_area(std::size_t triangle) const {
    return area_in(indices_, poses_.front(), triangle);
}

void Surface::find_frame() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity), high(-infinity), weighted(0.0);
    for (std::size_t i = 0; i < triangle_count(); ++i) {
        const double area = first_area(i);
        if (!(area > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p = corner(indices_, poses_.front(), 3 * i + k);
            low = glm::min(low, p);
            high = glm::max(high, p);
            weighted += area / 3 * p;
        }
        total_first_area_ += area;
    }
    if (!(total_first_area_ > 0))
        throw std::runtime_error("found no triangle with an area; expected a surface to sample");
    if (total_first_area_ > static_cast<double>(std::numeric_limits<float>::max()))
        throw std::runtime_error("found a surface of more than 3.4e38 square units; expected a smaller one");
    center_ = weighted / total_first_area_;
    const glm::dvec3 size = high - low;
    unit_ = std::max({size.x, size.y, size.z});
}

void Surface::find_stretch() {
    constexpr double most = 1024;  // a triangle that is nearly none in the first pose has no room for more
    stretch_.resize(triangle_count());
    for (std::size_t i = 0; i < triangle_count(); ++i) {
        const double first = first_area(i);
        double largest = first;
        for (const PosedMesh& pose : poses_.subspan(1)) largest = std::max(largest, area_in(indices_, pose, i));
        stretch_[i] = first > 0 ? static_cast<float>(std::min(largest / first, most)) : 1.0f;
    }
}

}  // namespace pointsample
