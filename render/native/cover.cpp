#include "render/native/cover.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/cover.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "render/view.h"

#ifndef GRANDSTAND_NATIVE_COVER_ONCE
#define GRANDSTAND_NATIVE_COVER_ONCE

namespace render::native {

// Who lays something on a pixel of which no more is open than this can't be seen.
inline constexpr std::int16_t closed = pixel_full / 4096;

// Where a pixel is among cells: in [0, last - 1], and the share of the next, 32767 = 1.
struct Along {
    std::int16_t cell, share;
};

// A row of a patch of cells as large as pixels, and what it is laid into, from the same pixel on.
struct CoverRow {
    std::int16_t* cells;
    std::uint64_t used;  // groups of cells
    Cover* cover;
    Flock* flock;
    int first, last;  // only these cells are in the tile
    // near_plane / view depth at each pixel: what hides people behind it; and, if not null, what people must be behind.
    const float* hidden_behind;
    const float* shown_behind;
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

// How far back each pixel lets people be seen, in their reach from their middle, 32767 = 1. Outside of the tile
// nowhere.
void find_limits(const SplatPerson& person, const CoverRow& row, const float* depth, std::int16_t* limits) {
    constexpr std::int16_t nowhere = -32768;
    const hn::Rebind<std::int16_t, decltype(floats)> out;
    const auto nearest = hn::Set(floats, near_plane), middle = hn::Set(floats, person.depth);
    const auto scale = hn::Set(floats, 32767.0f / person.reach), most = hn::Set(floats, 32767.0f);
    std::fill(limits, limits + row.first, nowhere);
    for (int x = row.first; x < row.last; x += static_cast<int>(hn::Lanes(floats))) {
        const auto behind = hn::Div(nearest, hn::LoadU(floats, depth + x));
        const auto limit = hn::Mul(hn::Sub(behind, middle), scale);
        const auto clamped = hn::Max(hn::Min(limit, most), hn::Neg(most));
        hn::StoreU(hn::DemoteTo(out, hn::ConvertTo(ints, clamped)), out, limits + x);
    }
    std::fill(limits + row.last, limits + row.last + group_cells, nowhere);
}

Vector all(int value) {
    return hn::Set(cells, static_cast<std::int16_t>(value));
}

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

// 1 / coverage where that is over 1, 32767 = 1; over 2 it counts as 2. Newton's step for 1 / x, twice, from the
// straight line that is least off over [1, 2], 24/17 - 8/17 x.
Vector thinning(Vector share) {
    const auto x = hn::Min(hn::Max(share, all(cell_full)), all(2 * cell_full - 1));
    auto y = hn::Sub(all(30840), hn::MulFixedPoint15(all(15420), hn::ShiftLeft<2>(hn::Sub(x, all(cell_full)))));
    for (int i = 0; i < 2; ++i) {
        const auto off = hn::ShiftLeft<2>(hn::Sub(all(cell_full), hn::MulFixedPoint15(x, y)));
        y = hn::SaturatedAdd(y, hn::MulFixedPoint15(y, off));
    }
    return y;
}

Floats part(hn::Vec<decltype(shorts)> fixed) {
    return hn::ConvertTo(floats, hn::PromoteTo(ints, fixed));
}

// Whether anything of a group of pixels can still be seen through.
bool is_open(const Cover* group) {
    constexpr int step = static_cast<int>(hn::MaxLanes(cells)) / 4;
    alignas(64) static constexpr std::int16_t light[16] = {-1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0};
    // Light counts as full, and what is more than full as much more.
    const auto not_share =
        hn::ShiftRight<1>(hn::BitCast(hn::Repartition<std::uint16_t, Cells>(), hn::Load(cells, light)));
    for (int i = 0; i < group_cells; i += step) {
        const auto there = hn::LoadU(cells, reinterpret_cast<const std::int16_t*>(group + i));
        const auto share = hn::Or(there, hn::BitCast(cells, not_share));
        if (!hn::AllFalse(cells, hn::Lt(share, all(pixel_full - closed)))) return true;
    }
    return false;
}

using Cell = hn::FixedTag<std::int16_t, 8>;

hn::Vec<Cell> between(const std::int16_t* a, const std::int16_t* b, std::int16_t share) {
    const Cell cell;
    const auto from = hn::Load(cell, a);
    return hn::Add(from, hn::MulFixedPoint15(hn::Sub(hn::Load(cell, b), from), hn::Set(cell, share)));
}

}  // namespace

// Which groups of pixels can still be seen through, a bit each. The last one's pixels beyond `count` count too.
std::uint64_t OpenGroups(const Cover* cover, int count) {
    std::uint64_t open = 0;
    for (int x = 0; x < count; x += group_cells) open |= std::uint64_t{is_open(cover + x)} << (x / group_cells);
    return open;
}

// Makes cells that are covered more than once cover themselves once. `count`: of whole groups.
void ThinCells(std::int16_t* from, int count) {
    const hn::FixedTag<std::int16_t, 8> lanes;
    for (std::int16_t* cell = from; cell < from + 8 * count; cell += 8) {
        if (cell[3] <= cell_full) continue;
        alignas(64) std::int16_t spread[most_lanes];
        hn::Store(thinning(all(cell[3])), cells, spread);
        hn::Store(hn::MulFixedPoint15(hn::Load(lanes, cell), hn::Set(lanes, spread[0])), lanes, cell);
    }
}

// A row of pixels out of a patch of larger cells, first down and then across; `line` is all 0 before and after. Returns
// which groups of pixels may not be all 0, and are open in `cover`; the others aren't written.
std::uint64_t StretchRow(const Patch& patch, Along row, std::span<const Along> columns, const Cover* cover,
                         std::int16_t* line, std::int16_t* pixels) {
    const Cell cell;
    const std::uint64_t used = patch.used[row.cell] | patch.used[row.cell + 1];
    const std::int16_t* above = patch.cells + std::ptrdiff_t{8} * patch.stride * row.cell;
    const std::int16_t* below = above + std::ptrdiff_t{8} * patch.stride;
    const auto for_each_used = [&](auto visit) HWY_ATTR {
        for (std::uint64_t left = used; left != 0; left &= left - 1)
            for (int i = 0; i < 8 * group_cells; i += 8) visit(8 * group_cells * std::countr_zero(left) + i);
    };
    for_each_used([&](int at) HWY_ATTR { hn::Store(between(above + at, below + at, row.share), cell, line + at); });
    const int count = static_cast<int>(columns.size());
    std::uint64_t filled = 0;
    for (int first = 0; first < count; first += group_cells) {
        const int end = std::min(first + group_cells, count);
        const int low = columns[first].cell / group_cells, high = (columns[end - 1].cell + 1) / group_cells;
        if ((used >> low & ((std::uint64_t{2} << (high - low)) - 1)) == 0 || !is_open(cover + first)) continue;
        filled |= std::uint64_t{1} << (first / group_cells);
        for (int i = first; i < end; ++i) {
            const std::int16_t* from = line + 8 * columns[i].cell;
            hn::Store(between(from, from + 8, columns[i].share), cell, pixels + 8 * i);
        }
        for (int i = end; i < first + group_cells; ++i) hn::Store(hn::Zero(cell), cell, pixels + 8 * i);
    }
    for_each_used([&](int at) HWY_ATTR { hn::Store(hn::Zero(cell), cell, line + at); });
    return filled;
}

// Lays the used cells, and leaves them all 0.
void LayRow(const SplatPerson& person, const CoverRow& row) {
    alignas(64) std::int16_t limits[largest_patch_side + 2 * most_lanes];
    find_limits(person, row, row.hidden_behind, limits);
    alignas(64) std::int16_t begins[largest_patch_side + 2 * most_lanes];
    if (row.shown_behind) find_limits(person, row, row.shown_behind, begins);
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
            auto shown = hn::And(hn::Lt(back, hn::MulFixedPoint15(share, spread_four(limits + group, i))),
                                 hn::Gt(open, all(closed)));
            if (row.shown_behind)
                shown = hn::AndNot(hn::Lt(back, hn::MulFixedPoint15(share, spread_four(begins + group, i))), shown);
            hn::StoreU(hn::SaturatedAdd(there, hn::IfThenElseZero(shown, hn::MulFixedPoint15(unit, before))), cells,
                       to);
            const auto joined = hn::IfThenElse(beside, spread<1>(others), depth);
            hn::StoreU(
                hn::IfThenElse(hn::And(shown, hn::Gt(share, hn::Zero(cells))), hn::OddEven(joined, before), others),
                cells, flock);
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
HWY_EXPORT(OpenGroups);
HWY_EXPORT(ThinCells);
HWY_EXPORT(StretchRow);
HWY_EXPORT(ResolveRow);

CoverTile::CoverTile()
    : cover_(std::size_t{stride} * (tile_side + 2 * margin_rows)),
      flocks_(cover_.size()),
      line_(std::size_t{8} * (largest_patch_side + group_cells)),
      stretched_(std::size_t{8} * stride),
      limits_(stride) {}

void CoverTile::begin(const Tile& tile, const BackdropPicture& behind) {
    tile_ = tile;
    behind_ = &behind;
    std::memset(cover_.data(), 0, cover_.size() * sizeof(Cover));
    std::fill(flocks_.begin(), flocks_.end(), Flock{});
}

Rect CoverTile::open_part(const Rect& pixels) const {
    Rect part{std::max(pixels.x0, tile_.x0), std::max(pixels.y0, tile_.y0), std::min(pixels.x1, tile_.x1),
              std::min(pixels.y1, tile_.y1)};
    if (part.empty()) return {};
    const int width = part.x1 - part.x0;
    const auto open_groups = [&](int y) {
        return HWY_DYNAMIC_DISPATCH(OpenGroups)(&cover_[index_of(part.x0, y)], width);
    };
    std::uint64_t groups = 0;
    while (part.y0 < part.y1 && (groups = open_groups(part.y0)) == 0) ++part.y0;
    while (part.y0 < part.y1 && open_groups(part.y1 - 1) == 0) --part.y1;
    if (part.empty()) return {};
    // Every group is known to be open or not once one of its rows is.
    const int last = (width - 1) / group_cells;
    for (int y = part.y0 + 1; y < part.y1 && ((groups & 1) == 0 || (groups >> last & 1) == 0); ++y)
        groups |= open_groups(y);
    part.x1 = std::min(part.x1, part.x0 + group_cells * static_cast<int>(std::bit_width(groups)));
    part.x0 += group_cells * std::countr_zero(groups);
    return part;
}

void CoverTile::lay(const NearLayer& near) {
    const Rect& touched = near.touched();
    for (int y = touched.y0; y < touched.y1; ++y) {
        const std::uint16_t* from = near.rgba(y) + 4 * (touched.x0 - tile_.x0);
        auto* to = &cover_[index_of(touched.x0, y)].red;
        for (int i = 0; i < touched.x1 - touched.x0; ++i, from += 4, to += 4) {
            const int open = pixel_full - std::min(to[3], pixel_full);
            for (int lane = 0; lane < 4; ++lane)
                to[lane] = static_cast<std::uint16_t>(to[lane] + ((from[lane] * open + (1 << 14)) >> 15));
        }
    }
}

// Depths of the near layer's pixels from the tile's first on, in a row of its own: what it covers, or its and the
// backdrop's.
const float* CoverTile::find_limits(const NearLayer& near, int y, bool with_backdrop) {
    const Rect& touched = near.touched();
    if (with_backdrop)
        std::copy_n(behind_->depth.row(y) + tile_.x0, tile_side, limits_.begin());
    else
        std::fill(limits_.begin(), limits_.end(), 0.0f);
    if (y < touched.y0 || y >= touched.y1) return limits_.data();
    const float* depth = near.depth(y);
    for (int x = touched.x0 - tile_.x0; x < touched.x1 - tile_.x0; ++x) limits_[x] = std::max(limits_[x], depth[x]);
    return limits_.data();
}

void CoverTile::lay_row(const SplatPerson& person, std::int16_t* cells, std::uint64_t used, Tile part,
                        const NearLayer* near, Layers layers) {
    const int y = part.y0, row = std::clamp(y, tile_.y0, tile_.y1 - 1);
    const bool is_within = row == y;
    CoverRow out{cells,
                 used,
                 &cover_[index_of(part.x0, y)],
                 &flocks_[index_of(part.x0, y)],
                 is_within ? std::max(tile_.x0 - part.x0, 0) : 0,
                 is_within ? std::min(tile_.x1, part.x1) - part.x0 : 0,
                 behind_->depth.row(row) + part.x0,
                 nullptr};
    if (layers != Layers::all) {
        const float* limits = find_limits(*near, row, layers == Layers::before_near) + part.x0 - tile_.x0;
        (layers == Layers::before_near ? out.hidden_behind : out.shown_behind) = limits;
    }
    HWY_DYNAMIC_DISPATCH(LayRow)(person, out);
}

void CoverTile::lay(const SplatPerson& person, const Patch& patch, const NearLayer* near, Layers layers) {
    if (person.cell > 1.0f) return lay_stretched(person, patch, near, layers);
    for (int y = 0; y < patch.height; ++y) {
        const std::uint64_t used = std::exchange(patch.used[y], 0);
        if (used == 0) continue;
        lay_row(person, patch.cells + std::ptrdiff_t{8} * patch.stride * y, used,
                {patch.x0, patch.y0 + y, patch.x0 + patch.width, patch.y0 + y + 1}, near, layers);
    }
}

void CoverTile::lay_stretched(const SplatPerson& person, const Patch& patch, const NearLayer* near, Layers layers) {
    for_each_used_group(patch, [](std::int16_t* cell) { HWY_DYNAMIC_DISPATCH(ThinCells)(cell, group_cells); });
    const auto along = [&](int pixel, int first, int size) {
        const float place = (static_cast<float>(pixel) + 0.5f) / person.cell - 0.5f - static_cast<float>(first);
        const float clamped = std::clamp(place, 0.0f, static_cast<float>(size - 1) - 0.001f);
        const auto whole = static_cast<std::int16_t>(clamped);
        return Along{whole, static_cast<std::int16_t>((clamped - static_cast<float>(whole)) * 32767.0f)};
    };
    const Rect pixels = person.bounds();
    const int x0 = std::max(pixels.x0, tile_.x0), x1 = std::min(pixels.x1, tile_.x1);
    std::array<Along, tile_side> columns;
    for (int x = x0; x < x1; ++x) columns[x - x0] = along(x, patch.x0, patch.width);
    for (int y = std::max(pixels.y0, tile_.y0); x0 < x1 && y < std::min(pixels.y1, tile_.y1); ++y) {
        const std::uint64_t used = HWY_DYNAMIC_DISPATCH(StretchRow)(
            patch, along(y, patch.y0, patch.height), std::span(columns).first(static_cast<std::size_t>(x1 - x0)),
            &cover_[index_of(x0, y)], line_.data(), stretched_.data());
        if (used != 0) lay_row(person, stretched_.data(), used, {x0, y, x1, y + 1}, near, layers);
    }
    clear(patch);
}

void CoverTile::resolve(Plane<std::uint32_t>& out) {
    const auto resolve_row = HWY_DYNAMIC_DISPATCH(ResolveRow);
    for (int y = tile_.y0; y < tile_.y1; ++y)
        resolve_row(&cover_[index_of(tile_.x0, y)], behind_->color.row(y) + tile_.x0, out.row(y) + tile_.x0,
                    tile_.x1 - tile_.x0);
}

}  // namespace render::native

#endif
