#include "render/native/cell_limits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/cell_limits.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "render/view.h"

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, 16> floats;
constexpr int step = static_cast<int>(hn::MaxLanes(floats));

}  // namespace

// [m] View depth of near_plane / view depth. Writes up to a vector more.
void FindMetres(const float* nearness, float* metres, int count) {
    for (int x = 0; x < count; x += step)
        hn::StoreU(hn::Div(hn::Set(floats, near_plane), hn::LoadU(floats, nearness + x)), floats, metres + x);
}

// What is there becomes no more than `values`.
void Lower(float* there, const float* values, int count) {
    int x = 0;
    for (; x + step <= count; x += step)
        hn::StoreU(hn::Min(hn::LoadU(floats, there + x), hn::LoadU(floats, values + x)), floats, there + x);
    for (; x < count; ++x) there[x] = std::min(there[x], values[x]);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(FindMetres);
HWY_EXPORT(Lower);

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

void find_metres(const float* nearness, float* metres, int count) {
    HWY_DYNAMIC_DISPATCH(FindMetres)(nearness, metres, count);
}
void lower(float* there, const float* values, int count) {
    HWY_DYNAMIC_DISPATCH(Lower)(there, values, count);
}

// The columns of pixels that take from each column of cells, from the first one's first on.
class Windows {
public:
    explicit Windows(const CellGrid& grid)
        : first_(grid.pixels_of(grid.cells.x0).first),
          width_(grid.pixels_of(grid.cells.x1 - 1).end - first_),
          cells_(grid.cells.x1 - grid.cells.x0),
          half_(static_cast<int>(std::bit_floor(static_cast<unsigned>(std::ceil(2.0f * grid.side)) - 1))) {
        for (int i = 0; i < cells_; ++i) {
            const Span window = grid.pixels_of(grid.cells.x0 + i);
            left_[i] = window.first - first_;
            right_[i] = window.end - half_ - first_;
        }
    }

    int first() const { return first_; }
    int width() const { return width_; }

    // The least of each cell's pixels. Changes those.
    void find_least(float* pixels, float* cells) const {
        for (int done = 1; done < half_; done *= 2) lower(pixels, pixels + done, width_ - done);
        for (int i = 0; i < cells_; ++i) cells[i] = std::min(pixels[left_[i]], pixels[right_[i]]);
    }

private:
    int first_, width_, cells_;
    int half_;  // every window is of 2 * side pixels, rounded up, or one less: two of so many cover it
    std::array<int, CellPlane<float>::most_cells> left_, right_;
};

}  // namespace

void CellLimits::find(const CellGrid& grid, const BackdropPicture& behind, const NearLayer* near) {
    grid.is_coarse() ? find_coarse(grid, behind, near) : find_fine(grid, behind, near);
}

void CellLimits::find_fine(const CellGrid& grid, const BackdropPicture& behind, const NearLayer* near) {
    const Tile& tile = grid.tile;
    const int width = tile.x1 - tile.x0;
    for (int y = tile.y0; y < tile.y1; ++y) {
        const int row = y - tile.y0;
        const float* backdrop = behind.depth.row(y) + tile.x0;
        find_metres(backdrop, backdrop_.at(0, row), width);
        if (!near) continue;
        float *before = before_near_.at(0, row), *after = behind_near_.at(0, row);
        std::copy_n(backdrop_.at(0, row), width, before);
        std::fill_n(after, width, infinite);
        if (!near->touches_row(y)) continue;
        const Rect& touched = near->touched();
        const float* depth = near->depth(y);
        for (int x = touched.x0 - tile.x0; x < touched.x1 - tile.x0; ++x)
            if (depth[x] > 0) before[x] = after[x] = near_plane / std::max(depth[x], backdrop[x]);
    }
}

void CellLimits::find_coarse(const CellGrid& grid, const BackdropPicture& behind, const NearLayer* near) {
    const Windows windows(grid);
    const int left = std::max(windows.first(), 0), right = std::min(windows.first() + windows.width(), behind.width);
    const int inset = left - windows.first(), width = std::max(right - left, 0);
    const auto size = static_cast<std::size_t>(windows.width()) + row_alignment;
    farthest_.resize(size), farthest_with_near_.resize(size), with_near_.resize(size);
    for (int cell = grid.cells.y0; cell < grid.cells.y1; ++cell) {
        const int row = cell - grid.cells.y0, columns = grid.cells.x1 - grid.cells.x0;
        const Span rows = grid.pixels_of(cell);
        // Outside of the picture is nothing that anybody could be seen through.
        std::fill(farthest_.begin(), farthest_.end(), infinite);
        std::fill(farthest_with_near_.begin(), farthest_with_near_.end(), infinite);
        for (int y = std::max(rows.first, 0); y < std::min(rows.end, behind.height); ++y) {
            const float* backdrop = behind.depth.row(y) + left;
            lower(farthest_.data() + inset, backdrop, width);
            if (!near) continue;
            std::copy_n(backdrop, width, with_near_.begin());
            near->raise(y, with_near_.data() + (grid.tile.x0 - left));
            lower(farthest_with_near_.data() + inset, with_near_.data(), width);
        }
        float* cells = backdrop_.at(0, row);
        windows.find_least(farthest_.data(), cells);
        find_metres(cells, cells, columns);
        if (!near) continue;
        float* before = before_near_.at(0, row);
        windows.find_least(farthest_with_near_.data(), before);
        find_metres(before, before, columns);
    }
}

}  // namespace render::native

#endif
