#include "render/native/raster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/raster.cpp"
#include <hwy/foreach_target.h>
// After it, as Highway wants it.
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#ifndef RENDER_NATIVE_RASTER_EDGES
#define RENDER_NATIVE_RASTER_EDGES
namespace render::native {

// The side of an edge that a pixel's centre is on, >= 0 inside: linear in the pixel, in units of which a pixel's step
// is a whole number.
struct Edge {
    std::int32_t step_x = 0, step_y = 0;
    std::int32_t value = 0;  // at the cell's first pixel

    std::int32_t least(std::int32_t at, int side) const {
        return at + (side - 1) * (std::min(step_x, 0) + std::min(step_y, 0));
    }
    std::int32_t most(std::int32_t at, int side) const {
        return at + (side - 1) * (std::max(step_x, 0) + std::max(step_y, 0));
    }
};

// False if no pixel of the cell is inside. An edge that all of them are inside of, or that is none, becomes 0
// everywhere.
inline bool make_edge(const ScreenTriangle& triangle, int from, int to, const Cell& cell, Edge& out) {
    constexpr int half = subpixels / 2, shift = 8;
    const std::int64_t dx = triangle.x[to] - triangle.x[from], dy = triangle.y[to] - triangle.y[from];
    if (dx == 0 && dy == 0) {
        out = {};
        return true;
    }
    const std::int64_t x = std::int64_t{cell.x0} * subpixels + half - triangle.x[from];
    const std::int64_t y = std::int64_t{cell.y0} * subpixels + half - triangle.y[from];
    const bool is_upper_or_left = dy < 0 || (dy == 0 && dx > 0);
    const std::int64_t value = (dx * y - dy * x - (is_upper_or_left ? 0 : 1)) >> shift;
    constexpr int across = tile_side - 1;
    if (value + across * (std::max<std::int64_t>(-dy, 0) + std::max<std::int64_t>(dx, 0)) < 0) return false;
    if (value + across * (std::min<std::int64_t>(-dy, 0) + std::min<std::int64_t>(dx, 0)) >= 0)
        out = {};
    else
        out = {static_cast<std::int32_t>(-dy), static_cast<std::int32_t>(dx), static_cast<std::int32_t>(value)};
    return true;
}

inline constexpr int edge_count = 4;
using EdgeValues = std::array<std::int32_t, edge_count>;

inline bool is_negative_in_any(const EdgeValues& a, const EdgeValues& b) {
    return ((a[0] + b[0]) | (a[1] + b[1]) | (a[2] + b[2]) | (a[3] + b[3])) < 0;
}

// The cell's blocks that a triangle may touch, inclusive, and rows of pixels in the cell.
struct Reach {
    int first_column, last_column, first_row, last_row;
    int first_pixel_row, last_pixel_row;
};

inline Reach reach_in(const ScreenTriangle& triangle, const Cell& cell) {
    constexpr int half = subpixels / 2, shift = 8, block_shift = 3;
    const auto [left, right] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2], triangle.x[3]});
    const auto [top, bottom] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2], triangle.y[3]});
    const int x0 = ((left + half - 1) >> shift) - cell.x0, x1 = ((right - half) >> shift) - cell.x0;
    const int y0 = ((top + half - 1) >> shift) - cell.y0, y1 = ((bottom - half) >> shift) - cell.y0;
    if (x0 > x1 || y0 > y1) return {1, 0, 1, 0, 1, 0};
    return {std::max(x0 >> block_shift, cell.first_column),
            std::min(x1 >> block_shift, cell.last_column),
            std::max(y0 >> block_shift, cell.first_row),
            std::min(y1 >> block_shift, cell.last_row),
            y0,
            y1};
}

}  // namespace render::native
#endif

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;

// A vector holds whole rows of a block, or half of one.
constexpr int lanes = static_cast<int>(hn::MaxLanes(Floats()));
constexpr int columns = std::min(lanes, block_side), rows = lanes / columns;

HWY_ALIGN constexpr float lane_column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
HWY_ALIGN constexpr float lane_row[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

void clear(Cell& cell, int width, int height) {
    const Floats d;
    const Words du;
    for (int row = cell.first_row; row <= cell.last_row; ++row)
        for (int column = cell.first_column; column <= cell.last_column; ++column) {
            const std::size_t block = Cell::block(column, row);
            const int right = width - cell.x0 - column * block_side, below = height - cell.y0 - row * block_side;
            float* depth = &cell.depth[block * block_pixels];
            std::uint32_t* surface = &cell.surface[block * block_pixels];
            for (int i = 0; i < block_pixels; i += lanes) {
                hn::Store(hn::Zero(d), d, depth + i);
                hn::Store(hn::Zero(du), du, surface + i);
            }
            cell.farthest[block] = 0;
            cell.draws[block] = 0;
            if (right >= block_side && below >= block_side) continue;
            for (int i = 0; i < block_pixels; ++i)
                if (i % block_side >= right || i / block_side >= below) {
                    depth[i] = std::numeric_limits<float>::infinity();
                    surface[i] = finished;
                }
        }
}

// A triangle in a cell, with what every vector of it needs.
struct Setup {
    std::array<Edge, edge_count> edges;
    hn::Vec<Ints> lane_values[edge_count];  // what lanes' edges are beyond the first's
    hn::Vec<Ints> step[edge_count];         // to the next rows
    EdgeValues to_most, to_least;           // of a block, beyond its first pixel
    float depth_x, depth_y;
    std::uint32_t surface;

    // Arm's vectors have constructors, which only what is compiled for their instructions may call.
    HWY_ATTR Setup() {}
};

// Rounding keeps order, so no pixel is nearer than the nearest corner of the block by the same formula.
HWY_INLINE bool is_in_front(const Setup& setup, float depth, float farthest) {
    constexpr float last = block_side - 1;
    const float along_y = depth + last * std::max(setup.depth_y, 0.0f);
    return along_y + last * std::max(setup.depth_x, 0.0f) > farthest;
}

HWY_INLINE float least_depth(const float* depth) {
    const Floats d;
    auto least = hn::Load(d, depth);
    for (int i = lanes; i < block_pixels; i += lanes) least = hn::Min(least, hn::Load(d, depth + i));
    return hn::GetLane(hn::MinOfLanes(d, least));
}

// at: the edges' values at the block's first pixel.
template <bool is_whole>
HWY_INLINE void draw_block(const Setup& setup, const EdgeValues& at, float block_depth, int first_row, int last_row,
                           std::size_t block, Cell& cell) {
    const Floats d;
    const Ints di;
    const Words du;
    float* depths = &cell.depth[block * block_pixels];
    std::uint32_t* surfaces = &cell.surface[block * block_pixels];
    const auto surface = hn::Set(du, setup.surface);
    const auto slope_y = hn::Set(d, setup.depth_y), start = hn::Set(d, block_depth);
    const int row0 = first_row / rows * rows;
    for (int column = 0; column < block_side; column += columns) {
        const auto x = hn::Add(hn::Load(d, lane_column), hn::Set(d, static_cast<float>(column)));
        const auto along_x = hn::Mul(hn::Set(d, setup.depth_x), x);
        auto y = hn::Add(hn::Load(d, lane_row), hn::Set(d, static_cast<float>(row0)));
        const auto first = [&](std::size_t i) HWY_ATTR {
            const Edge& edge = setup.edges[i];
            return hn::Add(hn::Set(di, at[i] + row0 * edge.step_y + column * edge.step_x), setup.lane_values[i]);
        };
        auto a = first(0), b = first(1), c = first(2), e = first(3);
        for (int row = row0; row <= last_row; row += rows) {
            const int pixel = row * block_side + column;
            const auto depth = hn::Add(hn::Add(start, hn::Mul(slope_y, y)), along_x);
            const auto before = hn::Load(d, depths + pixel);
            auto wins = hn::Gt(depth, before);
            if constexpr (!is_whole)
                wins = hn::And(wins, hn::RebindMask(d, hn::Gt(hn::Or(hn::Or(a, b), hn::Or(c, e)), hn::Set(di, -1))));
            hn::Store(hn::IfThenElse(wins, depth, before), d, depths + pixel);
            const auto old = hn::Load(du, surfaces + pixel);
            hn::Store(hn::IfThenElse(hn::RebindMask(du, wins), surface, old), du, surfaces + pixel);
            y = hn::Add(y, hn::Set(d, static_cast<float>(rows)));
            a = hn::Add(a, setup.step[0]);
            b = hn::Add(b, setup.step[1]);
            c = hn::Add(c, setup.step[2]);
            e = hn::Add(e, setup.step[3]);
        }
    }
    // Too small a farthest depth hides less than it could, and looking costs as much as drawing.
    constexpr int draws_before_a_look = 4;
    if (!is_whole && ++cell.draws[block] < draws_before_a_look) return;
    cell.draws[block] = 0;
    cell.farthest[block] = least_depth(depths);
}

HWY_INLINE bool is_hidden(const ScreenTriangle& triangle, const Reach& reach, const Cell& cell) {
    for (int row = reach.first_row; row <= reach.last_row; ++row)
        for (int column = reach.first_column; column <= reach.last_column; ++column)
            if (triangle.nearest > cell.farthest[Cell::block(column, row)]) return false;
    return true;
}

HWY_INLINE bool set_up(const ScreenTriangle& triangle, std::uint32_t surface_offset, const Cell& cell, Setup& out) {
    for (int i = 0; i < edge_count; ++i)
        if (!make_edge(triangle, i, (i + 1) % edge_count, cell, out.edges[i])) return false;
    const Ints di;
    const auto column = hn::ConvertTo(di, hn::Load(Floats(), lane_column));
    const auto row = hn::ConvertTo(di, hn::Load(Floats(), lane_row));
    for (int i = 0; i < edge_count; ++i) {
        const Edge& edge = out.edges[i];
        out.lane_values[i] = hn::Add(hn::Mul(column, hn::Set(di, edge.step_x)), hn::Mul(row, hn::Set(di, edge.step_y)));
        out.step[i] = hn::Set(di, rows * edge.step_y);
        out.to_most[i] = edge.most(0, block_side);
        out.to_least[i] = edge.least(0, block_side);
    }
    out.depth_x = static_cast<float>(triangle.depth_x);
    out.depth_y = static_cast<float>(triangle.depth_y);
    out.surface = triangle.surface + surface_offset;
    return true;
}

// How many blocks to the right the edges let through first, and none of those before; cell_blocks if there is none.
HWY_INLINE int blocks_to_skip(const Setup& setup, const EdgeValues& at) {
    int skip = 0;
    for (int i = 0; i < edge_count; ++i) {
        const std::int32_t value = at[i] + setup.to_most[i], step = block_side * setup.edges[i].step_x;
        if (value >= 0) continue;
        if (step <= 0) return cell_blocks;
        skip = std::max(skip, (step - 1 - value) / step);
    }
    return skip;
}

// The row's blocks that the edges let through are neighbours: the loop ends behind the last.
HWY_INLINE void draw_row(const ScreenTriangle& triangle, const Setup& setup, const Reach& reach, int row, Cell& cell) {
    EdgeValues at;
    for (int i = 0; i < edge_count; ++i) {
        const Edge& edge = setup.edges[i];
        at[i] = edge.value + block_side * (reach.first_column * edge.step_x + row * edge.step_y);
    }
    const int skip = blocks_to_skip(setup, at);
    if (reach.first_column + skip > reach.last_column) return;
    for (int i = 0; i < edge_count; ++i) at[i] += skip * block_side * setup.edges[i].step_x;
    const int first = std::max(reach.first_pixel_row - row * block_side, 0);
    const int last = std::min(reach.last_pixel_row - row * block_side, block_side - 1);
    const double row_depth = triangle.depth + triangle.depth_y * (cell.y0 + row * block_side);
    for (int column = reach.first_column + skip; column <= reach.last_column; ++column) {
        const EdgeValues here = at;
        if (is_negative_in_any(here, setup.to_most)) return;
        for (int i = 0; i < edge_count; ++i) at[i] += block_side * setup.edges[i].step_x;
        const std::size_t block = Cell::block(column, row);
        const auto depth = static_cast<float>(row_depth + triangle.depth_x * (cell.x0 + column * block_side));
        if (!is_in_front(setup, depth, cell.farthest[block])) continue;
        if (!is_negative_in_any(here, setup.to_least))
            draw_block<true>(setup, here, depth, 0, block_side - 1, block, cell);
        else
            draw_block<false>(setup, here, depth, first, last, block, cell);
    }
}

HWY_INLINE void draw(const ScreenTriangle& triangle, std::uint32_t surface_offset, Cell& cell) {
    const Reach reach = reach_in(triangle, cell);
    Setup setup;
    if (is_hidden(triangle, reach, cell) || !set_up(triangle, surface_offset, cell, setup)) return;
    for (int row = reach.first_row; row <= reach.last_row; ++row) draw_row(triangle, setup, reach, row, cell);
}

void find_farthest(Cell& cell) {
    for (int row = cell.first_row; row <= cell.last_row; ++row)
        for (int column = cell.first_column; column <= cell.last_column; ++column) {
            const std::size_t block = Cell::block(column, row);
            if (cell.draws[block] > 0) cell.farthest[block] = least_depth(&cell.depth[block * block_pixels]);
        }
}

void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell& cell) {
    for (const std::uint32_t i : chosen) draw(triangles[i], surface_offset, cell);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render::native {

HWY_EXPORT(clear);
void clear(Cell& cell, int width, int height) {
    HWY_DYNAMIC_DISPATCH(clear)(cell, width, height);
}

HWY_EXPORT(find_farthest);
void find_farthest(Cell& cell) {
    HWY_DYNAMIC_DISPATCH(find_farthest)(cell);
}

HWY_EXPORT(rasterize);
void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell& cell) {
    HWY_DYNAMIC_DISPATCH(rasterize)(triangles, chosen, surface_offset, cell);
}

}  // namespace render::native
#endif
