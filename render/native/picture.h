// What the native way of drawing draws into: a picture in memory, and the tiles that threads share out among them.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <cstdint>

namespace render::native {

// Rows begin at multiples of this many pixels, so that no vector of pixels ever crosses from one row into the next.
inline constexpr int row_alignment = 64;

// Pixels in rows from the top. What lies to the right of `width` is padding: it may be written, and nobody sees it.
template <typename Pixel>
class Plane {
public:
    Plane() = default;
    Plane(int width, int height)
        : stride_((width + row_alignment - 1) / row_alignment * row_alignment),
          pixels_(hwy::AllocateAligned<Pixel>(static_cast<std::size_t>(stride_) * height)) {}

    Pixel* row(int y) { return pixels_.get() + static_cast<std::ptrdiff_t>(stride_) * y; }
    const Pixel* row(int y) const { return pixels_.get() + static_cast<std::ptrdiff_t>(stride_) * y; }
    int stride() const { return stride_; }  // [pixels]

private:
    int stride_ = 0;
    hwy::AlignedFreeUniquePtr<Pixel[]> pixels_;
};

// What lies behind the people.
struct BackdropPicture {
    int width = 0, height = 0;   // [px]
    Plane<std::uint32_t> color;  // red, green, blue in bytes 0, 1, 2: the square root of linear light; byte 3 is 255
    Plane<float> depth;          // near_plane / view depth: 0 is infinitely far, larger is nearer
    Plane<float> farthest;       // the least depth of each block of pixels: what is farther is hidden in all of it
    Plane<float> error;          // expected mean FLIP of each block of which is_judged()
};

// Blocks of block_side x block_side pixels, from the picture's top left corner; what sticks out of the picture counts
// not.
inline constexpr int block_side = 8;
// Some of the blocks, evenly spread, stand for all where their error is expected.
constexpr bool is_judged(int column, int row) {
    return (column + 3 * row) % 8 == 0;
}
constexpr int blocks_across(int pixels) {
    return (pixels + block_side - 1) / block_side;
}

// A part of the picture that one thread draws: pixels [x0, x1) x [y0, y1).
struct Tile {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
inline constexpr int tile_side = 128;  // [px]; a multiple of row_alignment

}  // namespace render::native
