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

// N / sqrt(chi^2 / 3) has the deviation sqrt(3). A chi^2 of 3 is the sum of one of 2, which is exponential, and of one
// of 1.
double heavy_tailed_at(std::uint64_t seed, std::int64_t frame, Stream stream) {
    const double normal = normal_at(seed, frame, Stream::chi);
    const double chi2 = normal * normal - 2 * std::log(uniform_at(~seed, frame, Stream::chi));
    return normal_at(seed, frame, stream) / std::sqrt(chi2);
}

double correlated_normal_at(std::uint64_t seed, std::int64_t frame, Stream stream, double correlation) {
    constexpr double least_weight = 1e-3;
    if (correlation <= 0) return normal_at(seed, frame, stream);
    double sum = 0, weight = 1, squares = 0;
    for (; weight > least_weight; weight *= correlation, --frame) {
        sum += weight * (uniform_at(seed, frame, stream) - 0.5);
        squares += weight * weight;
    }
    return sum * std::sqrt(12 / squares);
}

}  // namespace sfsm::simulate
