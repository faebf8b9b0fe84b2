// People laid down front to back on one tile, in cells of the grid that their patches are of: pixels where S is 1 or
// less, and else squares of S pixels, whose light is stretched over the pixels only when all are laid (cover.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/native/cell_plane.h"
#include "render/native/near_layer.h"
#include "render/native/splat.h"

namespace render::native {

// Linear red, green, blue of what covers a cell, and how much of it is covered: cover_full = all.
struct Cover {
    std::uint16_t red, green, blue, share;
};
inline constexpr std::uint16_t cover_full = 16384;  // up to twice fits
// Who lays something where no more is open than this can't be seen.
inline constexpr std::int16_t closed = cover_full / 4096;

// People beside one another, who so share a cell instead of hiding one another: how much of it was open before them,
// and the depth of the first of them (SplatPerson::depth_code).
struct Flock {
    std::uint16_t open = cover_full, depth = 0;
    std::uint16_t padding[2] = {};
};

// Which groups of group_cells of a row can still be seen through, a bit each. The last one's beyond `count` count too.
std::uint64_t open_groups(const Cover* cover, int count);

// One a thread.
class CoverCells {
public:
    // View depths [m] that hide people behind them, and that they must be behind.
    struct Limits {
        const CellPlane<float>* hidden_behind;
        const CellPlane<float>* shown_behind = nullptr;  // null: nowhere
    };

    // Forgets: all of a tile's cells are open, at most CellPlane's most_cells either way. `keeps_depths`: nearness()
    // will be asked for.
    void begin(const Rect& cells, bool keeps_depths);
    // What isn't empty any more, within the tile's cells.
    const Rect& touched() const { return touched_; }

    // The part of the tile's cells within these that holds all on which something can still be seen; empty: none.
    Rect open_part(const Rect& cells) const;

    // Lays a patch behind what is there, between the limits, and leaves it all 0.
    void lay(const InDepth& people, const Patch& patch, const Limits& limits);
    // Nothing is seen there any more, and nothing was.
    void close(int column, int row) { cover_.at(column, row)->share = cover_full; }

    // From the first cell on.
    Cover* cover(int row) { return cover_.at(0, row); }
    const Cover* cover(int row) const { return cover_.at(0, row); }
    // The sum over what is laid there of its share, times near_plane / view depth.
    const float* nearness(int row) const { return nearness_.at(0, row); }

private:
    Rect cells_, touched_;
    bool keeps_depths_ = false;
    CellPlane<Cover> cover_;
    CellPlane<Flock> flocks_;
    CellPlane<float> nearness_;
};

}  // namespace render::native
