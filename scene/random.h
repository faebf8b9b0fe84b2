// Random bits without state: the same on every machine, for any element in any order.
#pragma once

#include <cstdint>

namespace scene {

// splitmix64's finaliser (Steele, Lea, Flood 2014): a bijection that looks random.
constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// Independent bits for each pair.
constexpr std::uint64_t hash(std::uint64_t a, std::uint64_t b) {
    return mix(mix(a) ^ b);
}

// In [0, 1), from the upper bits.
constexpr float unit(std::uint64_t bits) {
    return static_cast<float>(bits >> 40) * 0x1p-24f;
}

// In [-1, 1), more often near 0.
constexpr float triangle(std::uint64_t bits) {
    return unit(bits) + unit(mix(bits)) - 1.0f;
}

// In [0, n), n > 0.
constexpr std::uint32_t below(std::uint64_t bits, std::uint32_t n) {
    return static_cast<std::uint32_t>(((bits >> 32) * n) >> 32);
}

}  // namespace scene
