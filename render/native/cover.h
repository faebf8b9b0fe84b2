// What people leave of a tile's pixels: light and coverage, laid down front to back.
#pragma once

#include <cstdint>
#include <vector>

#include "render/native/picture.h"
#include "render/native/splat.h"

namespace render::native {

// Linear red, green, blue of what covers a pixel, and how much of it is covered: pixel_full = all.
struct Cover {
    std::uint16_t red, green, blue, share;
};

// People beside one another, who so share a pixel instead of hiding one another: how much of it was open before them,
// and the depth of the first of them (SplatPerson::depth_code).
struct Flock {
    std::uint16_t open = pixel_full, depth = 0;
    std::uint16_t padding[2] = {};
};

// One a thread: everything of a tile that isn't in the picture yet.
class CoverTile {
public:
    CoverTile();

    void begin(const Tile& tile);
    const Tile& tile() const { return tile_; }

    // Lays a patch behind what is there, where it is nearer than the backdrop, and leaves it all 0.
    void lay(const SplatPerson& person, const Patch& patch, const BackdropPicture& behind);

    // Puts the tile into the picture: the backdrop shows through where nobody covers it.
    void resolve(const BackdropPicture& behind, Plane<std::uint32_t>& out);

private:
    // A pixel around the tile, and a whole group of cells to the right, take what is laid beyond it.
    static constexpr int stride = tile_side + 2 * group_cells;
    std::size_t index_of(int x, int y) const {
        return static_cast<std::size_t>(y - tile_.y0 + 1) * stride + (x - tile_.x0 + group_cells);
    }

    Tile tile_;
    std::vector<Cover> cover_;
    std::vector<Flock> flocks_;
};

}  // namespace render::native
