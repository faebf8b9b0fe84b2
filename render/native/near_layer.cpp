#include "render/native/near_layer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

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

// The block's two rows of two pixels. `behind`: depths of the backdrop at its four.
void resolve_block(const Block& block, const float* behind, std::uint16_t* const rgba[2], float* const depth[2]) {
    const Counts counts;
    const Depths depths;
    constexpr std::uint32_t samples = samples_across * samples_across;
    const auto half = hn::Set(counts, samples / 2);
    const auto low = hn::Set(counts, 0xffffu);
    const auto back = hn::LoadU(depths, behind);
    auto nearest = hn::Zero(depths);
    auto red = half, green = half, blue = half, cover = half;
    for (std::uint32_t s = 0; s < samples; ++s) {
        const auto z = hn::Load(depths, block.depth + 4 * s);
        const auto covered = hn::Gt(z, back);
        const auto red_green = hn::Load(counts, block.red_green + 4 * s);
        nearest = hn::Max(nearest, hn::IfThenElseZero(covered, z));
        red = hn::Add(red, hn::And(red_green, low));
        green = hn::Add(green, hn::ShiftRight<16>(red_green));
        blue = hn::Add(blue, hn::Load(counts, block.blue + 4 * s));
        cover = hn::Add(cover, hn::IfThenElseZero(hn::RebindMask(counts, covered),
                                                  hn::Set(counts, static_cast<std::uint32_t>(full))));
    }
    const auto quarter = [](auto sum) { return hn::ShiftRight<2>(sum); };
    const auto red_green = hn::Or(quarter(red), hn::ShiftLeft<16>(quarter(green)));
    const auto blue_cover = hn::Or(quarter(blue), hn::ShiftLeft<16>(quarter(cover)));
    HWY_ALIGN std::uint32_t pixels[8];
    HWY_ALIGN float nearest_of[4];
    hn::StoreInterleaved2(red_green, blue_cover, counts, pixels);
    hn::Store(nearest, depths, nearest_of);
    std::memcpy(rgba[0], pixels, 16);
    std::memcpy(rgba[1], pixels + 4, 16);
    std::memcpy(depth[0], nearest_of, 8);
    std::memcpy(depth[1], nearest_of + 2, 8);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render::native {

HWY_EXPORT(resolve_block);

NearLayer::NearLayer()
    : sample_depth_(hwy::AllocateAligned<float>(std::size_t{blocks_across} * blocks_across * block_samples)),
      red_green_(hwy::AllocateAligned<std::uint32_t>(std::size_t{blocks_across} * blocks_across * block_samples)),
      blue_(hwy::AllocateAligned<std::uint32_t>(std::size_t{blocks_across} * blocks_across * block_samples)),
      rgba_(hwy::AllocateAligned<std::uint16_t>(std::size_t{4} * tile_side * tile_side)),
      depth_(hwy::AllocateAligned<float>(std::size_t{tile_side} * tile_side)) {}

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

// At a block's four pixels. The last ones may lie outside of the picture, where nobody looks.
std::array<float, 4> NearLayer::depths_behind(int column, int row) const {
    const int x0 = tile_.x0 + sample_block_pixels * column, x1 = std::min(x0 + 1, behind_->width - 1);
    const int y0 = tile_.y0 + sample_block_pixels * row, y1 = std::min(y0 + 1, behind_->height - 1);
    const float* upper = behind_->depth.row(y0);
    const float* lower = behind_->depth.row(y1);
    return {upper[x0], upper[x1], lower[x0], lower[x1]};
}

void NearLayer::begin_block(const Block& block, int column, int row) const {
    const std::array<float, 4> behind = depths_behind(column, row);
    for (int i = 0; i < block_samples; i += 4) std::copy(behind.begin(), behind.end(), block.depth + i);
    *block.farthest = *std::ranges::min_element(behind);
    std::fill_n(block.red_green, block_samples, 0u);
    std::fill_n(block.blue, block_samples, 0u);
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
    const auto resolve_one = HWY_DYNAMIC_DISPATCH(resolve_block);
    for (int y = blocks.y0; y < blocks.y1; ++y) {
        for (int x = blocks.x0; x < blocks.x1; ++x) {
            const std::ptrdiff_t pixel = std::ptrdiff_t{tile_side} * sample_block_pixels * y + sample_block_pixels * x;
            std::uint16_t* const rgba[] = {rgba_.get() + 4 * pixel, rgba_.get() + 4 * (pixel + tile_side)};
            float* const depth[] = {depth_.get() + pixel, depth_.get() + pixel + tile_side};
            if ((begun_[y] >> x & 1) == 0) {
                for (int i = 0; i < sample_block_pixels; ++i) {
                    std::fill_n(rgba[i], 4 * sample_block_pixels, std::uint16_t{0});
                    std::fill_n(depth[i], sample_block_pixels, 0.0f);
                }
                continue;
            }
            resolve_one(block(x, y), depths_behind(x, y).data(), rgba, depth);
        }
    }
    touched_ = {tile_.x0 + sample_block_pixels * blocks.x0, tile_.y0 + sample_block_pixels * blocks.y0,
                std::min(tile_.x0 + sample_block_pixels * blocks.x1, tile_.x1),
                std::min(tile_.y0 + sample_block_pixels * blocks.y1, tile_.y1)};
}

}  // namespace render::native
#endif  // HWY_ONCE
