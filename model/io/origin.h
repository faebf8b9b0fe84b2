// Where a mesh's own origin lies: scans in a country's coordinates have millimetres at five million metres, which
// floats can't tell apart. Internal to the loaders.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "model/mesh.h"

namespace model {

// Of a mesh in the box of these finite corners. Zero if no coordinate is larger than the box's diagonal, as floats hold
// those to 1e-7 of it, and whoever stands on zero is left as they are; else about its middle, in round binary numbers.
glm::dvec3 origin_for(const glm::dvec3& least, const glm::dvec3& most);

[[noreturn]] void refuse_vertex(std::uint64_t vertex);

// Throws std::runtime_error if it is not; `vertex` is its number in the file.
inline void check_finite(const glm::dvec3& position, std::uint64_t vertex) {
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) refuse_vertex(vertex);
}

// Throws std::runtime_error if a float does not hold the box from `origin` on.
void check_extent(const glm::dvec3& origin, const glm::dvec3& least, const glm::dvec3& most);

// The origin of `count` vertices at position_of(i), all finite. Throws std::runtime_error if a float can't hold one.
template <typename PositionOf>
glm::dvec3 origin_of(std::size_t count, PositionOf position_of) {
    glm::dvec3 least(INFINITY), most(-INFINITY);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 position = position_of(i);
        least = glm::min(least, position);
        most = glm::max(most, position);
    }
    const glm::dvec3 origin = origin_for(least, most);
    check_extent(origin, least, most);
    return origin;
}

// Gives a mesh these positions, about an origin of their own.
template <typename PositionOf>
void place(Mesh& mesh, std::size_t count, PositionOf position_of) {
    mesh.origin = origin_of(count, position_of);
    mesh.positions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) mesh.positions.emplace_back(position_of(i) - mesh.origin);
}

}  // namespace model
