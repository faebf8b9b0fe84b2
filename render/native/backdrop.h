// What stands and lies around the people: structure, ground and sky, as render/gl/backdrop.h draws them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/native/picture.h"
#include "render/native/shade.h"
#include "render/native/triangles_on_screen.h"
#include "render/view.h"
#include "scene/ground.h"
#include "scene/light.h"
#include "scene/static_mesh.h"

namespace render::native {

// Mean FLIP of what shows beside people, expected block by block: of everything, added where ground shows, and for each
// unit of unrest, which is how far samples' green is from the mean of their pixel, on average [of 1]. Four samples of
// what is restless are too few, and ground is shaded once a pixel. Fitted to pictures without people
// (docs/measurements/loss.md).
struct BackdropErrors {
    float all = 0.001609f, ground = 0.01442f, unrest = 0.9039f;
};

class Backdrop {
public:
    // Copies what it needs. Throws std::runtime_error when there is no native form of the ground's shader.
    Backdrop(const scene::StaticMesh& structure, const scene::Ground& ground, const scene::Light& light,
             const BackdropErrors& errors = {});

    // Readies a view, told from the structure's origin, for painting; of at most largest_picture either way. Runs on
    // the threads of the caller's arena; the result is the same for any number of them. Allocates only where a view
    // needs more than every one before.
    void aim(const View& view);

    // Of the sectors in the last view, whether they face it or not: what the work is counted by.
    std::int64_t triangles() const { return triangles_; }

    // Paints a part of the aimed view into `out`, all three planes, whose size is the view's. The tile's edges are
    // multiples of block_side, or the picture's. Safe for several tiles at once. Writes whole blocks: what of them lies
    // beyond the picture's right edge is padding.
    void paint(const Tile& tile, BackdropPicture& out) const;

private:
    // So that threads that fill neighbouring parts do not wait for each other.
    static constexpr std::size_t cache_lines = 128;

    // One surface of a sector, and what the aimed view sees of it.
    struct alignas(cache_lines) Part {
        motion::Bounds box;
        std::int64_t triangles;
        Corners corners;
        std::vector<Panel> panels;  // their surfaces: colours as pixels have them; of ground 0

        ScreenCorners screen;
        std::vector<ScreenTriangle> visible;
        std::vector<std::uint32_t> first_in_cell, in_cell;  // per cell, row by row, a run of indices of `visible`
        float distance = 0;                                 // [m] from the camera to the box's middle
    };

    void add_parts(const scene::StaticMesh& structure, scene::Surface surface, std::span<const std::uint32_t> colors);
    void choose_parts(const View& view);
    void sort_into_cells(Part& part) const;
    void paint_cell(const Tile& tile, int cell_x, int cell_y, BackdropPicture& out) const;

    scene::Ground ground_;
    scene::Light light_;
    BackdropErrors errors_;
    std::vector<Part> parts_;
    std::size_t painted_parts_ = 0;  // come first, then ground

    Shading shading_;
    int cells_across_ = 0, cells_down_ = 0;
    std::vector<std::uint32_t> in_view_;                    // parts: painted before ground, the nearest first
    std::vector<std::span<const ScreenTriangle>> grounds_;  // of parts in view, in that order
    std::vector<std::uint32_t> surface_offsets_;            // of parts in view
    std::int64_t triangles_ = 0;
};

// Of a picture that is painted: the mean of what is expected of its judged blocks.
double mean_error(const BackdropPicture& picture);

}  // namespace render::native
