// A number, or more, for each cell of a tile.
#pragma once

#include <algorithm>
#include <cstddef>

#include "render/native/array.h"
#include "render/native/picture.h"
#include "render/native/splat.h"

namespace render::native {

// Around the tile's cells is a margin that patches may stick out into.
template <typename T>
class CellPlane {
public:
    static constexpr int most_cells = tile_side + 3;  // across: where they are hardly larger than pixels
    static constexpr int margin = 2, margin_right = 2 * group_cells;  // to the right patches go on in whole groups
    static constexpr int stride = (margin + most_cells + margin_right + 15) / 16 * 16;

    CellPlane() : cells_(static_cast<std::size_t>(stride) * (most_cells + 2 * margin)) {}

    T* at(int column, int row) { return &cells_[index_of(column, row)]; }
    const T* at(int column, int row) const { return &cells_[index_of(column, row)]; }

    // Of a tile of so many cells.
    void fill(int columns, int rows, T inside, T outside) {
        for (int row = -margin; row < rows + margin; ++row) {
            T* first = at(0, row);
            const bool is_inside = row >= 0 && row < rows;
            std::fill(first - margin, first, outside);
            std::fill(first, first + columns, is_inside ? inside : outside);
            std::fill(first + columns, first + columns + margin_right, outside);
        }
    }

private:
    static std::size_t index_of(int column, int row) {
        return static_cast<std::size_t>((row + margin) * stride + column + margin);
    }

    Array<T> cells_;
};

}  // namespace render::native
