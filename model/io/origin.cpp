#include "model/io/origin.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/input_file.h"

namespace model {

glm::dvec3 origin_for(const glm::dvec3& least, const glm::dvec3& most) {
    const double size = glm::length(most - least);
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis) farthest = std::max({farthest, std::abs(least[axis]), std::abs(most[axis])});
    if (!std::isnormal(size) || !std::isfinite(farthest) || farthest <= size) return glm::dvec3(0.0);
    const double step = std::exp2(std::floor(std::log2(size)));
    return glm::round((least + (most - least) / 2.0) / step) * step;
}

void refuse_vertex(std::uint64_t vertex) {
    fail("vertex " + std::to_string(vertex) + " of a face at no finite place", "finite numbers");
}

void check_extent(const glm::dvec3& origin, const glm::dvec3& least, const glm::dvec3& most) {
    for (const glm::dvec3& corner : {least - origin, most - origin})
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(static_cast<float>(corner[axis])) && std::isfinite(least.x))
                fail("positions beyond 3.4e38", "what a float holds");
}

}  // namespace model
