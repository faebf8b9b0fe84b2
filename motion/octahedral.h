// Unit vectors in two bytes (Cigolle et al. 2014, "A survey of efficient representations for independent unit
// vectors").
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace motion {

// Octahedral about z, two signed bytes (127 = 1).
struct OctahedralNormal {
    std::int8_t u, v;
};

// `normal` need not be unit; what has no direction (zero, NaN, infinite) is +z.
OctahedralNormal pack_normal(const glm::vec3& normal);

// Unit; within 0.017 rad of what was packed.
glm::vec3 unpack_normal(OctahedralNormal normal);

}  // namespace motion
