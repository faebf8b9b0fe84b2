// Between sRGB's bytes and linear light, by table, so that every machine gives the same bytes.
#pragma once

#include <cstdint>

namespace model {

// Linear light in [0, 1] of an sRGB byte (IEC 61966-2-1).
float linear_of_srgb(std::uint8_t byte);

// The sRGB byte nearest in code to `linear`; clamps, and NaN is black. srgb_of_linear(linear_of_srgb(b)) == b.
std::uint8_t srgb_of_linear(float linear);

// The byte nearest to 255 x `value`, whatever it encodes; clamps, and NaN is 0.
std::uint8_t unit_byte(float value);

}  // namespace model
