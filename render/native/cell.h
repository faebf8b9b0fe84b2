// A square of the picture while it is painted: samples block by block, so that what is near on the screen is near in
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/native/picture.h"

namespace render::native {

inline constexpr int block_pixels = block_side * block_side;
inline constexpr int cell_blocks = tile_side / block_side;  // along either side

// What a sample shows, as 32 bits: a finished colour, 255 in its highest byte; or `sky`; or `ground` + the number of a
// triangle of the ground.
inline constexpr std::uint32_t finished = 0xff000000u, ground_surface = 1, sky_surface = 0;

// One surface that fills a block: its reversed depth at the block's top left corner, and what that grows by a pixel.
struct Sheet {
    float depth = 0, depth_x = 0, depth_y = 0;
    std::uint32_t surface = sky_surface;

    // x, y: [px] from the corner. In this order wherever a depth is found, for the same bits.
    float at(float x, float y) const { return (depth + depth_y * y) + depth_x * x; }
};

template <int samples>
struct Cell {
    int x0 = 0, y0 = 0;                     // [px] of the picture
    int first_column = 0, last_column = 0;  // blocks that are painted, inclusive
    int first_row = 0, last_row = 0;
    // [block][sample][pixel]; of blocks that aren't sheets.
    alignas(64) std::array<float, std::size_t{samples} * tile_side * tile_side> depth;
    alignas(64) std::array<std::uint32_t, std::size_t{samples} * tile_side * tile_side> surface;
    std::array<Sheet, std::size_t{cell_blocks} * cell_blocks> sheet;
    std::array<bool, std::size_t{cell_blocks} * cell_blocks> is_sheet;
    std::array<float, std::size_t{cell_blocks} * cell_blocks> farthest;      // of a block's samples; at least
    std::array<std::uint8_t, std::size_t{cell_blocks} * cell_blocks> draws;  // since `farthest` was exact

    static std::size_t block(int column, int row) { return static_cast<std::size_t>(row) * cell_blocks + column; }
    float* depths(std::size_t block) { return &depth[block * samples * block_pixels]; }
    std::uint32_t* surfaces(std::size_t block) { return &surface[block * samples * block_pixels]; }
};

}  // namespace render::native
