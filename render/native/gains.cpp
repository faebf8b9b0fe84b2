#include "render/native/gains.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace render::native {

namespace {

constexpr int trials = 96;
constexpr float most_gain = 3.0f;

double covered(const std::vector<Gains::Trial>& all, double gain) {
    double sum = 0;
    for (const Gains::Trial& trial : all)
        for (const float coverage : trial.coverage) sum += std::min(1.0, gain * static_cast<double>(coverage));
    return sum;
}

// By bisection: what is covered rises with it.
float solve(const std::vector<Gains::Trial>& all) {
    double silhouettes = 0;
    for (const Gains::Trial& trial : all) silhouettes += trial.silhouette;
    double low = 1.0, high = most_gain;
    for (int i = 0; i < 16; ++i) {
        const double middle = 0.5 * (low + high);
        (covered(all, middle) < silhouettes ? low : high) = middle;
    }
    return static_cast<float>(high);
}

// Where `value` is among `count` octaves: the one below, and the share of the next.
struct Between {
    int below;
    float share;
};

// The bits of a positive float are its logarithm to the base 2, a straight line in each octave.
Between among_octaves(float value, float first, int count) {
    constexpr int mantissa_bits = 23;
    const auto bits = static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(value)) -
                      static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(first));
    const std::int32_t clamped = std::clamp(bits, 0, ((count - 1) << mantissa_bits) - 1);
    const int below = clamped >> mantissa_bits;
    return {below, static_cast<float>(clamped - (below << mantissa_bits)) / (1 << mantissa_bits)};
}

float between(float a, float b, float share) {
    return a + share * (b - a);
}

}  // namespace

void Gains::measure(const std::function<Trial(float, float, int)>& draw, float most_alike) {
    for (int size = 0; size < sizes; ++size) {
        const float cells = first_size * std::exp2(static_cast<float>(size));
        for (int density = 0; density < densities; ++density) {
            const float alike = first_density * std::exp2(static_cast<float>(density)) * cells;
            if (density > 0 && alike >= 2 * most_alike) {
                gains_[size][density] = gains_[size][density - 1];  // nobody is drawn so
                continue;
            }
            std::vector<Trial> all;
            for (int trial = 0; trial < trials; ++trial) all.push_back(draw(cells, std::min(alike, most_alike), trial));
            gains_[size][density] = solve(all);
        }
    }
    is_measured_ = true;
}

float Gains::at(float cells, float alike) const {
    if (!is_measured_) return 1.0f;
    const Between size = among_octaves(cells, first_size, sizes);
    const Between density = among_octaves(alike / cells, first_density, densities);
    const auto along = [&](int row) {
        return between(gains_[row][density.below], gains_[row][density.below + 1], density.share);
    };
    return between(along(size.below), along(size.below + 1), size.share);
}

}  // namespace render::native
