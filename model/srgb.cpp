#include "model/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace model {
namespace {

float decode(double code) {
    return static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
}

struct Tables {
    std::array<float, 256> linear;
    std::array<float, 255> border;  // between code i and i + 1: half-way in code
    Tables() {
        for (int i = 0; i < 256; ++i) linear[static_cast<std::size_t>(i)] = decode(i / 255.0);
        for (int i = 0; i < 255; ++i) border[static_cast<std::size_t>(i)] = decode((i + 0.5) / 255.0);
    }
};

const Tables& tables() {
    static const Tables tables;
    return tables;
}

}  // namespace

float linear_of_srgb(std::uint8_t byte) {
    return tables().linear[byte];
}

std::uint8_t srgb_of_linear(float linear) {
    if (!(linear > 0.0f)) return 0;
    const auto& border = tables().border;
    return static_cast<std::uint8_t>(std::upper_bound(border.begin(), border.end(), linear) - border.begin());
}

std::uint8_t unit_byte(float value) {
    return value > 0.0f ? static_cast<std::uint8_t>(std::lround(255.0f * std::min(value, 1.0f))) : std::uint8_t{0};
}

}  // namespace model
