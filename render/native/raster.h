// Which pixels triangles cover, and which of them is nearest.
#pragma once

#include <cstdint>
#include <span>

#include "render/native/cell.h"
#include "render/native/triangles_on_screen.h"

namespace render::native {

// Empties the cell's blocks for a picture of this size: sky, infinitely far. Pixels beyond the picture's right and
// lower edge are infinitely near and finished.
void clear(Cell& cell, int width, int height);

// Those of `triangles` that `chosen` lists, in its order; at equal depths the first stays. `surface_offset` is added to
// every triangle's surface. A pixel is covered if its centre is inside, or on an upper or left edge.
void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell& cell);

// Makes the farthest depths of all blocks exact.
void find_farthest(Cell& cell);

}  // namespace render::native
