// A tile's backdrop with the shade around people's feet (render/contact_shade.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/contact_shade.h"
#include "render/native/array.h"
#include "render/native/near_layer.h"
#include "render/native/picture.h"
#include "render/view.h"

namespace render::native {

// Pixels that it may touch; empty: it is not before the camera.
Rect bounds_of(const View& view, const ContactShade& shade);

// Colours of a tile's pixels, as a picture's.
struct TileColors {
    const std::uint32_t* first;
    std::ptrdiff_t stride;                                                // [pixels]
    const std::uint32_t* row(int y) const { return first + stride * y; }  // from the tile's first row on
};

inline TileColors colors_of(const Tile& tile, const BackdropPicture& behind) {
    return {behind.color.row(tile.y0) + tile.x0, behind.color.stride()};
}

// One a thread. The picture that is behind stays as it is, so that it can be kept while people move.
class ContactTile {
public:
    ContactTile();

    // The tile's colours darkened by those of `shades` that `which` names, in that order; `bounds`: of all. A pixel is
    // where its depth is. What is returned holds until the next call.
    TileColors darken(const View& view, const Tile& tile, const BackdropPicture& behind,
                      std::span<const ContactShade> shades, std::span<const Rect> bounds,
                      std::span<const std::uint32_t> which);

private:
    Array<float> left_;
    Array<std::uint32_t> colors_;
};

}  // namespace render::native
