#include "pointsample/points_pack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pointsample {
namespace {

constexpr double steps = model::unorm_steps;
constexpr int weight_steps = 255;

}  // namespace

float unpack_between(std::uint16_t code, float min, float max) {
    return static_cast<float>((static_cast<double>(min) * (steps - code) + static_cast<double>(max) * code) / steps);
}

std::uint16_t pack_between(float value, float min, float max) {
    const double size = static_cast<double>(max) - static_cast<double>(min);
    if (!(size > 0)) return 0;
    const std::uint16_t nearest = model::pack_unorm((static_cast<double>(value) - static_cast<double>(min)) / size);
    // Where floats are as coarse as steps, what was unpacked from a code may be nearer to its neighbour.
    for (const int step : {0, -1, 1}) {
        const int code = nearest + step;
        if (code < 0 || code > static_cast<int>(model::unorm_steps)) continue;
        if (unpack_between(static_cast<std::uint16_t>(code), min, max) == value)
            return static_cast<std::uint16_t>(code);
    }
    return nearest;
}

// Below the equator the octahedron is folded: there a coordinate that is almost 0 has two codes, one of either sign.
motion::OctahedralNormal pack_normal(const glm::vec3& normal) {
    const motion::OctahedralNormal packed = motion::pack_normal(normal);
    for (const int u : {packed.u, static_cast<std::int8_t>(-packed.u)}) {
        for (const int v : {packed.v, static_cast<std::int8_t>(-packed.v)}) {
            const motion::OctahedralNormal code{static_cast<std::int8_t>(u), static_cast<std::int8_t>(v)};
            if (motion::unpack_normal(code) == normal) return code;
        }
    }
    return packed;
}

std::array<std::uint16_t, 2> pack_barycentrics(float u, float v) {
    const double us = std::clamp(static_cast<double>(u), 0.0, 1.0) * steps;
    const double vs = std::clamp(static_cast<double>(v), 0.0, 1.0) * steps;
    const long first = std::lround(us), second = std::lround(vs);
    // Two halves rounded up.
    const long over = std::max(0L, first + second - static_cast<long>(model::unorm_steps));
    const bool at_first = static_cast<double>(first) - us > static_cast<double>(second) - vs;
    const long lower = std::min(over, at_first ? first : second);
    return {static_cast<std::uint16_t>(first - (at_first ? lower : 0)),
            static_cast<std::uint16_t>(second - (at_first ? 0 : lower))};
}

glm::vec2 unpack_barycentrics(const std::array<std::uint16_t, 2>& codes) {
    const float u = static_cast<float>(codes[0] / steps), v = static_cast<float>(codes[1] / steps);
    return {u, std::min(v, 1.0f - u)};
}

std::array<std::uint8_t, 4> pack_weights(const glm::vec4& weights) {
    std::array<double, 4> shares{};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const double weight = weights[i] > 0.0f && std::isfinite(weights[i]) ? static_cast<double>(weights[i]) : 0.0;
        shares[static_cast<std::size_t>(i)] = weight;
        sum += weight;
    }
    if (!(sum > 0)) return {weight_steps, 0, 0, 0};
    std::array<std::uint8_t, 4> codes{};
    int left = weight_steps;
    for (std::size_t i = 0; i < 4; ++i) {
        shares[i] *= weight_steps / sum;
        codes[i] = static_cast<std::uint8_t>(std::min(std::floor(shares[i]), static_cast<double>(left)));
        left -= codes[i];
        shares[i] -= codes[i];
    }
    for (; left > 0; --left) {  // to the largest remainders, one each: fewer than four are left
        const auto largest = static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
        ++codes[largest];
        shares[largest] -= 1;
    }
    return codes;
}

glm::vec4 unpack_weights(const std::array<std::uint8_t, 4>& codes) {
    return glm::vec4(codes[0], codes[1], codes[2], codes[3]) / static_cast<float>(weight_steps);
}

}  // namespace pointsample
