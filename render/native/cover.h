// What people leave of a tile's pixels: light and coverage, laid down front to back.
#pragma once

#include <cstdint>
#include <vector>

#include "render/native/near_layer.h"
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

// Which part of a person is laid where there is a near layer.
enum class Layers {
    all,          // there is none
    before_near,  // what isn't behind it
    behind_near,  // what is
};

// One a thread: everything of a tile that isn't in the picture yet.
class CoverTile {
public:
    CoverTile();

    // Forgets. `behind` is read until resolve().
    void begin(const Tile& tile, const BackdropPicture& behind);
    const Tile& tile() const { return tile_; }

    // The part of the tile's pixels within these that holds all on which something can still be seen; empty: none.
    Rect open_part(const Rect& pixels) const;

    // Lays a patch behind what is there, where it is nearer than the backdrop, and leaves it all 0. `near`: the tile's,
    // needed if it isn't all that is laid.
    void lay(const SplatPerson& person, const Patch& patch, const NearLayer* near, Layers layers);
    // Lays a resolved layer of the tile behind what is there.
    void lay(const NearLayer& near);

    // Puts the tile into the picture: the backdrop shows through where nobody covers it.
    void resolve(Plane<std::uint32_t>& out);

private:
    // What is laid beyond the tile: rows above and below, groups of cells left and right.
    static constexpr int margin_rows = 3;
    static constexpr int stride = tile_side + 3 * group_cells;
    std::size_t index_of(int x, int y) const {
        return static_cast<std::size_t>(y - tile_.y0 + margin_rows) * stride + (x - tile_.x0 + group_cells);
    }
    void lay_row(const SplatPerson& person, std::int16_t* cells, std::uint64_t used, Tile part, const NearLayer* near,
                 Layers layers);
    void lay_stretched(const SplatPerson& person, const Patch& patch, const NearLayer* near, Layers layers);
    const float* find_limits(const NearLayer& near, int y, bool with_backdrop);

    Tile tile_;
    const BackdropPicture* behind_ = nullptr;
    std::vector<Cover> cover_;
    std::vector<Flock> flocks_;
    Array<std::int16_t> line_;       // a row of cells, all 0 between two rows
    Array<std::int16_t> stretched_;  // a row of pixels of a stretched patch
    std::vector<float> limits_;      // a row of depths
};

}  // namespace render::native
