// Random bits without state: element i of a stream depends on the seed and i alone, on every machine and in any order.
#pragma once

#include <cstdint>

namespace sfsm {

// splitmix64 (Steele, Lea, Flood 2014): a bijection in which every input bit reaches every output bit.
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

// Element `index` of the stream `seed`: half the work of hash, for streams that are long.
constexpr std::uint64_t stream(std::uint64_t seed, std::uint64_t index) {
    return mix(seed * 0xd1342543de82ef95u + index * 0x9e3779b97f4a7c15u);
}

// In [0, 1), of the upper and of the lower 32 bits; multiples of 2^-24, so that no rounding gives 1.
constexpr float upper_unit(std::uint64_t bits) {
    return static_cast<float>(bits >> 40) * 0x1p-24f;
}
constexpr float lower_unit(std::uint64_t bits) {
    return static_cast<float>(bits >> 8 & 0xffffffu) * 0x1p-24f;
}

// In [-1, 1), more often near 0.
constexpr float triangle(std::uint64_t bits) {
    return upper_unit(bits) + upper_unit(mix(bits)) - 1.0f;
}

// In [0, 1), of the upper 53 bits.
constexpr double unit(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

// In [0, n), n > 0, of the upper 32 bits.
constexpr std::uint32_t below(std::uint64_t bits, std::uint32_t n) {
    return static_cast<std::uint32_t>(((bits >> 32) * n) >> 32);
}

}  // namespace sfsm
