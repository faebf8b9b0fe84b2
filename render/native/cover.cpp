#include "render/native/cover.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/cover.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "render/view.h"

#ifndef GRANDSTAND_NATIVE_COVER_ONCE
#define GRANDSTAND_NATIVE_COVER_ONCE

namespace render::native {

// A row of a patch of cells as large as pixels, and what it is laid into, from the same pixel on.
struct CoverRow {
    std::int16_t* cells;
    std::uint64_t used;   // groups of cells
    Cover* cover;
    Flock* flock;
    const float* depth;   // of the backdrop
    int first, last;      // only these cells are in the tile
};

}  // namespace render::native

#endif

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Cells = hn::CappedTag<std::int16_t, 4 * group_cells>;
constexpr Cells cells;
using Vector = hn::Vec<Cells>;
constexpr hn::CappedTag<float, 16> floats;
constexpr hn::Rebind<std::int32_t, decltype(floats)> ints;
constexpr hn::Rebind<std::uint16_t, decltype(floats)> shorts;
using Floats = hn::Vec<decltype(floats)>;
constexpr int most_lanes = 16;

// How far back each pixel lets people be seen, in their reach from their middle, 32767 = 1. Outside of the tile nowhere.
void find_limits(const SplatPerson& person, const CoverRow& row, std::int16_t* limits) {
    constexpr std::int16_t nowhere = -32768;
    const hn::Rebind<std::int16_t, decltype(floats)> out;
    const auto nearest = hn::Set(floats, near_plane), middle = hn::Set(floats, person.depth);
    const auto scale = hn::Set(floats, 32767.0f / person.reach), most = hn::Set(floats, 32767.0f);
    std::fill(limits, limits + row.first, nowhere);
    for (int x = row.first; x < row.last; x += static_cast<int>(hn::Lanes(floats))) {
        const auto behind = hn::Div(nearest, hn::LoadU(floats, row.depth + x));
        const auto limit = hn::Mul(hn::Sub(behind, middle), scale);
        const auto clamped = hn::Max(hn::Min(limit, most), hn::Neg(most));
        hn::StoreU(hn::DemoteTo(out, hn::ConvertTo(ints, clamped)), out, limits + x);
    }
    std::fill(limits + row.last, limits + row.last + group_cells, nowhere);
}

Vector all(int value) { return hn::Set(cells, static_cast<std::int16_t>(value)); }

// One of the four 16-bit lanes of each pixel, in all four.
template <int lane>
Vector spread(Vector v) {
    constexpr std::uint8_t a = 2 * lane, b = a + 1, c = 8 + a, d = c + 1;
    alignas(16) static constexpr std::uint8_t from[16] = {a, b, a, b, a, b, a, b, c, d, c, d, c, d, c, d};
    const hn::Repartition<std::uint8_t, Cells> bytes;
    return hn::TableLookupBytes(v, hn::BitCast(cells, hn::LoadDup128(bytes, from)));
}

// Four numbers, each in all lanes of its pixel; from the given pixel of the group on.
Vector spread_four(const std::int16_t* numbers, int pixel) {
    alignas(64) static constexpr std::uint8_t from[32] = {0, 1, 0, 1, 0, 1, 0, 1, 2, 3, 2, 3, 2, 3, 2, 3,
                                                          4, 5, 4, 5, 4, 5, 4, 5, 6, 7, 6, 7, 6, 7, 6, 7};
    const hn::Repartition<std::uint8_t, Cells> bytes;
    return hn::TableLookupBytes(hn::LoadDup128(cells, numbers), hn::BitCast(cells, hn::LoadU(bytes, from + 8 * pixel)));
}

// 1 / coverage where that is over 1, 32767 = 1; over 2 it counts as 2. Newton's step for 1 / x, twice, from the straight
// line that is least off over [1, 2], 24/17 - 8/17 x.
Vector thinning(Vector share) {
    const auto x = hn::Min(hn::Max(share, all(cell_full)), all(2 * cell_full - 1));
    auto y = hn::Sub(all(30840), hn::MulFixedPoint15(all(15420), hn::ShiftLeft<2>(hn::Sub(x, all(cell_full)))));
    for (int i = 0; i < 2; ++i) {
        const auto off = hn::ShiftLeft<2>(hn::Sub(all(cell_full), hn::MulFixedPoint15(x, y)));
        y = hn::SaturatedAdd(y, hn::MulFixedPoint15(y, off));
    }
    return y;
}

Floats part(hn::Vec<decltype(shorts)> fixed) { return hn::ConvertTo(floats, hn::PromoteTo(ints, fixed)); }

}  // namespace

// Lays the used cells, and leaves them all 0.
void LayRow(const SplatPerson& person, const CoverRow& row) {
    alignas(64) std::int16_t limits[largest_patch_side + 2 * most_lanes];
    find_limits(person, row, limits);
    constexpr int step = static_cast<int>(hn::MaxLanes(cells)) / 4;
    const auto depth = all(person.depth_code), thickness = all(person.thickness);
    const hn::Repartition<std::uint64_t, Cells> words;
    for (std::uint64_t left = row.used; left != 0; left &= left - 1) {
        const int group = group_cells * std::countr_zero(left);
        for (int i = 0; i < group_cells; i += step) {
            std::int16_t* cell = row.cells + 8 * (group + i);
            const auto a = hn::BitCast(words, hn::Load(cells, cell));
            const auto b = hn::BitCast(words, hn::Load(cells, cell + 4 * step));
            hn::Store(hn::Zero(cells), cells, cell);
            hn::Store(hn::Zero(cells), cells, cell + 4 * step);
            const auto light = hn::BitCast(cells, hn::ConcatEven(words, b, a));
            const auto back = spread<0>(hn::BitCast(cells, hn::ConcatOdd(words, b, a)));
            const auto share = spread<3>(light);
            const auto once = hn::Min(hn::MulFixedPoint15(light, thinning(share)), all(cell_full));
            const auto unit = hn::ShiftLeft<2>(hn::Sub(once, hn::ShiftRight<13>(once)));  // 8192 -> 32764

            auto* to = reinterpret_cast<std::int16_t*>(row.cover + group + i);
            auto* flock = reinterpret_cast<std::int16_t*>(row.flock + group + i);
            const auto there = hn::LoadU(cells, to), others = hn::LoadU(cells, flock);
            const auto open = hn::Max(hn::Sub(all(pixel_full), spread<3>(there)), hn::Zero(cells));
            const auto apart = hn::Sub(depth, spread<1>(others));
            const auto beside = hn::And(hn::Gt(apart, all(-1)), hn::Lt(apart, thickness));
            const auto before = hn::IfThenElse(beside, spread<0>(others), open);
            const auto shown = hn::And(hn::Lt(back, hn::MulFixedPoint15(share, spread_four(limits + group, i))),
                                       hn::Gt(open, all(pixel_full / 4096)));
            hn::StoreU(hn::SaturatedAdd(there, hn::IfThenElseZero(shown, hn::MulFixedPoint15(unit, before))), cells, to);
            const auto joined = hn::IfThenElse(beside, spread<1>(others), depth);
            hn::StoreU(hn::IfThenElse(hn::And(shown, hn::Gt(share, hn::Zero(cells))), hn::OddEven(joined, before), others), cells, flock);
        }
    }
}

void ResolveRow(const Cover* cover, const std::uint32_t* behind, std::uint32_t* to, int count) {
    const hn::Rebind<std::uint32_t, decltype(floats)> words;
    const auto byte = hn::Set(words, 255u);
    for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(floats))) {
        const auto back = hn::LoadU(words, behind + x);
        hn::Vec<decltype(shorts)> light[3], share;
        hn::LoadInterleaved4(shorts, &cover[x].red, light[0], light[1], light[2], share);
        if (hn::AllTrue(shorts, hn::Eq(share, hn::Zero(shorts)))) {
            hn::StoreU(back, words, to + x);
            continue;
        }
        constexpr float unit = pixel_full, steps = 255.0f;
        // Of a pixel that is covered more than once everybody gives way alike.
        const auto covered = hn::Max(part(share), hn::Set(floats, unit));
        const auto open = hn::Div(hn::Sub(covered, part(share)), covered);
        const auto scale = hn::Div(hn::Set(floats, 1.0f), covered);
        auto out = hn::Set(words, 0xff000000u);
        const auto channel = [&](auto value, auto code) HWY_ATTR {
            const auto root = hn::Mul(hn::ConvertTo(floats, hn::BitCast(ints, code)), hn::Set(floats, 1.0f / steps));
            const auto sum = hn::Add(hn::Mul(part(value), scale), hn::Mul(open, hn::Mul(root, root)));
            const auto coded = hn::Mul(hn::Sqrt(hn::Min(sum, hn::Set(floats, 1.0f))), hn::Set(floats, steps));
            return hn::BitCast(words, hn::ConvertTo(ints, hn::Add(coded, hn::Set(floats, 0.5f))));
        };
        out = hn::Or(out, channel(light[0], hn::And(back, byte)));
        out = hn::Or(out, hn::ShiftLeft<8>(channel(light[1], hn::And(hn::ShiftRight<8>(back), byte))));
        out = hn::Or(out, hn::ShiftLeft<16>(channel(light[2], hn::And(hn::ShiftRight<16>(back), byte))));
        hn::StoreU(out, words, to + x);
    }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(LayRow);
HWY_EXPORT(ResolveRow);

CoverTile::CoverTile() : cover_(std::size_t{stride} * (tile_side + 2)), flocks_(cover_.size()) {}

void CoverTile::begin(const Tile& tile) {
    tile_ = tile;
    std::memset(cover_.data(), 0, cover_.size() * sizeof(Cover));
    std::fill(flocks_.begin(), flocks_.end(), Flock{});
}

void CoverTile::lay(const SplatPerson& person, const Patch& patch, const BackdropPicture& behind) {
    const auto lay_row = HWY_DYNAMIC_DISPATCH(LayRow);
    const int first = std::max(tile_.x0 - patch.x0, 0), last = std::min(tile_.x1 - patch.x0, patch.width);
    for (int y = 0; y < patch.height; ++y) {
        const std::uint64_t used = std::exchange(patch.used[y], 0);
        if (used == 0) continue;
        const int row = std::clamp(patch.y0 + y, tile_.y0, tile_.y1 - 1);
        const bool is_within = row == patch.y0 + y;
        lay_row(person, {patch.cells + std::ptrdiff_t{8} * patch.stride * y, used,
                         &cover_[index_of(patch.x0, patch.y0 + y)], &flocks_[index_of(patch.x0, patch.y0 + y)],
                         behind.depth.row(row) + patch.x0, is_within ? first : 0, is_within ? last : 0});
    }
}

void CoverTile::resolve(const BackdropPicture& behind, Plane<std::uint32_t>& out) {
    const auto resolve_row = HWY_DYNAMIC_DISPATCH(ResolveRow);
    for (int y = tile_.y0; y < tile_.y1; ++y)
        resolve_row(&cover_[index_of(tile_.x0, y)], behind.color.row(y) + tile_.x0,
                    out.row(y) + tile_.x0, tile_.x1 - tile_.x0);
}

}  // namespace render::native

#endif
