// How far away people are seen in each cell of a tile, for what is behind them and for a near layer among them.
#pragma once

#include "render/native/array.h"
#include "render/native/cell_grid.h"
#include "render/native/cell_plane.h"

namespace render::native {

// One a thread.
class CellLimits {
public:
    // `near`: null if there is none.
    void find(const CellGrid& grid, const BackdropPicture& behind, const NearLayer* near);

    // [m] Who is farther is hidden in all pixels that take from the cell: by the backdrop, or by it or the near layer.
    const CellPlane<float>& backdrop() const { return backdrop_; }
    const CellPlane<float>& before_near() const { return before_near_; }
    // [m] Who is nearer is before the near layer, or beside it. Of fine cells only: coarse ones hold both.
    const CellPlane<float>& behind_near() const { return behind_near_; }

private:
    void find_fine(const CellGrid& grid, const BackdropPicture& behind, const NearLayer* near);
    void find_coarse(const CellGrid& grid, const BackdropPicture& behind, const NearLayer* near);

    CellPlane<float> backdrop_, before_near_, behind_near_;
    // Of a row of pixels around the tile, near_plane / view depth: what is least among some rows.
    Array<float> farthest_, farthest_with_near_, with_near_;
};

}  // namespace render::native
