// Random bits from a counter: element i of a stream depends on seed and i alone.
#pragma once

#include <cstdint>

namespace pointsample {

// Splitmix64's finaliser over a Weyl sequence (Steele et al. 2014).
inline std::uint64_t hash(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed * 0xd1342543de82ef95u + (index + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

// In [0, 1), of the upper and of the lower 32 bits; multiples of 2^-24, so that no rounding gives 1.
inline float upper_unit(std::uint64_t bits) {
    return static_cast<float>(bits >> 40) * 0x1p-24f;
}
inline float lower_unit(std::uint64_t bits) {
    return static_cast<float>(bits >> 8 & 0xffffffu) * 0x1p-24f;
}
// In [0, 1), of the upper 53 bits.
inline double unit(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace pointsample
