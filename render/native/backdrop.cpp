#include "render/native/backdrop.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <tuple>

#include "render/frame_block.h"
#include "render/native/cell.h"
#include "render/native/numbering.h"
#include "render/native/raster.h"

namespace render::native {

namespace {

// Cells that a triangle's box touches, inclusive.
struct CellBox {
    int x0, y0, x1, y1;

    CellBox(const ScreenTriangle& triangle, int cells_across, int cells_down) {
        const auto [left, right] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2], triangle.x[3]});
        const auto [top, bottom] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2], triangle.y[3]});
        x0 = std::max(first_sampled<most_samples>(left), 0) / tile_side;
        y0 = std::max(first_sampled<most_samples>(top), 0) / tile_side;
        x1 = std::min(std::max(last_sampled<most_samples>(right), 0) / tile_side, cells_across - 1);
        y1 = std::min(std::max(last_sampled<most_samples>(bottom), 0) / tile_side, cells_down - 1);
    }
};

template <typename Do>
void for_each_cell(const ScreenTriangle& triangle, int cells_across, int cells_down, Do&& act) {
    const CellBox box(triangle, cells_across, cells_down);
    for (int y = box.y0; y <= box.y1; ++y)
        for (int x = box.x0; x <= box.x1; ++x) act(static_cast<std::size_t>(y) * cells_across + x);
}

// Ground is painted by its triangle, so each is what its pixels show.
void number(std::vector<ScreenTriangle>& triangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].surface = static_cast<std::uint32_t>(i);
}

template <typename Pixel>
void copy_block(const Pixel* block, int x, int y, int end_y, Plane<Pixel>& out) {
    for (int row = 0; row < block_side && y + row < end_y; ++row)
        std::memcpy(out.row(y + row) + x, block + row * block_side, sizeof(Pixel) * block_side);
}

}  // namespace

Backdrop::Backdrop(const scene::StaticMesh& structure, const scene::Ground& ground, const scene::Light& light,
                   const BackdropErrors& errors)
    : ground_(ground), light_(light), errors_(errors) {
    shading_.ground = find_ground(ground.shader);
    const std::vector<std::uint32_t> colors =
        light_corners(make_frame_block(View{}, ground, light, 1.0f), structure.vertices);
    add_parts(structure, scene::Surface::painted, colors);
    painted_parts_ = parts_.size();
    add_parts(structure, scene::Surface::ground, colors);
    assert(parts_.size() == painted_parts_ || shading_.ground != GroundPaint::none);
    in_view_.reserve(parts_.size());
    grounds_.reserve(parts_.size());
    surface_offsets_.reserve(parts_.size());
}

void Backdrop::add_parts(const scene::StaticMesh& structure, scene::Surface surface,
                         std::span<const std::uint32_t> colors) {
    for (const scene::StaticSector& sector : structure.sectors) {
        Numbering numbering;
        std::vector<Triangle> triangles;
        std::vector<std::uint32_t> surfaces;
        for (std::uint32_t i = sector.first_index; i < sector.first_index + sector.index_count; i += 3) {
            const std::uint32_t* corners = &structure.indices[i];
            if (structure.vertices[corners[0]].color.a != static_cast<std::uint8_t>(surface)) continue;
            const auto number = [&](int c) { return numbering.of(structure.vertices[corners[c]].position); };
            const std::uint32_t first = number(0), second = number(1), third = number(2);
            triangles.push_back({first, second, third});
            surfaces.push_back(surface == scene::Surface::ground ? 0 : colors[corners[2]]);
        }
        if (triangles.empty()) continue;
        Corners corners(numbering.positions());
        ScreenCorners screen(corners.count);
        parts_.push_back(Part{sector.box,
                              static_cast<std::int64_t>(triangles.size()),
                              std::move(corners),
                              make_panels(numbering.positions(), triangles, surfaces),
                              std::move(screen),
                              {},
                              {},
                              {},
                              0});
    }
}

void Backdrop::aim(const View& view) {
    assert(view.width <= largest_picture && view.height <= largest_picture);
    shading_.frame = make_frame_block(view, ground_, light_, 1.0f);
    shading_.width = view.width;
    shading_.height = view.height;
    cells_across_ = (view.width + tile_side - 1) / tile_side;
    cells_down_ = (view.height + tile_side - 1) / tile_side;
    choose_parts(view);
    oneapi::tbb::parallel_for(std::size_t{0}, in_view_.size(), [&](std::size_t i) {
        Part& part = parts_[in_view_[i]];
        project(view, part.corners, part.screen);
        part.visible.clear();
        add_visible(view, part.corners, part.screen, part.panels, part.visible);
        if (in_view_[i] >= painted_parts_) number(part.visible);
        sort_into_cells(part);
    });
    grounds_.clear();
    surface_offsets_.clear();
    std::uint32_t next_ground = ground_surface;
    for (const std::uint32_t i : in_view_) {
        const bool is_ground = i >= painted_parts_;
        surface_offsets_.push_back(is_ground ? next_ground : 0);
        if (!is_ground) continue;
        grounds_.emplace_back(parts_[i].visible);
        next_ground += static_cast<std::uint32_t>(parts_[i].visible.size());
    }
}

void Backdrop::choose_parts(const View& view) {
    in_view_.clear();
    triangles_ = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        if (overlap(view, part.box) == Overlap::outside) continue;
        part.distance = glm::length(view.relative(part.box.center()));
        triangles_ += part.triangles;
        in_view_.push_back(static_cast<std::uint32_t>(i));
    }
    std::sort(in_view_.begin(), in_view_.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto key = [&](std::uint32_t i) { return std::tuple(i >= painted_parts_, parts_[i].distance, i); };
        return key(a) < key(b);
    });
}

void Backdrop::sort_into_cells(Part& part) const {
    std::vector<std::uint32_t>& first = part.first_in_cell;
    first.assign(static_cast<std::size_t>(cells_across_) * cells_down_ + 1, 0);
    for (const ScreenTriangle& triangle : part.visible)
        for_each_cell(triangle, cells_across_, cells_down_, [&](std::size_t cell) { ++first[cell]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& f : first) f = sum += f;
    part.in_cell.resize(sum);
    // From the back, so that each run's end becomes its beginning.
    for (std::size_t i = part.visible.size(); i-- > 0;)
        for_each_cell(part.visible[i], cells_across_, cells_down_,
                      [&](std::size_t cell) { part.in_cell[--first[cell]] = static_cast<std::uint32_t>(i); });
}

void Backdrop::paint(const Tile& tile, BackdropPicture& out) const {
    for (int y = tile.y0 / tile_side; y * tile_side < tile.y1; ++y)
        for (int x = tile.x0 / tile_side; x * tile_side < tile.x1; ++x) paint_cell(tile, x, y, out);
}

namespace {

// Of a finished block.
float expected_error(const Cell<most_samples>& cell, std::size_t block, const BackdropErrors& errors) {
    if (cell.is_sheet[block]) {
        const std::uint32_t surface = cell.sheet[block].surface;
        return surface >= ground_surface && surface < finished ? errors.all + errors.ground : errors.all;
    }
    const std::uint32_t* colors = &cell.surface[block * most_samples * block_pixels];
    int off = 0;
    for (int pixel = 0; pixel < block_pixels; ++pixel) {
        std::array<int, most_samples> green;
        for (int s = 0; s < most_samples; ++s) green[s] = static_cast<int>(colors[s * block_pixels + pixel] >> 8 & 255);
        const int sum = std::accumulate(green.begin(), green.end(), 0);
        for (const int one : green) off += std::abs(most_samples * one - sum);
    }
    return errors.all + errors.unrest * static_cast<float>(off) / (255.0f * most_samples * most_samples * block_pixels);
}

}  // namespace

void Backdrop::paint_cell(const Tile& tile, int cell_x, int cell_y, BackdropPicture& out) const {
    Cell<most_samples> cell;
    cell.x0 = cell_x * tile_side;
    cell.y0 = cell_y * tile_side;
    const int end_y = std::min(tile.y1, cell.y0 + tile_side);
    cell.first_column = (std::max(tile.x0, cell.x0) - cell.x0) / block_side;
    cell.first_row = (std::max(tile.y0, cell.y0) - cell.y0) / block_side;
    cell.last_column = (std::min(tile.x1, cell.x0 + tile_side) - cell.x0 - 1) / block_side;
    cell.last_row = (end_y - cell.y0 - 1) / block_side;
    clear(cell, shading_.width, shading_.height);
    const std::size_t number = static_cast<std::size_t>(cell_y) * cells_across_ + cell_x;
    for (std::size_t i = 0; i < in_view_.size(); ++i) {
        const Part& part = parts_[in_view_[i]];
        const std::uint32_t first = part.first_in_cell[number], last = part.first_in_cell[number + 1];
        rasterize(part.visible, std::span(part.in_cell).subspan(first, last - first), surface_offsets_[i], cell);
    }
    for (int row = cell.first_row; row <= cell.last_row; ++row)
        for (int column = cell.first_column; column <= cell.last_column; ++column) {
            PaintedBlock block;
            shade(shading_, grounds_, cell, column, row, block);
            const int x = cell.x0 + column * block_side, y = cell.y0 + row * block_side;
            copy_block(block.color, x, y, end_y, out.color);
            copy_block(block.depth, x, y, end_y, out.depth);
            out.farthest.row(y / block_side)[x / block_side] = block.farthest;
            if (is_judged(x / block_side, y / block_side))
                out.error.row(y / block_side)[x / block_side] = expected_error(cell, cell.block(column, row), errors_);
        }
}

double mean_error(const BackdropPicture& picture) {
    double sum = 0;
    int judged = 0;
    for (int row = 0; row < blocks_across(picture.height); ++row)
        for (int column = 0; column < blocks_across(picture.width); ++column) {
            if (!is_judged(column, row)) continue;
            sum += static_cast<double>(picture.error.row(row)[column]);
            ++judged;
        }
    return judged > 0 ? sum / judged : 0;
}

}  // namespace render::native
