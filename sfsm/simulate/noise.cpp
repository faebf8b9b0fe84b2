#include "sfsm/simulate/noise.h"

#include <cmath>
#include <numbers>

namespace sfsm::simulate {
namespace {

// splitmix64 (Steele, Lea, Flood 2014): a bijection in which every input bit reaches every output bit.
std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

std::uint64_t hash(std::uint64_t seed, std::int64_t frame, Stream stream) {
    return mix(mix(mix(seed) ^ static_cast<std::uint64_t>(frame)) ^ static_cast<std::uint64_t>(stream));
}

// The upper 53 bits, centred in their steps.
double to_uniform(std::uint64_t bits) {
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

double uniform_at(std::uint64_t seed, std::int64_t frame, Stream stream) {
    return to_uniform(hash(seed, frame, stream));
}

double normal_at(std::uint64_t seed, std::int64_t frame, Stream stream) {
    const std::uint64_t bits = hash(seed, frame, stream);
    const double radius = std::sqrt(-2 * std::log(to_uniform(bits)));
    return radius * std::cos(2 * std::numbers::pi * to_uniform(mix(bits)));
}

}  // namespace sfsm::simulate
