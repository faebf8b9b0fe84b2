// A few points of a character as one of its poses has them: structure of arrays.
#pragma once

#include <array>
#include <cstdint>

namespace render::native {

inline constexpr int chunk_points = 32;
inline constexpr int own_light_values = 4;  // of a point that may shine (splat_model.h)

struct alignas(64) PosedChunk {
    std::array<std::array<std::int16_t, chunk_points>, 3>
        position;                                                 // by axis, -32768 to 32767 over the character's box
    std::array<std::array<std::int8_t, chunk_points>, 3> normal;  // 127 = 1
    std::array<std::array<std::int8_t, chunk_points>, 3> facet;   // facets.h; 64 = 1
};

}  // namespace render::native
