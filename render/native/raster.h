// Which samples triangles cover, and which of them is nearest.
#pragma once

#include <cstdint>
#include <span>

#include "render/native/cell.h"
#include "render/native/triangles_on_screen.h"

namespace render::native {

// Empties the cell's blocks for a picture of this size: sky, infinitely far. Pixels beyond the picture's right and
// lower edge are infinitely near and finished.
void clear(Cell<1>& cell, int width, int height);
void clear(Cell<4>& cell, int width, int height);

// Those of `triangles` that `chosen` lists, in its order; at equal depths the first stays. `surface_offset` is added to
// every triangle's surface. A sample is covered if it is inside, or on an upper or left edge.
void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell<1>& cell);
void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell<4>& cell);

// Writes out all blocks that are sheets, and makes the farthest depths of all blocks exact.
void finish(Cell<1>& cell);

}  // namespace render::native
