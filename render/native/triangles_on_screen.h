// A view of a mesh: its triangles as pixels see them.
#pragma once

#include <hwy/aligned_allocator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/native/sample_points.h"
#include "render/view.h"

namespace render::native {

inline constexpr int subpixels = 256;         // in a pixel, along x and y
inline constexpr int largest_picture = 8192;  // [px] either side
inline constexpr int guard_band = 4096;       // [px] around the picture: what reaches farther out is clipped

// Of the rows or columns of pixels that have a sample in [low, high], in subpixels: the first, and the last.
template <int samples>
constexpr int first_sampled(std::int32_t low) {
    return (low + subpixels - 1 - subpixels / sample_steps * last_sample<samples>) >> 8;
}
template <int samples>
constexpr int last_sampled(std::int32_t high) {
    return (high - subpixels / sample_steps * first_sample<samples>) >> 8;
}
inline constexpr int most_samples = 4;  // whose first and last row and column enclose all others'

// A triangle, whose last corner is there twice, or a flat convex quadrilateral. Clockwise on the screen, x to the right
// and y down; no two corners are farther apart than 2^22 subpixels. Where it is seen, its depth is linear in the pixel.
struct ScreenTriangle {
    std::array<std::int32_t, 4> x, y;  // [1/256 px] from the picture's top left corner
    std::uint32_t surface;
    float nearest;                   // the greatest depth of its corners
    double depth, depth_x, depth_y;  // reversed depth at the centre of pixel (0, 0), and what it grows by along x and y
};

// Positions as arrays, filled up with copies of the last to a multiple of the longest vector.
struct Corners {
    Corners() = default;
    explicit Corners(const std::vector<glm::vec3>& positions);

    std::size_t count = 0;                       // a multiple of 16
    hwy::AlignedFreeUniquePtr<float[]> x, y, z;  // [m] from the structure's origin
};

// The corners as a view sees them.
struct ScreenCorners {
    ScreenCorners() = default;
    explicit ScreenCorners(std::size_t count);

    hwy::AlignedFreeUniquePtr<std::int32_t[]> x, y;   // [1/256 px]; of no use where `sides` says clipped
    hwy::AlignedFreeUniquePtr<float[]> depth;         // reversed
    hwy::AlignedFreeUniquePtr<std::int32_t[]> sides;  // of which sides of the frustum it is outside, and `clipped`
};
inline constexpr std::int32_t outside_left = 1, outside_right = 2, outside_top = 4, outside_bottom = 8;
inline constexpr std::int32_t clipped = 16;  // before the near plane, beyond the guard band, or not finite

// `view`: told from the same origin; out: of as many as `corners`.
void project(const View& view, const Corners& corners, ScreenCorners& out);

using Triangle = std::array<std::uint32_t, 3>;  // indices of corners, counter-clockwise seen from outside

// One or two triangles of one surface. Two of them, {a, b, c} and {a, c, d}, are drawn as one where the view allows it,
// which covers the same pixels: most of what people build is rectangles, and their blocks are then drawn into once.
struct Panel {
    std::array<std::uint32_t, 4> corners;  // of one triangle, the last is there twice
    std::uint32_t surface;

    bool is_triangle() const { return corners[2] == corners[3]; }
};

// The triangles in their order. Neighbours in it become one if they share their surface and plane.
std::vector<Panel> make_panels(const std::vector<glm::vec3>& positions, const std::vector<Triangle>& triangles,
                               const std::vector<std::uint32_t>& surfaces);

// Appends to `out` what faces the camera and may cover a sample, in the order of `panels`; of clipped ones the
// rest, in several triangles.
void add_visible(const View& view, const Corners& corners, const ScreenCorners& screen,
                 const std::vector<Panel>& panels, std::vector<ScreenTriangle>& out);

}  // namespace render::native
