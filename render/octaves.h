// The bits of a positive float are its logarithm, piecewise linear: near enough for bins, and free.
#pragma once

#include <bit>
#include <cstdint>

namespace render {

inline float octaves(float value) {
    constexpr int mantissa_bits = 23;
    constexpr float one = 1 << mantissa_bits;
    return static_cast<float>(std::bit_cast<std::uint32_t>(value)) / one - 127;
}

}  // namespace render
