#include "render/native/occluder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "render/native/numbering.h"
#include "render/native/raster.h"

namespace render::native {

namespace {

constexpr int half = subpixels / 2;

int edge_count(const Panel& panel) {
    return panel.is_triangle() ? 3 : 4;
}

std::pair<std::uint32_t, std::uint32_t> edge(const Panel& panel, int i) {
    return {panel.corners[i], panel.corners[(i + 1) % edge_count(panel)]};
}

// Of the pixels whose centres lie in [low, high], in subpixels: the first, and the one behind the last.
int first_pixel(std::int32_t low) {
    return (low + half - 1) >> 8;
}
int end_pixel(std::int32_t high) {
    return ((high - half) >> 8) + 1;
}

Rect pixels_of(std::int32_t left, std::int32_t top, std::int32_t right, std::int32_t bottom) {
    return {first_pixel(left), first_pixel(top), end_pixel(right), end_pixel(bottom)};
}

}  // namespace

Occluder::Occluder(const scene::StaticMesh& structure) {
    add_sectors(structure);
    find_neighbours();
    keep_large_surfaces();
}

void Occluder::add_sectors(const scene::StaticMesh& structure) {
    Numbering numbering;
    std::uint32_t panels = 0;
    for (const scene::StaticSector& from : structure.sectors) {
        std::vector<Triangle> triangles;
        for (std::uint32_t i = from.first_index; i < from.first_index + from.index_count; i += 3) {
            const auto corner = [&](int c) -> const scene::StaticVertex& {
                return structure.vertices[structure.indices[i + c]];
            };
            if (corner(0).color.a != static_cast<std::uint8_t>(scene::Surface::painted)) continue;
            triangles.push_back(
                {numbering.of(corner(0).position), numbering.of(corner(1).position), numbering.of(corner(2).position)});
        }
        if (triangles.empty()) continue;
        Sector& sector = sectors_.emplace_back();
        sector.box = from.box;
        sector.panels = make_panels(numbering.positions(), triangles, std::vector<std::uint32_t>(triangles.size()));
        for (Panel& panel : sector.panels) panel.surface = panels++;
    }
    if (panels > 0) {
        corners_ = Corners(numbering.positions());
        screen_ = ScreenCorners(corners_.count);
    }
    is_firm_.resize(panels);
    in_view_.reserve(sectors_.size());
}

// Whoever has the same edge the other way round. An edge that two have the same way round has no neighbours.
void Occluder::find_neighbours() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> owners;
    for (const Sector& sector : sectors_)
        for (const Panel& panel : sector.panels)
            for (int i = 0; i < edge_count(panel); ++i) {
                const auto [owner, is_new] = owners.try_emplace(edge(panel, i), panel.surface);
                if (!is_new) owner->second = nobody;
            }
    const auto owner = [&](std::uint32_t from, std::uint32_t to) {
        const auto found = owners.find({from, to});
        return found == owners.end() ? nobody : found->second;
    };
    for (const Sector& sector : sectors_)
        for (const Panel& panel : sector.panels) {
            std::array<std::uint32_t, 4>& beyond = neighbours_.emplace_back();
            beyond.fill(nobody);
            for (int i = 0; i < edge_count(panel); ++i) {
                const auto [from, to] = edge(panel, i);
                if (owner(from, to) != nobody) beyond[i] = owner(to, from);
            }
        }
}

// A surface is all that goes on from panel to panel. Seats and masts hide hardly anybody, and their outlines would open
// what they stand before.
void Occluder::keep_large_surfaces() {
    constexpr double least_share = 0.01;  // of the whole structure's area
    std::vector<std::uint32_t> above(neighbours_.size());
    std::iota(above.begin(), above.end(), 0u);
    const auto surface_of = [&](std::uint32_t panel) {
        while (above[panel] != panel) panel = above[panel] = above[above[panel]];
        return panel;
    };
    for (std::uint32_t panel = 0; panel < neighbours_.size(); ++panel)
        for (const std::uint32_t beyond : neighbours_[panel])
            if (beyond != nobody) above[surface_of(panel)] = surface_of(beyond);
    std::vector<double> areas(neighbours_.size());
    double whole = 0;
    for (const Sector& sector : sectors_)
        for (const Panel& panel : sector.panels) {
            const auto at = [&](int i) {
                const std::uint32_t corner = panel.corners[i];
                return glm::dvec3(corners_.x[corner], corners_.y[corner], corners_.z[corner]);
            };
            const double area = 0.5 * glm::length(glm::cross(at(2) - at(0), at(3) - at(1)));
            areas[surface_of(panel.surface)] += area;
            whole += area;
        }
    for (Sector& sector : sectors_)
        std::erase_if(sector.panels,
                      [&](const Panel& panel) { return areas[surface_of(panel.surface)] < least_share * whole; });
    std::erase_if(sectors_, [](const Sector& sector) { return sector.panels.empty(); });
    for (const Sector& sector : sectors_) {
        box_.min = glm::min(box_.min, sector.box.min);
        box_.max = glm::max(box_.max, sector.box.max);
    }
}

const Occlusion* Occluder::look(const View& view) {
    if (std::max(view.width, view.height) > largest_picture) return nullptr;
    const glm::vec3 eye(view.position);
    if (glm::all(glm::lessThan(box_.min, eye)) && glm::all(glm::lessThan(eye, box_.max))) return nullptr;
    if (has_view_ && same_view(view, view_)) return &occlusion_;
    if (!has_view_ || view.width != view_.width || view.height != view_.height) {
        grid_ = TileGrid(view.width, view.height);
        farthest_ = Plane<float>(blocks_across(view.width), blocks_across(view.height));
        // What is drawn at a pixel's border may fall to the next one.
        occlusion_ = {farthest_.row(0), farthest_.stride(), blocks_across(view.width), blocks_across(view.height),
                      1.0f};
    }
    view_ = view;
    has_view_ = true;
    aim(view);
    gather();
    tbb::parallel_for(std::size_t{0}, grid_.count(), [&](std::size_t tile) { paint(tile); });
    return &occlusion_;
}

void Occluder::aim(const View& view) {
    in_view_.clear();
    for (Sector& sector : sectors_) {
        if (overlap(view, sector.box) == Overlap::outside) continue;
        sector.distance = glm::length(view.relative(sector.box.center()));
        in_view_.push_back(&sector);
    }
    std::stable_sort(in_view_.begin(), in_view_.end(),
                     [](const Sector* a, const Sector* b) { return a->distance < b->distance; });
    if (!in_view_.empty()) project(view, corners_, screen_);
    std::ranges::fill(is_firm_, std::uint8_t{0});
    tbb::parallel_for(std::size_t{0}, in_view_.size(), [&](std::size_t i) { find_visible(view, *in_view_[i]); });
    tbb::parallel_for(std::size_t{0}, in_view_.size(), [&](std::size_t i) { find_seams(*in_view_[i]); });
}

void Occluder::find_visible(const View& view, Sector& sector) {
    for (const Panel& panel : sector.panels) is_firm_[panel.surface] = is_firm(panel);
    sector.visible.clear();
    add_visible(view, corners_, screen_, sector.panels, sector.visible);
    // They come in the order of their panels.
    const Panel* panel = sector.panels.data();
    for (ScreenTriangle& triangle : sector.visible) {
        while (panel->surface != triangle.surface) ++panel;
        lower(triangle, *panel);
    }
}

// Whether it faces the camera, and each corner points outward, wherever its corners are rounded to.
bool Occluder::is_firm(const Panel& panel) const {
    const int count = edge_count(panel);
    std::int64_t longest = 0;
    for (int i = 0; i < count; ++i) {
        const auto [from, to] = edge(panel, i);
        if ((screen_.sides[from] & clipped) != 0) return false;
        const std::int64_t across = std::int64_t{screen_.x[to]} - screen_.x[from];
        const std::int64_t down = std::int64_t{screen_.y[to]} - screen_.y[from];
        longest = std::max(longest, std::abs(across) + std::abs(down));
    }
    for (int i = 0; i < count; ++i) {
        const std::uint32_t a = panel.corners[i], b = panel.corners[(i + 1) % count],
                            c = panel.corners[(i + 2) % count];
        const std::int64_t twice_the_area =
            (std::int64_t{screen_.x[c]} - screen_.x[a]) * (std::int64_t{screen_.y[b]} - screen_.y[a]) -
            (std::int64_t{screen_.y[c]} - screen_.y[a]) * (std::int64_t{screen_.x[b]} - screen_.x[a]);
        if (twice_the_area < 2 * rounding * longest) return false;
    }
    return true;
}

// To where it is nowhere nearer than by another rasteriser, which has other corners, and two planes for a panel.
void Occluder::lower(ScreenTriangle& triangle, const Panel& panel) const {
    double off = std::abs(triangle.depth_x) + std::abs(triangle.depth_y);
    for (const std::uint32_t corner : panel.corners) {
        if ((screen_.sides[corner] & clipped) != 0) continue;
        constexpr double pixel = 1.0 / subpixels;
        const double here = triangle.depth + triangle.depth_x * (pixel * screen_.x[corner] - 0.5) +
                            triangle.depth_y * (pixel * screen_.y[corner] - 0.5);
        off = std::max(off, off + std::abs(here - screen_.depth[corner]));
    }
    constexpr double share = 1e-5;  // float32's rounding, many times over
    triangle.depth -= off + share * triangle.nearest;
}

// Of those that surely face the camera, where they don't go on; of others all edges.
void Occluder::find_seams(Sector& sector) const {
    sector.seams.clear();
    for (const Panel& panel : sector.panels) {
        if (!is_firm_[panel.surface]) continue;
        for (int i = 0; i < edge_count(panel); ++i) {
            const std::uint32_t beyond = neighbours_[panel.surface][i];
            if (beyond != nobody && is_firm_[beyond]) continue;
            const auto [a, b] = edge(panel, i);
            if ((screen_.sides[a] & screen_.sides[b]) != 0) continue;
            sector.seams.push_back(
                {screen_.x[a], screen_.y[a], screen_.x[b], screen_.y[b], std::max(screen_.depth[a], screen_.depth[b])});
        }
    }
    for (const ScreenTriangle& triangle : sector.visible) {
        if (is_firm_[triangle.surface]) continue;
        for (int i = 0; i < 4; ++i) {
            const int j = (i + 1) % 4;
            sector.seams.push_back({triangle.x[i], triangle.y[i], triangle.x[j], triangle.y[j], triangle.nearest});
        }
    }
}

void Occluder::gather() {
    triangles_.clear();
    seams_.clear();
    for (const Sector* sector : in_view_) {
        triangles_.insert(triangles_.end(), sector->visible.begin(), sector->visible.end());
        seams_.insert(seams_.end(), sector->seams.begin(), sector->seams.end());
    }
    bounds_.clear();
    for (const ScreenTriangle& triangle : triangles_) {
        const auto [left, right] = std::ranges::minmax(triangle.x);
        const auto [top, bottom] = std::ranges::minmax(triangle.y);
        bounds_.push_back(pixels_of(left, top, right, bottom));
    }
    triangle_lists_.fill(grid_, bounds_);
    bounds_.clear();
    for (const Seam& seam : seams_) {
        const auto [left, right] = std::minmax(seam.x0, seam.x1);
        const auto [top, bottom] = std::minmax(seam.y0, seam.y1);
        bounds_.push_back(pixels_of(left - rounding, top - rounding, right + rounding, bottom + rounding));
    }
    seam_lists_.fill(grid_, bounds_);
}

void Occluder::paint(std::size_t index) {
    const Tile tile = grid_.tile(index);
    Cell<1> cell;
    cell.x0 = tile.x0;
    cell.y0 = tile.y0;
    cell.last_column = (tile.x1 - tile.x0 - 1) / block_side;
    cell.last_row = (tile.y1 - tile.y0 - 1) / block_side;
    clear(cell, view_.width, view_.height);
    rasterize(triangles_, triangle_lists_.of(index), 0, cell);
    finish(cell);
    for (const std::uint32_t i : seam_lists_.of(index)) open_beside(seams_[i], cell);
    for (int row = 0; row <= cell.last_row; ++row)
        std::copy_n(&cell.farthest[Cell<1>::block(0, row)], cell.last_column + 1,
                    farthest_.row(tile.y0 / block_side + row) + tile.x0 / block_side);
}

// Row by row: the part of the seam that is so high, and what is so near to it.
void Occluder::open_beside(const Seam& seam, Cell<1>& cell) {
    const auto [left, right] = std::minmax(seam.x0, seam.x1);
    const auto [top, bottom] = std::minmax(seam.y0, seam.y1);
    const double slope = top == bottom ? 0.0 : static_cast<double>(seam.x1 - seam.x0) / (seam.y1 - seam.y0);
    const int y0 = std::max(first_pixel(top - rounding), cell.y0);
    const int y1 = std::min(end_pixel(bottom + rounding), cell.y0 + (cell.last_row + 1) * block_side);
    for (int y = y0; y < y1; ++y) {
        std::int32_t from = left, to = right;
        if (top != bottom) {
            const int center = y * subpixels + half;
            const double a = seam.x0 + slope * (std::clamp(center - rounding, top, bottom) - seam.y0);
            const double b = seam.x0 + slope * (std::clamp(center + rounding, top, bottom) - seam.y0);
            from = static_cast<std::int32_t>(std::floor(std::min(a, b)));
            to = static_cast<std::int32_t>(std::ceil(std::max(a, b)));
        }
        const int x0 = std::max(first_pixel(from - rounding), cell.x0);
        const int x1 = std::min(end_pixel(to + rounding), cell.x0 + (cell.last_column + 1) * block_side);
        for (int x = x0; x < x1; ++x) {
            const int column = x - cell.x0, row = y - cell.y0;
            const std::size_t block = Cell<1>::block(column / block_side, row / block_side);
            const std::size_t pixel = block * block_pixels + row % block_side * block_side + column % block_side;
            if (!(cell.depth[pixel] > seam.nearest)) cell.farthest[block] = 0;
        }
    }
}

}  // namespace render::native
