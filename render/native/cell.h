// A square of the picture while it is painted: pixels block by block, so that what is near on the screen is near in
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/native/picture.h"

namespace render::native {

inline constexpr int block_pixels = block_side * block_side;
inline constexpr int cell_blocks = tile_side / block_side;  // along either side

// What a pixel shows, as 32 bits: a finished colour, 255 in its highest byte; or `sky`; or `ground` + the number of a
// triangle of the ground.
inline constexpr std::uint32_t finished = 0xff000000u, ground_surface = 1, sky_surface = 0;

struct Cell {
    int x0 = 0, y0 = 0;                     // [px] of the picture
    int first_column = 0, last_column = 0;  // blocks that are painted, inclusive
    int first_row = 0, last_row = 0;
    alignas(64) std::array<float, std::size_t{tile_side} * tile_side> depth;
    alignas(64) std::array<std::uint32_t, std::size_t{tile_side} * tile_side> surface;
    std::array<float, std::size_t{cell_blocks} * cell_blocks> farthest;      // of a block; at least
    std::array<std::uint8_t, std::size_t{cell_blocks} * cell_blocks> draws;  // since `farthest` was exact

    static std::size_t block(int column, int row) { return static_cast<std::size_t>(row) * cell_blocks + column; }
};

}  // namespace render::native
