// What people leave of a tile's pixels: light and coverage, laid down front to back.
#pragma once

#include <array>
#include <cstdint>

#include "render/native/cell_grid.h"
#include "render/native/cell_limits.h"
#include "render/native/contact_tile.h"
#include "render/native/cover_cells.h"
#include "render/native/near_layer.h"
#include "render/native/picture.h"
#include "render/native/splat.h"

namespace render::native {

// Which part of a person is laid where there is a near layer.
enum class Layers {
    all,          // there is none
    before_near,  // what isn't behind it
    behind_near,  // what is
};

// Where a tile's columns of pixels are among its columns of cells: from one to the next, which gets a share.
struct CellColumns {
    alignas(64) std::array<std::int32_t, tile_side> cell;
    alignas(64) std::array<float, tile_side> share;
    alignas(64) std::array<std::int16_t, 4 * tile_side> lanes;  // that share, for each lane of a Cover: 32767 = 1
};

// One a thread: everything of a tile that isn't in the picture yet.
class CoverTile {
public:
    CoverTile();

    // Forgets. `cell` >= 1 [px]: the side of every patch's cells. `near`: a layer of people to be laid in between, or
    // null. Both it and `behind` are read until resolve().
    void begin(const Tile& tile, const BackdropPicture& behind, float cell, const NearLayer* near);

    // The part of these cells that holds all on which something can still be seen; empty: none.
    Rect open_part(const Rect& cells) const { return cells_.open_part(cells); }

    // Lays a patch behind what is there, where it is nearer than the backdrop, and leaves it all 0.
    void lay(const InDepth& people, const Patch& patch, Layers layers);
    // Lays the near layer behind what is there, once.
    void lay_near();

    // Puts the tile into the picture: where nobody covers them, the colours of what is behind show through.
    void resolve(const TileColors& colors, Plane<std::uint32_t>& out);

private:
    void find_columns();
    void stretch_row(int y, const float* nearness);
    void lay_near_row(int y, Cover* to) const;
    void lay_near_on_pixels();
    void close_full_cells();
    const Cover* pixel_row(int y);
    Cover* row_of(Array<Cover>& pixels, int y) {
        return &pixels[static_cast<std::size_t>(tile_side) * (y - grid_.tile.y0)];
    }

    CellGrid grid_;
    const BackdropPicture* behind_ = nullptr;
    const NearLayer* near_ = nullptr;
    CoverCells cells_;
    CellLimits limits_;
    bool has_limits_ = false;  // they are found when somebody is laid
    CellColumns columns_;
    // Of coarse cells, once the near layer is laid: pixels of what is before it, and of that and the layer. The cells
    // begin anew then, with everybody, so that what is before it can be told from the rest.
    Array<Cover> before_, kept_;
    Array<Cover> row_;   // of pixels
    Array<Cover> line_;  // of cells
    Array<float> share_line_, nearness_line_, with_near_;
    bool is_near_laid_ = false;
};

}  // namespace render::native
