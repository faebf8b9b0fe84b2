// The colours of sky, ground and structure: the shaders' own functions (shaders/*.glsl), many pixels at once.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "render/native/cell.h"
#include "render/native/triangles_on_screen.h"
#include "scene/static_mesh.h"
#include "shaders/layout.h"

namespace render::native {

// A file of shaders/grounds/.
enum class GroundPaint { none, stadium };

// "" is none. Throws std::runtime_error for a file that there is nothing of here.
GroundPaint find_ground(std::string_view shader);

// What the corners look like by daylight, as pixels have it. A triangle is as its last corner is.
std::vector<std::uint32_t> light_corners(const FrameBlock& frame, std::span<const scene::StaticVertex> corners);

struct Shading {
    FrameBlock frame;
    int width = 0, height = 0;  // [px]
    GroundPaint ground = GroundPaint::none;
};

// A block's pixels.
struct PaintedBlock {
    alignas(64) std::uint32_t color[block_pixels];  // as a picture's
    // The second farthest of a pixel's samples: people are shown where the backdrop has at most half of it before them.
    alignas(64) float depth[block_pixels];
    float farthest;  // of them
};

// Finishes those samples of a block of the cell that show sky or ground, each colour found once a pixel, and filters
// them: the mean of their light. Triangles of the ground are numbered through `grounds`, from ground_surface on.
void shade(const Shading& shading, std::span<const std::span<const ScreenTriangle>> grounds, Cell<most_samples>& cell,
           int column, int row, PaintedBlock& out);

}  // namespace render::native
