#include "motion/octahedral.h"

#include <algorithm>
#include <cmath>

namespace motion {
namespace {

constexpr float steps = 127.0f;  // of an 8-bit snorm

std::int8_t pack_snorm(float value) {
    return static_cast<std::int8_t>(std::lround(value * steps));
}

float sign_of(float value) {
    return value < 0.0f ? -1.0f : 1.0f;
}

}  // namespace

// The octahedron's lower half (z < 0) is folded over the diagonals of the square.
OctahedralNormal pack_normal(const glm::vec3& normal) {
    const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    if (!(sum > 0.0f) || !std::isfinite(sum)) return {0, 0};
    const glm::vec2 p(normal.x / sum, normal.y / sum);
    if (normal.z >= 0.0f) return {pack_snorm(p.x), pack_snorm(p.y)};
    return {pack_snorm((1.0f - std::abs(p.y)) * sign_of(p.x)), pack_snorm((1.0f - std::abs(p.x)) * sign_of(p.y))};
}

glm::vec3 unpack_normal(OctahedralNormal normal) {
    const glm::vec2 p(static_cast<float>(normal.u) / steps, static_cast<float>(normal.v) / steps);
    const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
    const float fold = std::max(-z, 0.0f);
    return glm::normalize(glm::vec3(p.x - sign_of(p.x) * fold, p.y - sign_of(p.y) * fold, z));
}

}  // namespace motion
