// One tile's people drawn as triangles: four samples a pixel with a depth each, and the pixels that they make.
#pragma once

#include <hwy/aligned_allocator.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/native/picture.h"

namespace render::native {

// Pixels [x0, x1) x [y0, y1).
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

inline constexpr int samples_across = 2;       // a pixel has as many samples across, and down, evenly spaced
inline constexpr int sample_block_pixels = 2;  // a block is so many pixels wide and high,
inline constexpr int sample_block_side = samples_across * sample_block_pixels;  // and so many samples:
inline constexpr int block_samples = sample_block_side * sample_block_side;
inline constexpr float full = 32767;  // a colour or coverage of 1

// Sample i is number i / 4 in its pixel and of pixel i % 4 in its block, both row by row: what a pixel is the mean of
// lies four apart, which adds up without shuffles.
constexpr int sample_x(int i) {
    return samples_across * (i & 1) + (i >> 2 & 1);
}
constexpr int sample_y(int i) {
    return samples_across * (i >> 1 & 1) + (i >> 3);
}

// A block's samples in a layer, each array at a multiple of 64 bytes.
struct Block {
    float* depth;              // near_plane / view depth of what is nearest, the backdrop's at first
    float* farthest;           // the least of depth: who changes one keeps up the other
    std::uint32_t* red_green;  // linear, `full` is 1: red in the low half
    std::uint32_t* blue;
};

// One per thread, reused: allocates once.
class NearLayer {
public:
    NearLayer();

    // Forgets. `tile` begins at even pixels and is at most tile_side wide and high. `behind` is read until resolve().
    void begin(const Tile& tile, const BackdropPicture& behind);
    // After the last block was drawn into: box-filters the samples, in linear light.
    void resolve();

    // After resolve(). Rows of pixels from the tile's first column on, valid inside touched() only; `y` is the
    // picture's. Four values a pixel: red, green, blue, linear and premultiplied, and coverage; 32767 is 1, and exact.
    const std::uint16_t* rgba(int y) const { return rgba_.get() + 4 * row_start(y); }
    // near_plane / view depth of the nearest covered sample; 0: none.
    const float* depth(int y) const { return depth_.get() + row_start(y); }
    // Makes a row of near_plane / view depth, from the tile's first column on, no less than the layer's.
    void raise(int y, float* nearness) const;
    // Pixels of the picture that may be covered; empty if nobody was drawn.
    Rect touched() const { return touched_; }
    bool touches_row(int y) const { return y >= touched_.y0 && y < touched_.y1; }

    // For who draws. Blocks of the picture that are the tile's.
    Rect blocks() const { return blocks_; }
    // Counted from the tile's first; begins at the backdrop's depth.
    Block block(int column, int row) {
        const std::size_t number = number_of(column, row), first = number * block_samples;
        const Block block{sample_depth_.get() + first, &farthest_[number], red_green_.get() + first,
                          blue_.get() + first};
        const std::uint64_t bit = std::uint64_t{1} << column;
        if ((begun_[row] & bit) == 0) [[unlikely]] {
            begun_[row] |= bit;
            begin_block(block, column, row);
        }
        return block;
    }

    // That block's farthest, and those of blocks to the right and below, in rows of farthest_stride; negative: nothing
    // was drawn into it yet. A row can be read sixteen
    // blocks and a square of four by four blocks beyond the tile's.
    const float* farthest(int column, int row) const { return &farthest_[number_of(column, row)]; }
    static constexpr int farthest_stride = tile_side / sample_block_pixels;

private:
    static constexpr int blocks_across = tile_side / sample_block_pixels;
    static_assert(blocks_across <= 64);  // a bit each

    static std::size_t number_of(int column, int row) { return static_cast<std::size_t>(blocks_across * row + column); }
    std::ptrdiff_t row_start(int y) const { return std::ptrdiff_t{tile_side} * (y - tile_.y0); }
    void begin_block(const Block& block, int column, int row) const;
    // The backdrop's depths; `last` can be read, and what is beyond it not.
    struct RowsBehind {
        const float *upper, *lower;
        int last;
    };
    RowsBehind rows_behind(int row) const;
    Rect begun_blocks() const;  // within the tile

    Tile tile_;
    const BackdropPicture* behind_ = nullptr;
    Rect blocks_, touched_;
    std::array<std::uint64_t, blocks_across> begun_{};  // a row of blocks each
    // Of each block: all that hidden triangles look at.
    std::array<float, blocks_across*(blocks_across + 3) + 16> farthest_{};
    // Of samples, block by block. Apart, since most of what is drawn is hidden and looks no further than depths.
    hwy::AlignedFreeUniquePtr<float[]> sample_depth_;
    hwy::AlignedFreeUniquePtr<std::uint32_t[]> red_green_, blue_;
    hwy::AlignedFreeUniquePtr<std::uint16_t[]> rgba_;
    hwy::AlignedFreeUniquePtr<float[]> depth_;
};

}  // namespace render::native
