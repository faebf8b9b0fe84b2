// Cells of a tile where they are larger than pixels, or as large. Cell i is [i, i + 1) sides from the picture's left or
// top; a pixel takes from the two cells, either way, between whose middles its own middle is.
#pragma once

#include <cmath>

#include "render/native/near_layer.h"
#include "render/native/picture.h"

namespace render::native {

// Cells or pixels [first, end).
struct Span {
    int first, end;
};

// Which pixels take from a cell; `side` [px] of it.
inline Span pixels_of(int cell, float side) {
    const float middle = static_cast<float>(cell) + 0.5f;
    return {static_cast<int>(std::floor((middle - 1.0f) * side - 0.5f)) + 1,
            static_cast<int>(std::ceil((middle + 1.0f) * side - 0.5f))};
}

// All that take from some cells.
inline Rect pixels_of(const Rect& cells, float side) {
    if (side == 1.0f || cells.empty()) return cells;
    return {pixels_of(cells.x0, side).first, pixels_of(cells.y0, side).first, pixels_of(cells.x1 - 1, side).end,
            pixels_of(cells.y1 - 1, side).end};
}

struct CellGrid {
    Tile tile;
    float side = 1.0f;  // [px] >= 1
    Rect cells;         // all that the tile's pixels take from

    CellGrid() = default;
    CellGrid(const Tile& of, float cell_side) : tile(of), side(cell_side) {
        const Span columns = cells_of(tile.x0, tile.x1), rows = cells_of(tile.y0, tile.y1);
        cells = {columns.first, rows.first, columns.end, rows.end};
    }

    bool is_coarse() const { return side > 1.0f; }
    // Where a pixel's middle is among the middles of cells.
    float at(int pixel) const { return (static_cast<float>(pixel) + 0.5f) / side - 0.5f; }
    Span pixels_of(int cell) const { return native::pixels_of(cell, side); }

private:
    Span cells_of(int first, int end) const {
        if (!is_coarse()) return {first, end};
        return {static_cast<int>(std::floor(at(first))), static_cast<int>(std::floor(at(end - 1))) + 2};
    }
};

}  // namespace render::native
