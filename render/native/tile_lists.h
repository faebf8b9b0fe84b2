// Which people each tile has, in the order in which they come.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/native/near_layer.h"
#include "render/native/picture.h"

namespace render::native {

struct TileGrid {
    int width = 0, height = 0;  // [px] of the picture
    int columns = 0, rows = 0;

    TileGrid() = default;
    TileGrid(int picture_width, int picture_height);
    std::size_t count() const { return static_cast<std::size_t>(columns) * rows; }
    Tile tile(std::size_t index) const;
};

// Reused: allocates until it has seen the most people.
class TileLists {
public:
    // `bounds`: pixels that each may touch, anywhere; one that is empty or outside of the picture is in no tile.
    void fill(const TileGrid& grid, std::span<const Rect> bounds);
    // In the order of these numbers.
    void fill(const TileGrid& grid, std::span<const Rect> bounds, std::span<const std::uint32_t> order);

    std::span<const std::uint32_t> of(std::size_t tile) const {
        return {people_.data() + begin_[tile], begin_[tile + 1] - begin_[tile]};
    }

private:
    template <typename Number>
    void fill(const TileGrid& grid, std::span<const Rect> bounds, std::size_t count, Number number);

    std::vector<std::uint32_t> begin_;   // per tile, then the total
    std::vector<std::uint32_t> people_;  // numbers, tile after tile
};

}  // namespace render::native
