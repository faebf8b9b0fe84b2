// A model's values in few bits and back. Packing what was unpacked gives what unpacks to the same bits. Internal to
// points_*.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "model/unorm.h"
#include "motion/octahedral.h"

namespace pointsample {

// The multiple of the range's 65535th from `min` on, in double: both ends are exact, all else is between them.
float unpack_between(std::uint16_t code, float min, float max);

// The nearest; NaN is min.
std::uint16_t pack_between(float value, float min, float max);

// motion::pack_normal's; of codes that mean almost the same, the one that unpacks to `normal` itself, if one does.
motion::OctahedralNormal pack_normal(const glm::vec3& normal);

// Barycentrics: >= 0, their sum at most 1.
std::array<std::uint16_t, 2> pack_barycentrics(float u, float v);
glm::vec2 unpack_barycentrics(const std::array<std::uint16_t, 2>& codes);

// Bytes of sum 255, each within one of 255 times its share; no weight at all is the first's.
std::array<std::uint8_t, 4> pack_weights(const glm::vec4& weights);
glm::vec4 unpack_weights(const std::array<std::uint8_t, 4>& codes);

}  // namespace pointsample
