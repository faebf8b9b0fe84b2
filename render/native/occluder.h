// Whom the structure hides in a picture that somebody else draws: the native rasteriser's depths, kept only where any
// rasteriser must find something there.
//
// Another one rounds corners otherwise, by less than `rounding`, so that it may leave open a pixel that is covered
// here. It cannot where the structure goes on: panels that share an edge move together, and what they cover stays
// covered. It can beside a seam, an edge where a surface ends: at outlines, where panels meet without sharing corners,
// and around those seen so much from the side that they may face away as well. A block that has a pixel's centre beside
// a seam hides nobody, unless something stands before it. Depths are taken for farther by as much as they change from
// one pixel to the next.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/native/cell.h"
#include "render/native/near_layer.h"
#include "render/native/picture.h"
#include "render/native/tile_lists.h"
#include "render/native/triangles_on_screen.h"
#include "render/occlusion.h"
#include "render/view.h"
#include "scene/static_mesh.h"

namespace render::native {

class Occluder {
public:
    static constexpr int rounding = 4;  // [subpixels]; of a rasteriser with at least 8 bits of them

    // Copies what it needs: what is painted, not the ground, behind which nobody is.
    explicit Occluder(const scene::StaticMesh& structure);

    // Of a view told from the structure's origin. Valid until the next call; kept while the view stays. Null for a
    // picture larger than largest_picture, and from within the structure, where nobody is behind it. Runs on the
    // threads of the caller's arena; the result is the same for any number of them.
    const Occlusion* look(const View& view);

private:
    static constexpr std::uint32_t nobody = 0xffffffffu;

    struct Seam {
        std::int32_t x0, y0, x1, y1;  // [1/256 px]
        float nearest;                // the greater depth of its ends
    };
    // Their panels' surfaces are their numbers among all.
    struct Sector {
        motion::Bounds box;
        std::vector<Panel> panels;
        std::vector<ScreenTriangle> visible;
        std::vector<Seam> seams;
        float distance = 0;  // [m]
    };

    void add_sectors(const scene::StaticMesh& structure);
    void find_neighbours();
    void keep_large_surfaces();
    void aim(const View& view);
    void find_visible(const View& view, Sector& sector);
    void find_seams(Sector& sector) const;
    bool is_firm(const Panel& panel) const;
    void lower(ScreenTriangle& triangle, const Panel& panel) const;
    void gather();
    void paint(std::size_t tile);
    static void open_beside(const Seam& seam, Cell<1>& cell);

    Corners corners_;  // of all sectors, each position once
    ScreenCorners screen_;
    std::vector<Sector> sectors_;
    motion::Bounds box_{glm::vec3(INFINITY), glm::vec3(-INFINITY)};  // of them all
    // Per panel: whoever goes on beyond each of its edges; and whether it surely faces the camera.
    std::vector<std::array<std::uint32_t, 4>> neighbours_;
    std::vector<std::uint8_t> is_firm_;

    View view_;
    bool has_view_ = false;
    TileGrid grid_;
    std::vector<Sector*> in_view_;  // the nearest first
    std::vector<ScreenTriangle> triangles_;
    std::vector<Seam> seams_;
    std::vector<Rect> bounds_;
    TileLists triangle_lists_, seam_lists_;
    Plane<float> farthest_;
    Occlusion occlusion_;
};

}  // namespace render::native
