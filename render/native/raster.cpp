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

// The side of an edge that a sample is on, >= 0 inside: linear in the pixel, in units of which a pixel's step is a
// whole number.
template <int samples>
struct Edge {
    std::int32_t step_x = 0, step_y = 0;
    std::int32_t value = 0;                         // at the first sample of the cell's first pixel
    std::array<std::int32_t, samples> to_sample{};  // from the first

    // In so many pixels either way, beyond the value at the first sample of the first.
    std::int32_t least(int side) const {
        return (side - 1) * (std::min(step_x, 0) + std::min(step_y, 0)) + *std::ranges::min_element(to_sample);
    }
    std::int32_t most(int side) const {
        return (side - 1) * (std::max(step_x, 0) + std::max(step_y, 0)) + *std::ranges::max_element(to_sample);
    }
};

// False if no sample of the cell is inside. An edge that all of them are inside of, or that is none, becomes 0
// everywhere.
template <int samples>
HWY_INLINE bool make_edge(const ScreenTriangle& triangle, int from, int to, const Cell<samples>& cell,
                          Edge<samples>& out) {
    constexpr int step = subpixels / sample_steps, shift = 8;
    out = {};
    const std::int64_t dx = triangle.x[to] - triangle.x[from], dy = triangle.y[to] - triangle.y[from];
    if (dx == 0 && dy == 0) return true;
    const std::int64_t x = std::int64_t{cell.x0} * subpixels - triangle.x[from];
    const std::int64_t y = std::int64_t{cell.y0} * subpixels - triangle.y[from];
    const bool is_upper_or_left = dy < 0 || (dy == 0 && dx > 0);
    const std::int64_t corner = dx * y - dy * x - (is_upper_or_left ? 0 : 1);
    std::array<std::int64_t, samples> value;
    for (int s = 0; s < samples; ++s) {
        const SamplePoint at = sample_points<samples>[s];
        value[s] = (corner + dx * (step * at.y) - dy * (step * at.x)) >> shift;
    }
    const auto [least, most] = std::ranges::minmax(value);
    constexpr int across = tile_side - 1;
    if (most + across * (std::max<std::int64_t>(-dy, 0) + std::max<std::int64_t>(dx, 0)) < 0) return false;
    if (least + across * (std::min<std::int64_t>(-dy, 0) + std::min<std::int64_t>(dx, 0)) >= 0) return true;
    out.step_x = static_cast<std::int32_t>(-dy);
    out.step_y = static_cast<std::int32_t>(dx);
    out.value = static_cast<std::int32_t>(value[0]);
    for (int s = 0; s < samples; ++s) out.to_sample[s] = static_cast<std::int32_t>(value[s] - value[0]);
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

template <int samples>
HWY_INLINE Reach reach_in(const ScreenTriangle& triangle, const Cell<samples>& cell) {
    constexpr int block_shift = 3;
    const auto [left, right] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2], triangle.x[3]});
    const auto [top, bottom] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2], triangle.y[3]});
    const int x0 = first_sampled<samples>(left) - cell.x0, x1 = last_sampled<samples>(right) - cell.x0;
    const int y0 = first_sampled<samples>(top) - cell.y0, y1 = last_sampled<samples>(bottom) - cell.y0;
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
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;

// A vector holds whole rows of a block, or half of one.
constexpr int lanes = static_cast<int>(hn::MaxLanes(Floats()));
constexpr int columns = std::min(lanes, block_side), rows = lanes / columns;

HWY_ALIGN constexpr float lane_column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
HWY_ALIGN constexpr float lane_row[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

// [px] From a pixel's top left corner to a sample's row or column.
constexpr float pixels(int steps) {
    return static_cast<float>(steps) / sample_steps;
}
// From a block's, to the outermost samples.
template <int samples>
constexpr float low = pixels(first_sample<samples>);
template <int samples>
constexpr float high = block_side - 1 + pixels(last_sample<samples>);

// A sheet's samples, each number `s` and in a block at `column` and `row` and to the right and below.
template <int samples>
HWY_INLINE hn::Vec<Floats> depths_of(const Sheet& sheet, int s, int column, int row) {
    const Floats d;
    const SamplePoint point = sample_points<samples>[s];
    const auto x = hn::Add(hn::Load(d, lane_column), hn::Set(d, static_cast<float>(column) + pixels(point.x)));
    const auto y = hn::Add(hn::Load(d, lane_row), hn::Set(d, static_cast<float>(row) + pixels(point.y)));
    return hn::Add(hn::Add(hn::Set(d, sheet.depth), hn::Mul(hn::Set(d, sheet.depth_y), y)),
                   hn::Mul(hn::Set(d, sheet.depth_x), x));
}

template <int samples>
void write_out(Cell<samples>& cell, std::size_t block) {
    const Floats d;
    const Words du;
    const Sheet& sheet = cell.sheet[block];
    cell.is_sheet[block] = false;
    float* depths = cell.depths(block);
    std::uint32_t* surfaces = cell.surfaces(block);
    const auto surface = hn::Set(du, sheet.surface);
    for (int s = 0; s < samples; ++s)
        for (int row = 0; row < block_side; row += rows)
            for (int column = 0; column < block_side; column += columns) {
                const int at = s * block_pixels + row * block_side + column;
                hn::Store(depths_of<samples>(sheet, s, column, row), d, depths + at);
                hn::Store(surface, du, surfaces + at);
            }
}

template <int samples>
void clear_cell(Cell<samples>& cell, int width, int height) {
    for (int row = cell.first_row; row <= cell.last_row; ++row)
        for (int column = cell.first_column; column <= cell.last_column; ++column) {
            const std::size_t block = Cell<samples>::block(column, row);
            const int right = width - cell.x0 - column * block_side, below = height - cell.y0 - row * block_side;
            cell.sheet[block] = {};
            cell.is_sheet[block] = true;
            cell.farthest[block] = 0;
            cell.draws[block] = 0;
            if (right >= block_side && below >= block_side) continue;
            write_out(cell, block);
            for (int i = 0; i < samples * block_pixels; ++i)
                if (i % block_side >= right || i % block_pixels / block_side >= below) {
                    cell.depths(block)[i] = std::numeric_limits<float>::infinity();
                    cell.surfaces(block)[i] = finished;
                }
        }
}

// A triangle in a cell, with what every vector of it needs.
template <int samples>
struct Setup {
    std::array<Edge<samples>, edge_count> edges;
    hn::Vec<Ints> lane_values[edge_count];  // what lanes' edges are beyond the first's
    hn::Vec<Ints> step[edge_count];         // to the next rows
    EdgeValues to_most, to_least;           // of a block, beyond its first pixel's first sample
    float depth_x, depth_y;
    std::uint32_t surface;

    // Arm's vectors have constructors, which only what is compiled for their instructions may call.
    HWY_ATTR Setup() {}
};

// Rounding keeps order, so no sample is nearer than the nearest corner of the block by the same formula.
template <int samples>
HWY_INLINE float nearest_of(const Sheet& sheet) {
    return sheet.at(sheet.depth_x > 0.0f ? high<samples> : low<samples>,
                    sheet.depth_y > 0.0f ? high<samples> : low<samples>);
}
template <int samples>
HWY_INLINE float farthest_of(const Sheet& sheet) {
    return sheet.at(sheet.depth_x > 0.0f ? low<samples> : high<samples>,
                    sheet.depth_y > 0.0f ? low<samples> : high<samples>);
}

template <int samples>
HWY_INLINE float least_depth(const float* depth) {
    const Floats d;
    auto least = hn::Load(d, depth);
    for (int i = lanes; i < samples * block_pixels; i += lanes) least = hn::Min(least, hn::Load(d, depth + i));
    return hn::GetLane(hn::MinOfLanes(d, least));
}

// Of a block: the edges that aren't all around it, first; what follows them is any. Most blocks are crossed by one.
template <int samples>
struct Crossing {
    std::array<int, edge_count> edge{};
    int count = 0;

    // at: the edges' values at the first sample of the block's first pixel.
    HWY_INLINE Crossing(const Setup<samples>& setup, const EdgeValues& at) {
        for (int i = 0; i < edge_count; ++i) {
            edge[count] = i;
            count += at[i] + setup.to_least[i] < 0;
        }
    }
};

// Within the first `edges` of `crossing`.
template <int samples, int edges>
HWY_INLINE void draw_samples(const Setup<samples>& setup, const Crossing<samples>& crossing, const EdgeValues& at,
                             const Sheet& sheet, int first_row, int last_row, float* depths, std::uint32_t* surfaces) {
    const Floats d;
    const Ints di;
    const Words du;
    const auto surface = hn::Set(du, sheet.surface);
    const auto slope_y = hn::Set(d, sheet.depth_y), start = hn::Set(d, sheet.depth);
    const int row0 = first_row / rows * rows;
    constexpr int kept = std::max(edges, 1);
    for (int column = 0; column < block_side; column += columns) {
        hn::Vec<Floats> along_x[samples];
        const auto x = hn::Add(hn::Load(d, lane_column), hn::Set(d, static_cast<float>(column)));
        for (int s = 0; s < samples; ++s)
            along_x[s] =
                hn::Mul(hn::Set(d, sheet.depth_x), hn::Add(x, hn::Set(d, pixels(sample_points<samples>[s].x))));
        auto y = hn::Add(hn::Load(d, lane_row), hn::Set(d, static_cast<float>(row0)));
        hn::Vec<Ints> side[kept], step[kept];
        std::int32_t to_sample[kept][samples];
        for (int i = 0; i < edges; ++i) {
            const int number = crossing.edge[i];
            const Edge<samples>& edge = setup.edges[number];
            const std::int32_t value = at[number] + row0 * edge.step_y + column * edge.step_x;
            side[i] = hn::Add(hn::Set(di, value), setup.lane_values[number]);
            step[i] = setup.step[number];
            for (int s = 0; s < samples; ++s) to_sample[i][s] = edge.to_sample[s];
        }
        for (int row = row0; row <= last_row; row += rows) {
            const int pixel = row * block_side + column;
            for (int s = 0; s < samples; ++s) {
                const int at_sample = s * block_pixels + pixel;
                const auto down = hn::Add(y, hn::Set(d, pixels(sample_points<samples>[s].y)));
                const auto depth = hn::Add(hn::Add(start, hn::Mul(slope_y, down)), along_x[s]);
                const auto before = hn::Load(d, depths + at_sample);
                auto wins = hn::Gt(depth, before);
                if constexpr (edges > 0) {
                    auto all = hn::Add(side[0], hn::Set(di, to_sample[0][s]));
                    for (int i = 1; i < edges; ++i) all = hn::Or(all, hn::Add(side[i], hn::Set(di, to_sample[i][s])));
                    wins = hn::And(wins, hn::RebindMask(d, hn::Gt(all, hn::Set(di, -1))));
                }
                hn::Store(hn::IfThenElse(wins, depth, before), d, depths + at_sample);
                const auto old = hn::Load(du, surfaces + at_sample);
                hn::Store(hn::IfThenElse(hn::RebindMask(du, wins), surface, old), du, surfaces + at_sample);
            }
            y = hn::Add(y, hn::Set(d, static_cast<float>(rows)));
            for (int i = 0; i < edges; ++i) side[i] = hn::Add(side[i], step[i]);
        }
    }
}

enum class Order { before, behind, crossing };

// Of two that fill the same block.
template <int samples>
HWY_INLINE Order compare(const Sheet& sheet, const Sheet& other) {
    int before = 0;
    for (const float x : {low<samples>, high<samples>})
        for (const float y : {low<samples>, high<samples>}) before += sheet.at(x, y) > other.at(x, y);
    return before == 4 ? Order::before : before == 0 ? Order::behind : Order::crossing;
}

template <int samples>
HWY_INLINE void draw_whole(const Setup<samples>& setup, const Crossing<samples>& crossing, const EdgeValues& at,
                           const Sheet& sheet, std::size_t block, Cell<samples>& cell) {
    if (cell.is_sheet[block]) {
        const Order order = compare<samples>(sheet, cell.sheet[block]);
        if (order == Order::behind) return;
        if (order == Order::before) {
            cell.sheet[block] = sheet;
            cell.farthest[block] = farthest_of<samples>(sheet);
            return;
        }
        write_out(cell, block);
    }
    draw_samples<samples, 0>(setup, crossing, at, sheet, 0, block_side - 1, cell.depths(block), cell.surfaces(block));
    cell.draws[block] = 0;
    cell.farthest[block] = least_depth<samples>(cell.depths(block));
}

template <int samples>
HWY_INLINE void draw_part(const Setup<samples>& setup, const Crossing<samples>& crossing, const EdgeValues& at,
                          const Sheet& sheet, int first_row, int last_row, std::size_t block, Cell<samples>& cell) {
    if (cell.is_sheet[block]) write_out(cell, block);
    float* depths = cell.depths(block);
    std::uint32_t* surfaces = cell.surfaces(block);
    if (crossing.count == 1)
        draw_samples<samples, 1>(setup, crossing, at, sheet, first_row, last_row, depths, surfaces);
    else if (crossing.count == 2)
        draw_samples<samples, 2>(setup, crossing, at, sheet, first_row, last_row, depths, surfaces);
    else
        draw_samples<samples, edge_count>(setup, crossing, at, sheet, first_row, last_row, depths, surfaces);
    // Too small a farthest depth hides less than it could, and looking costs as much as drawing.
    constexpr int draws_before_a_look = 8;
    if (++cell.draws[block] < draws_before_a_look) return;
    cell.draws[block] = 0;
    cell.farthest[block] = least_depth<samples>(cell.depths(block));
}

template <int samples>
HWY_INLINE bool is_hidden(const ScreenTriangle& triangle, const Reach& reach, const Cell<samples>& cell) {
    for (int row = reach.first_row; row <= reach.last_row; ++row)
        for (int column = reach.first_column; column <= reach.last_column; ++column)
            if (triangle.nearest > cell.farthest[Cell<samples>::block(column, row)]) return false;
    return true;
}

template <int samples>
HWY_INLINE bool set_up(const ScreenTriangle& triangle, std::uint32_t surface_offset, const Cell<samples>& cell,
                       Setup<samples>& out) {
    for (int i = 0; i < edge_count; ++i)
        if (!make_edge(triangle, i, (i + 1) % edge_count, cell, out.edges[i])) return false;
    const Ints di;
    const auto column = hn::ConvertTo(di, hn::Load(Floats(), lane_column));
    const auto row = hn::ConvertTo(di, hn::Load(Floats(), lane_row));
    for (int i = 0; i < edge_count; ++i) {
        const Edge<samples>& edge = out.edges[i];
        out.lane_values[i] = hn::Add(hn::Mul(column, hn::Set(di, edge.step_x)), hn::Mul(row, hn::Set(di, edge.step_y)));
        out.step[i] = hn::Set(di, rows * edge.step_y);
        out.to_most[i] = edge.most(block_side);
        out.to_least[i] = edge.least(block_side);
    }
    out.depth_x = static_cast<float>(triangle.depth_x);
    out.depth_y = static_cast<float>(triangle.depth_y);
    out.surface = triangle.surface + surface_offset;
    return true;
}

// How many blocks to the right the edges let through first, and none of those before; cell_blocks if there is none.
template <int samples>
HWY_INLINE int blocks_to_skip(const Setup<samples>& setup, const EdgeValues& at) {
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
template <int samples>
HWY_INLINE void draw_row(const ScreenTriangle& triangle, const Setup<samples>& setup, const Reach& reach, int row,
                         Cell<samples>& cell) {
    EdgeValues at;
    for (int i = 0; i < edge_count; ++i) {
        const Edge<samples>& edge = setup.edges[i];
        at[i] = edge.value + block_side * (reach.first_column * edge.step_x + row * edge.step_y);
    }
    const int skip = blocks_to_skip(setup, at);
    if (reach.first_column + skip > reach.last_column) return;
    for (int i = 0; i < edge_count; ++i) at[i] += skip * block_side * setup.edges[i].step_x;
    const int first = std::max(reach.first_pixel_row - row * block_side, 0);
    const int last = std::min(reach.last_pixel_row - row * block_side, block_side - 1);
    constexpr double to_center = 0.5;
    const double row_depth = triangle.depth + triangle.depth_y * (cell.y0 + row * block_side - to_center);
    for (int column = reach.first_column + skip; column <= reach.last_column; ++column) {
        const EdgeValues here = at;
        if (is_negative_in_any(here, setup.to_most)) return;
        for (int i = 0; i < edge_count; ++i) at[i] += block_side * setup.edges[i].step_x;
        const std::size_t block = Cell<samples>::block(column, row);
        const double depth = row_depth + triangle.depth_x * (cell.x0 + column * block_side - to_center);
        const Sheet sheet{static_cast<float>(depth), setup.depth_x, setup.depth_y, setup.surface};
        if (!(std::min(nearest_of<samples>(sheet), triangle.nearest) > cell.farthest[block])) continue;
        const Crossing<samples> crossing(setup, here);
        if (crossing.count == 0)
            draw_whole(setup, crossing, here, sheet, block, cell);
        else
            draw_part(setup, crossing, here, sheet, first, last, block, cell);
    }
}

template <int samples>
HWY_INLINE void draw(const ScreenTriangle& triangle, std::uint32_t surface_offset, Cell<samples>& cell) {
    const Reach reach = reach_in(triangle, cell);
    Setup<samples> setup;
    if (is_hidden(triangle, reach, cell) || !set_up(triangle, surface_offset, cell, setup)) return;
    for (int row = reach.first_row; row <= reach.last_row; ++row) draw_row(triangle, setup, reach, row, cell);
}

template <int samples>
void draw_all(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
              std::uint32_t surface_offset, Cell<samples>& cell) {
    for (const std::uint32_t i : chosen) draw(triangles[i], surface_offset, cell);
}

}  // namespace

void ClearOne(Cell<1>& cell, int width, int height) {
    clear_cell(cell, width, height);
}
void ClearFour(Cell<4>& cell, int width, int height) {
    clear_cell(cell, width, height);
}

void RasterizeOne(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
                  std::uint32_t surface_offset, Cell<1>& cell) {
    draw_all(triangles, chosen, surface_offset, cell);
}
void RasterizeFour(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
                   std::uint32_t surface_offset, Cell<4>& cell) {
    draw_all(triangles, chosen, surface_offset, cell);
}

void FinishOne(Cell<1>& cell) {
    for (int row = cell.first_row; row <= cell.last_row; ++row)
        for (int column = cell.first_column; column <= cell.last_column; ++column) {
            const std::size_t block = Cell<1>::block(column, row);
            if (cell.is_sheet[block]) write_out(cell, block);
            cell.farthest[block] = least_depth<1>(cell.depths(block));
        }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render::native {

HWY_EXPORT(ClearOne);
void clear(Cell<1>& cell, int width, int height) {
    HWY_DYNAMIC_DISPATCH(ClearOne)(cell, width, height);
}
HWY_EXPORT(ClearFour);
void clear(Cell<4>& cell, int width, int height) {
    HWY_DYNAMIC_DISPATCH(ClearFour)(cell, width, height);
}

HWY_EXPORT(RasterizeOne);
void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell<1>& cell) {
    HWY_DYNAMIC_DISPATCH(RasterizeOne)(triangles, chosen, surface_offset, cell);
}
HWY_EXPORT(RasterizeFour);
void rasterize(std::span<const ScreenTriangle> triangles, std::span<const std::uint32_t> chosen,
               std::uint32_t surface_offset, Cell<4>& cell) {
    HWY_DYNAMIC_DISPATCH(RasterizeFour)(triangles, chosen, surface_offset, cell);
}

HWY_EXPORT(FinishOne);
void finish(Cell<1>& cell) {
    HWY_DYNAMIC_DISPATCH(FinishOne)(cell);
}

}  // namespace render::native
#endif
