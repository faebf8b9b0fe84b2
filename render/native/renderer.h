// Frames by the processor alone: no device, no driver. docs/native-splats.md tells how people become pixels.
//
// The picture is cut into tiles that threads draw one by one. In each, people go from front to back: near ones as
// triangles into a layer of four samples a pixel, the others as points with coverage, each behind what is there
// already. What stays open shows the backdrop. The bits are the same on every processor and for any number of threads.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/contact_shade.h"
#include "render/native/backdrop.h"
#include "render/native/contact_tile.h"
#include "render/native/cover.h"
#include "render/native/depth_order.h"
#include "render/native/far_people.h"
#include "render/native/near_layer.h"
#include "render/native/picture.h"
#include "render/native/point_people.h"
#include "render/native/tile_lists.h"
#include "render/native/triangles.h"
#include "render/renderer.h"
#include "scene/ground.h"
#include "scene/light.h"
#include "scene/static_mesh.h"

namespace render::native {

class Renderer final : public render::Renderer {
public:
    // Copies structure, ground and light; `figures`, in the order of Crowd::character, and what they point at must
    // outlive it. width, height in [1, largest_picture].
    Renderer(const scene::StaticMesh& structure, const scene::Ground& ground, const scene::Light& light,
             std::span<const figures::Figure> figures, int width, int height);

    void resize(int width, int height) override;
    Surroundings begin(const View& view) override;
    void draw(const Frame& frame) override;
    Image read_image() const override;

    // What was drawn last: red, green, blue in bytes 0, 1 and 2.
    const Plane<std::uint32_t>& picture() const { return picture_; }
    int width() const { return width_; }
    int height() const { return height_; }

private:
    // What a thread needs to draw a tile.
    struct Easel {
        CoverTile cover;
        NearLayer near;
        PatchRoom room;
        ContactTile contact;
    };

    bool is_drawn_already(const Frame& frame, std::uint64_t people) const;
    void part_people(const Frame& frame);
    void prepare_far(const Frame& frame);
    void fill_lists();
    void draw_tile(std::size_t index);
    TileColors shade_backdrop(std::size_t index, Easel& easel) const;
    void show(const Tile& tile, const TileColors& colors);
    float draw_near(std::size_t tile, Easel& easel) const;
    static Patch patch_for(const Rect& cells, Easel& easel);
    void draw_others(std::span<const std::uint32_t> people, std::span<const std::uint32_t> far, Easel& easel,
                     Layers layers) const;
    void draw_far_block(const FarBlockOnScreen& block, Easel& easel, Layers layers) const;
    void draw_point_person(const SplatPerson& person, Easel& easel, Layers layers) const;

    glm::dvec3 origin_;  // the structure's
    Backdrop backdrop_;
    TrianglePeople triangles_;
    PointPeople points_;
    FarCrowd far_;
    int width_ = 0, height_ = 0;
    TileGrid grid_;
    BackdropPicture behind_;
    Plane<std::uint32_t> picture_;
    View view_;
    bool has_backdrop_ = false;  // of view_
    double background_error_ = 0;
    Occlusion occlusion_;

    std::uint64_t drawn_people_ = 0;  // the last frame's: a digest of them
    double drawn_splat_size_ = 0;
    std::vector<FarBlock> drawn_far_;
    const scene::Crowd* drawn_crowd_ = nullptr;
    bool has_picture_ = false;  // of view_ and these

    std::vector<const Person*> near_people_, point_people_, unsorted_;
    DepthOrder order_;  // of point_people_
    std::vector<ContactShade> shades_;
    std::vector<Rect> shade_bounds_;
    TileLists near_lists_, point_lists_, far_lists_, shade_lists_;
    tbb::enumerable_thread_specific<Easel> easels_;
};

}  // namespace render::native
