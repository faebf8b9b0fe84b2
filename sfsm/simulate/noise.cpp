#include "sfsm/simulate/noise.h"

#include <cmath>
#include <numbers>

#include "sfsm/random.h"

namespace sfsm::simulate {
namespace {

std::uint64_t bits_of(std::uint64_t seed, std::int64_t frame, Stream stream) {
    return mix(hash(seed, static_cast<std::uint64_t>(frame)) ^ static_cast<std::uint64_t>(stream));
}

// The upper 53 bits, centred in their steps.
double to_uniform(std::uint64_t bits) {
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

double uniform_at(std::uint64_t seed, std::int64_t frame, Stream stream) {
    return to_uniform(bits_of(seed, frame, stream));
}

double normal_at(std::uint64_t seed, std::int64_t frame, Stream stream) {
    const std::uint64_t bits = bits_of(seed, frame, stream);
    const double radius = std::sqrt(-2 * std::log(to_uniform(bits)));
    return radius * std::cos(2 * std::numbers::pi * to_uniform(mix(bits)));
}

}  // namespace sfsm::simulate
