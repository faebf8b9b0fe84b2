#include "render/native/near_layer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#ifndef GRANDSTAND_NATIVE_NEAR_LAYER_ONCE
#define GRANDSTAND_NATIVE_NEAR_LAYER_ONCE

namespace render::native {

// Two rows of pixels, from a row of blocks' first on.
struct PixelRows {
    std::uint16_t* rgba[sample_block_pixels];
    float* depth[sample_block_pixels];
};

}  // namespace render::native

#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/near_layer.cpp"
#include <hwy/foreach_target.h>
// What follows is compiled once for every target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// One lane a pixel of a block.
using Counts = hn::FixedTag<std::uint32_t, 4>;
using Depths = hn::FixedTag<float, 4>;

// `x`: the block's first pixel in the rows. `behind`: depths of the backdrop at its four.
void resolve_block(const Block& block, const float* behind, const PixelRows& to, std::ptrdiff_t x) {
    const Counts counts;
    const Depths depths;
    const hn::Half<Depths> pair;
    constexpr std::uint32_t samples = samples_across * samples_across;
    const auto half = hn::Set(counts, samples / 2);
    const auto low = hn::Set(counts, 0xffffu);
    const auto back = hn::LoadU(depths, behind);
    auto nearest = hn::Zero(depths);
    auto red = half, green = half, blue = half, cover = half;
    for (std::uint32_t s = 0; s < samples; ++s) {
        const auto z = hn::Load(depths, block.depth + 4 * s);
        const auto covered = hn::Gt(z, back);
        nearest = hn::Max(nearest, hn::IfThenElseZero(covered, z));
        blue = hn::Add(blue, hn::Load(counts, block.blue + 4 * s));
        cover = hn::Add(cover, hn::IfThenElseZero(hn::RebindMask(counts, covered),
                                                  hn::Set(counts, static_cast<std::uint32_t>(full))));
    }
    // Halves of 32767 add up twice before they spill over.
    for (std::uint32_t s = 0; s < samples; s += 2) {
        const auto red_green =
            hn::Add(hn::Load(counts, block.red_green + 4 * s), hn::Load(counts, block.red_green + 4 * (s + 1)));
        red = hn::Add(red, hn::And(red_green, low));
        green = hn::Add(green, hn::ShiftRight<16>(red_green));
    }
    const auto quarter = [](auto sum) { return hn::ShiftRight<2>(sum); };
    const auto red_green = hn::Or(quarter(red), hn::ShiftLeft<16>(quarter(green)));
    const auto blue_cover = hn::Or(quarter(blue), hn::ShiftLeft<16>(quarter(cover)));
    const hn::Repartition<std::uint16_t, Counts> values;
    hn::StoreU(hn::BitCast(values, hn::InterleaveLower(counts, red_green, blue_cover)), values, to.rgba[0] + 4 * x);
    hn::StoreU(hn::BitCast(values, hn::InterleaveUpper(counts, red_green, blue_cover)), values, to.rgba[1] + 4 * x);
    hn::StoreU(hn::LowerHalf(pair, nearest), pair, to.depth[0] + x);
    hn::StoreU(hn::UpperHalf(pair, nearest), pair, to.depth[1] + x);
}

// Blocks [first, end) of a row; those whose bit in `begun` is 0 are empty. `block`: the row's first. `upper`, `lower`:
// the backdrop's depths from the row's first pixel on; who reads `last` or more reads `last`.
void resolve_row(Block block, int first, int end, std::uint64_t begun, const float* upper, const float* lower, int last,
                 const PixelRows& to) {
    for (int column = first; column < end; ++column) {
        const std::ptrdiff_t x = std::ptrdiff_t{sample_block_pixels} * column;
        if ((begun >> column & 1) == 0) {
            for (int row = 0; row < sample_block_pixels; ++row) {
                std::memset(to.rgba[row] + 4 * x, 0, 4 * sample_block_pixels * sizeof(std::uint16_t));
                std::memset(to.depth[row] + x, 0, sample_block_pixels * sizeof(float));
            }
            continue;
        }
        const std::ptrdiff_t next = std::min<std::ptrdiff_t>(x + 1, last);
        const float behind[] = {upper[x], upper[next], lower[x], lower[next]};
        const std::ptrdiff_t at = std::ptrdiff_t{block_samples} * column;
        resolve_block({block.depth + at, nullptr, block.red_green + at, block.blue + at}, behind, to, x);
    }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render::native {

HWY_EXPORT(resolve_row);

NearLayer::NearLayer()
    : sample_depth_(hwy::AllocateAligned<float>(std::size_t{blocks_across} * blocks_across * block_samples)),
      red_green_(hwy::AllocateAligned<std::uint32_t>(std::size_t{blocks_across} * blocks_across * block_samples)),
      blue_(hwy::AllocateAligned<std::uint32_t>(std::size_t{blocks_across} * blocks_across * block_samples)),
      rgba_(hwy::AllocateAligned<std::uint16_t>(std::size_t{4} * tile_side * tile_side)),
      depth_(hwy::AllocateAligned<float>(std::size_t{tile_side} * tile_side)) {}

void NearLayer::raise(int y, float* nearness) const {
    if (!touches_row(y)) return;
    for (int x = touched_.x0 - tile_.x0; x < touched_.x1 - tile_.x0; ++x)
        nearness[x] = std::max(nearness[x], depth(y)[x]);
}

void NearLayer::begin(const Tile& tile, const BackdropPicture& behind) {
    assert(tile.x0 % sample_block_pixels == 0 && tile.y0 % sample_block_pixels == 0);
    assert(tile.x1 - tile.x0 <= tile_side && tile.y1 - tile.y0 <= tile_side);
    tile_ = tile;
    behind_ = &behind;
    touched_ = {};
    const auto up = [](int pixels) { return (pixels + sample_block_pixels - 1) / sample_block_pixels; };
    blocks_ = {tile.x0 / sample_block_pixels, tile.y0 / sample_block_pixels, up(tile.x1), up(tile.y1)};
    begun_.fill(0);
    farthest_.fill(-1);
}

// From the tile's first pixel on, at row `y` of its blocks. The last ones may lie outside of the picture, where nobody
// looks.
NearLayer::RowsBehind NearLayer::rows_behind(int row) const {
    const int y0 = tile_.y0 + sample_block_pixels * row, y1 = std::min(y0 + 1, behind_->height - 1);
    return {behind_->depth.row(y0) + tile_.x0, behind_->depth.row(y1) + tile_.x0, behind_->width - 1 - tile_.x0};
}

void NearLayer::begin_block(const Block& block, int column, int row) const {
    const RowsBehind rows = rows_behind(row);
    const int x0 = sample_block_pixels * column, x1 = std::min(x0 + 1, rows.last);
    const float behind[] = {rows.upper[x0], rows.upper[x1], rows.lower[x0], rows.lower[x1]};
    for (int i = 0; i < block_samples; i += 4) std::memcpy(block.depth + i, behind, sizeof behind);
    *block.farthest = std::min(std::min(behind[0], behind[1]), std::min(behind[2], behind[3]));
    std::memset(block.red_green, 0, block_samples * sizeof(std::uint32_t));
    std::memset(block.blue, 0, block_samples * sizeof(std::uint32_t));
}

Rect NearLayer::begun_blocks() const {
    std::uint64_t columns = 0;
    int first = blocks_across, end = 0;
    for (int y = 0; y < blocks_across; ++y) {
        if (begun_[y] == 0) continue;
        columns |= begun_[y];
        first = std::min(first, y);
        end = y + 1;
    }
    if (columns == 0) return {};
    return {std::countr_zero(columns), first, 64 - std::countl_zero(columns), end};
}

void NearLayer::resolve() {
    const Rect blocks = begun_blocks();
    const auto resolve_blocks = HWY_DYNAMIC_DISPATCH(resolve_row);
    for (int row = blocks.y0; row < blocks.y1; ++row) {
        const RowsBehind behind = rows_behind(row);
        const std::size_t first = number_of(0, row) * block_samples;
        const std::ptrdiff_t upper = std::ptrdiff_t{tile_side} * sample_block_pixels * row, lower = upper + tile_side;
        resolve_blocks({&sample_depth_[first], nullptr, &red_green_[first], &blue_[first]}, blocks.x0, blocks.x1,
                       begun_[row], behind.upper, behind.lower, behind.last,
                       {{&rgba_[4 * upper], &rgba_[4 * lower]}, {&depth_[upper], &depth_[lower]}});
    }
    touched_ = {tile_.x0 + sample_block_pixels * blocks.x0, tile_.y0 + sample_block_pixels * blocks.y0,
                std::min(tile_.x0 + sample_block_pixels * blocks.x1, tile_.x1),
                std::min(tile_.y0 + sample_block_pixels * blocks.y1, tile_.y1)};
}

}  // namespace render::native
#endif  // HWY_ONCE
