// Linear light of colours as they are stored, as the shaders have it: the square of a code.
#pragma once

#include <array>
#include <cstdint>

namespace render::native {

// By code: 32767 = 1.
inline constexpr std::array<std::int16_t, 256> linear_of_code = [] {
    std::array<std::int16_t, 256> table{};
    for (int code = 0; code < 256; ++code) {
        const float share = static_cast<float>(code) / 255.0f;
        table[code] = static_cast<std::int16_t>(share * share * 32767.0f + 0.5f);
    }
    return table;
}();

}  // namespace render::native
