#include "render/native/cover.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/cover.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/view.h"

#ifndef GRANDSTAND_NATIVE_COVER_ONCE
#define GRANDSTAND_NATIVE_COVER_ONCE

namespace render::native {

// Between two rows of cells: the share of the second.
struct CellRows {
    const Cover *above, *below;
    const float *nearness_above, *nearness_below;  // CoverCells::nearness
    int cells;
    float share;
};

// One that lies between. Depths are told by floats: of little coverage, rounded, they couldn't be.
struct CellLine {
    Cover* cover;
    float *share, *nearness;
};

}  // namespace render::native

#endif

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, 16> floats;
constexpr hn::Rebind<std::int32_t, decltype(floats)> ints;
constexpr hn::Rebind<std::uint16_t, decltype(floats)> shorts;
using Floats = hn::Vec<decltype(floats)>;
constexpr int step = static_cast<int>(hn::MaxLanes(floats));
constexpr hn::FixedTag<std::int16_t, 8> two_cells;

Floats part(hn::Vec<decltype(shorts)> fixed) {
    return hn::ConvertTo(floats, hn::PromoteTo(ints, fixed));
}

// The last of each four lanes, in all of them.
template <typename Vector>
Vector shares_of_pixels(Vector v) {
    const hn::DFromV<Vector> lanes;
    alignas(16) static constexpr std::uint8_t from[16] = {6, 7, 6, 7, 6, 7, 6, 7, 14, 15, 14, 15, 14, 15, 14, 15};
    const hn::Repartition<std::uint8_t, decltype(lanes)> bytes;
    return hn::TableLookupBytes(v, hn::BitCast(lanes, hn::LoadU(bytes, from)));
}

Floats shares_of(const Cover* cells) {
    hn::Vec<decltype(shorts)> light[3], share;
    hn::LoadInterleaved4(shorts, &cells->red, light[0], light[1], light[2], share);
    return part(share);
}

}  // namespace

// Pixels out of cells, first down and then across; those that are nearer than the mean of what covers them are left
// open.
void StretchRow(const CellRows& rows, const CellColumns& columns, const float* nearness, int first, int end,
                const CellLine& line, Cover* to) {
    const auto lanes_of = [](const Cover* cover) { return reinterpret_cast<const std::int16_t*>(cover); };
    const auto between = [](auto a, auto b, auto share)
                             HWY_ATTR { return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), share)); };
    const auto mean = [](Floats a, Floats b, Floats share)
                          HWY_ATTR { return hn::Add(a, hn::Mul(hn::Sub(b, a), share)); };
    const auto down = hn::Set(two_cells, static_cast<std::int16_t>(rows.share * 32767.0f));
    for (int i = 0; i < rows.cells; i += 2)
        hn::StoreU(between(hn::LoadU(two_cells, lanes_of(rows.above + i)),
                           hn::LoadU(two_cells, lanes_of(rows.below + i)), down),
                   two_cells, reinterpret_cast<std::int16_t*>(line.cover + i));
    for (int i = 0; i < rows.cells; i += step) {
        const auto share = hn::Set(floats, rows.share);
        hn::StoreU(mean(shares_of(rows.above + i), shares_of(rows.below + i), share), floats, line.share + i);
        hn::StoreU(mean(hn::LoadU(floats, rows.nearness_above + i), hn::LoadU(floats, rows.nearness_below + i), share),
                   floats, line.nearness + i);
    }
    for (int x = first; x < end; x += 2) {
        const hn::Repartition<std::uint64_t, decltype(two_cells)> words;
        const auto load = [&](int pixel) HWY_ATTR {
            return hn::BitCast(words, hn::LoadU(two_cells, lanes_of(line.cover + columns.cell[pixel])));
        };
        const auto one = load(x), other = load(x + 1);
        hn::StoreU(between(hn::BitCast(two_cells, hn::InterleaveLower(words, one, other)),
                           hn::BitCast(two_cells, hn::InterleaveUpper(words, one, other)),
                           hn::LoadU(two_cells, &columns.lanes[std::size_t{4} * x])),
                   two_cells, reinterpret_cast<std::int16_t*>(to + x));
    }
    for (int x = first; x < end; x += step) {
        const auto cell = hn::LoadU(ints, &columns.cell[x]);
        const auto across = [&](const float* of) HWY_ATTR {
            return mean(hn::GatherIndex(floats, of, cell), hn::GatherIndex(floats, of + 1, cell),
                        hn::LoadU(floats, &columns.share[x]));
        };
        const auto hidden = hn::Lt(across(line.nearness), hn::Mul(hn::LoadU(floats, nearness + x), across(line.share)));
        if (hn::AllFalse(floats, hidden)) continue;
        hn::Vec<decltype(shorts)> light[3], share;
        hn::LoadInterleaved4(shorts, &to[x].red, light[0], light[1], light[2], share);
        const auto show = [&](auto lane) HWY_ATTR {
            return hn::DemoteTo(shorts, hn::IfThenZeroElse(hn::RebindMask(ints, hidden), hn::PromoteTo(ints, lane)));
        };
        hn::StoreInterleaved4(show(light[0]), show(light[1]), show(light[2]), show(share), shorts, &to[x].red);
    }
}

// Lays a row of a near layer behind what is there; NearLayer::rgba, 32767 = 1.
void LayNearRow(const std::uint16_t* rgba, Cover* there, int count) {
    int x = 0;
    const auto lay = [&](auto lanes) HWY_ATTR {
        auto* to = reinterpret_cast<std::int16_t*>(there + x);
        const auto before = hn::LoadU(lanes, to);
        const auto open = hn::Max(hn::Sub(hn::Set(lanes, cover_full), shares_of_pixels(before)), hn::Zero(lanes));
        const auto light = hn::LoadU(lanes, reinterpret_cast<const std::int16_t*>(rgba) + 4 * x);
        hn::StoreU(hn::SaturatedAdd(before, hn::MulFixedPoint15(light, open)), lanes, to);
    };
    for (; x + 2 <= count; x += 2) lay(two_cells);
    if (x < count) lay(hn::FixedTag<std::int16_t, 4>());
}

// Adds what a row holds beyond what was before a near layer, as far as that leaves it open; `rgba`: null where it
// covers nothing.
void AddBeyondRow(const Cover* all, const Cover* before, const std::uint16_t* rgba, Cover* there, int count) {
    int x = 0;
    const auto add = [&](auto lanes) HWY_ATTR {
        const auto load = [&](const auto* from)
                              HWY_ATTR { return hn::LoadU(lanes, reinterpret_cast<const std::int16_t*>(from)); };
        auto more = hn::Max(hn::Sub(load(all + x), load(before + x)), hn::Zero(lanes));
        if (rgba)
            more = hn::MulFixedPoint15(more, hn::Sub(hn::Set(lanes, 32767), shares_of_pixels(load(rgba + 4 * x))));
        hn::StoreU(hn::SaturatedAdd(load(there + x), more), lanes, reinterpret_cast<std::int16_t*>(there + x));
    };
    for (; x + 2 <= count; x += 2) add(two_cells);
    if (x < count) add(hn::FixedTag<std::int16_t, 4>());
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
        constexpr float unit = cover_full, steps = 255.0f;
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

HWY_EXPORT(StretchRow);
HWY_EXPORT(LayNearRow);
HWY_EXPORT(AddBeyondRow);
HWY_EXPORT(ResolveRow);

CoverTile::CoverTile()
    : before_(std::size_t{tile_side} * tile_side),
      kept_(before_.size()),
      row_(tile_side),
      line_(CellPlane<Cover>::stride),
      share_line_(CellPlane<float>::stride),
      nearness_line_(CellPlane<float>::stride),
      with_near_(tile_side) {}

void CoverTile::begin(const Tile& tile, const BackdropPicture& behind, float cell, const NearLayer* near) {
    grid_ = CellGrid(tile, cell);
    behind_ = &behind;
    near_ = near;
    is_near_laid_ = false;
    cells_.begin(grid_.cells, grid_.is_coarse());
    has_limits_ = false;
    if (grid_.is_coarse()) find_columns();
}

void CoverTile::find_columns() {
    for (int x = 0; x < tile_side; ++x) {
        const float at = grid_.at(std::min(grid_.tile.x0 + x, grid_.tile.x1 - 1)), cell = std::floor(at);
        columns_.cell[x] = static_cast<int>(cell) - grid_.cells.x0;
        columns_.share[x] = at - cell;
        std::fill_n(&columns_.lanes[std::size_t{4} * x], 4, static_cast<std::int16_t>((at - cell) * 32767.0f));
    }
}

void CoverTile::lay(const InDepth& people, const Patch& patch, Layers layers) {
    if (!has_limits_) limits_.find(grid_, *behind_, near_);
    has_limits_ = true;
    const CellPlane<float>* behind_near =
        layers == Layers::behind_near && !grid_.is_coarse() ? &limits_.behind_near() : nullptr;
    cells_.lay(people, patch,
               {layers == Layers::before_near ? &limits_.before_near() : &limits_.backdrop(), behind_near});
}

void CoverTile::lay_near() {
    if (grid_.is_coarse()) return lay_near_on_pixels();
    for (int y = near_->touched().y0; y < near_->touched().y1; ++y) lay_near_row(y, cells_.cover(y - grid_.cells.y0));
}

// `to`: from the tile's first column on.
void CoverTile::lay_near_row(int y, Cover* to) const {
    const Rect& touched = near_->touched();
    const int first = touched.x0 - grid_.tile.x0;
    HWY_DYNAMIC_DISPATCH(LayNearRow)(near_->rgba(y) + 4 * first, to + first, touched.x1 - touched.x0);
}

// A row of pixels out of the cells, where they are nearer than what a row of nearness says.
void CoverTile::stretch_row(int y, const float* nearness) {
    const Rect& touched = cells_.touched();
    const float at = grid_.at(y), cell = std::floor(at);
    const int above = static_cast<int>(cell);
    if (above + 1 < touched.y0 || above >= touched.y1) {
        std::fill(row_.begin(), row_.end(), Cover{});
        return;
    }
    const int row = above - grid_.cells.y0;
    const CellRows rows{cells_.cover(row),        cells_.cover(row + 1),           cells_.nearness(row),
                        cells_.nearness(row + 1), grid_.cells.x1 - grid_.cells.x0, at - cell};
    const auto column = [&](int pixel) { return std::clamp(pixel - grid_.tile.x0, 0, grid_.tile.x1 - grid_.tile.x0); };
    const int first = column(grid_.pixels_of(touched.x0).first), end = column(grid_.pixels_of(touched.x1 - 1).end);
    constexpr int whole = 16;  // no vector is longer
    const int from = first / whole * whole, to = (end + whole - 1) / whole * whole;
    std::fill(row_.begin(), row_.begin() + from, Cover{});
    std::fill(row_.begin() + to, row_.end(), Cover{});
    HWY_DYNAMIC_DISPATCH(StretchRow)
    (rows, columns_, nearness, from, to, {line_.data(), share_line_.data(), nearness_line_.data()}, row_.data());
}

void CoverTile::lay_near_on_pixels() {
    const Tile& tile = grid_.tile;
    for (int y = tile.y0; y < tile.y1; ++y) {
        std::copy_n(behind_->depth.row(y) + tile.x0, tile.x1 - tile.x0, with_near_.begin());
        near_->raise(y, with_near_.data());
        stretch_row(y, with_near_.data());
        std::copy(row_.begin(), row_.end(), row_of(before_, y));
        std::copy(row_.begin(), row_.end(), row_of(kept_, y));
        if (near_->touches_row(y)) lay_near_row(y, row_of(kept_, y));
    }
    is_near_laid_ = true;
    cells_.begin(grid_.cells, true);
    close_full_cells();
}

// Those of which no pixel that takes from them is open, nor any in the same group of group_cells.
void CoverTile::close_full_cells() {
    const Tile& tile = grid_.tile;
    const int width = tile.x1 - tile.x0, height = tile.y1 - tile.y0;
    std::array<std::uint64_t, tile_side> open;
    for (int y = 0; y < height; ++y) open[y] = open_groups(row_of(kept_, tile.y0 + y), width);
    std::array<std::uint64_t, CellPlane<Cover>::most_cells> windows;
    for (int column = grid_.cells.x0; column < grid_.cells.x1; ++column) {
        const Span xs = grid_.pixels_of(column);
        const int first = std::max(xs.first - tile.x0, 0), last = std::min(xs.end - tile.x0, width) - 1;
        const auto up_to = [](int pixel) { return (std::uint64_t{2} << (pixel / group_cells)) - 1; };
        windows[column - grid_.cells.x0] = first > last ? 0 : up_to(last) & ~(up_to(first) >> 1);
    }
    for (int row = grid_.cells.y0; row < grid_.cells.y1; ++row) {
        const Span ys = grid_.pixels_of(row);
        std::uint64_t any = 0;
        for (int y = std::max(ys.first - tile.y0, 0); y < std::min(ys.end - tile.y0, height); ++y) any |= open[y];
        for (int column = 0; column < grid_.cells.x1 - grid_.cells.x0; ++column)
            if ((any & windows[column]) == 0) cells_.close(column, row - grid_.cells.y0);
    }
}

// From the tile's first column on.
const Cover* CoverTile::pixel_row(int y) {
    if (!grid_.is_coarse()) return cells_.cover(y - grid_.cells.y0);
    stretch_row(y, behind_->depth.row(y) + grid_.tile.x0);
    if (!is_near_laid_) return row_.data();
    // All who are in the cells now are those before the near layer, and others behind them; of these, what it leaves.
    const Rect& touched = near_->touched();
    Cover* kept = row_of(kept_, y);
    const Cover* before = row_of(before_, y);
    const auto add = [&](int first, int end, const std::uint16_t* rgba) {
        if (first < end)
            HWY_DYNAMIC_DISPATCH(AddBeyondRow)(&row_[first], before + first, rgba, kept + first, end - first);
    };
    const int width = grid_.tile.x1 - grid_.tile.x0;
    if (!near_->touches_row(y)) {
        add(0, width, nullptr);
        return kept;
    }
    const int first = touched.x0 - grid_.tile.x0, end = touched.x1 - grid_.tile.x0;
    add(0, first, nullptr);
    add(first, end, near_->rgba(y) + 4 * first);
    add(end, width, nullptr);
    return kept;
}

void CoverTile::resolve(const TileColors& colors, Plane<std::uint32_t>& out) {
    const Tile& tile = grid_.tile;
    for (int y = tile.y0; y < tile.y1; ++y) HWY_DYNAMIC_DISPATCH(ResolveRow)
    (pixel_row(y), colors.row(y - tile.y0), out.row(y) + tile.x0, tile.x1 - tile.x0);
}

}  // namespace render::native

#endif
