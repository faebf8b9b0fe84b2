#include "render/native/tile_lists.h"

#include <algorithm>

namespace render::native {

TileGrid::TileGrid(int picture_width, int picture_height)
    : width(picture_width),
      height(picture_height),
      columns((picture_width + tile_side - 1) / tile_side),
      rows((picture_height + tile_side - 1) / tile_side) {}

Tile TileGrid::tile(std::size_t index) const {
    const int x0 = static_cast<int>(index) % columns * tile_side, y0 = static_cast<int>(index) / columns * tile_side;
    return {x0, y0, std::min(x0 + tile_side, width), std::min(y0 + tile_side, height)};
}

void TileLists::fill(const TileGrid& grid, std::span<const Rect> bounds) {
    fill(grid, bounds, bounds.size(), [](std::size_t i) { return static_cast<std::uint32_t>(i); });
}

void TileLists::fill(const TileGrid& grid, std::span<const Rect> bounds, std::span<const std::uint32_t> order) {
    fill(grid, bounds, order.size(), [order](std::size_t i) { return order[i]; });
}

// Counting sort; within a tile people stay in their order.
template <typename Number>
void TileLists::fill(const TileGrid& grid, std::span<const Rect> bounds, std::size_t count, Number number) {
    const auto for_each_tile = [&](const Rect& rect, auto visit) {
        const int x0 = std::max(rect.x0, 0), x1 = std::min(rect.x1, grid.width);
        const int y0 = std::max(rect.y0, 0), y1 = std::min(rect.y1, grid.height);
        if (x0 >= x1 || y0 >= y1) return;
        for (int y = y0 / tile_side; y <= (y1 - 1) / tile_side; ++y)
            for (int x = x0 / tile_side; x <= (x1 - 1) / tile_side; ++x) visit(y * grid.columns + x);
    };
    begin_.assign(grid.count() + 1, 0);
    for (const Rect& rect : bounds) for_each_tile(rect, [&](int tile) { ++begin_[tile]; });
    std::uint32_t total = 0;
    for (std::uint32_t& begin : begin_) total += begin, begin = total;
    people_.resize(total);
    // From the last on, each beginning moves down to where it is.
    for (std::size_t i = count; i > 0; --i)
        for_each_tile(bounds[number(i - 1)], [&](int tile) { people_[--begin_[tile]] = number(i - 1); });
}

}  // namespace render::native
