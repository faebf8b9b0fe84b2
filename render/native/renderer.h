// Frames by the processor alone. docs/native-splats.md tells how.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/frame.h"
#include "render/image.h"
#include "render/native/cover.h"
#include "render/native/picture.h"
#include "render/native/point_people.h"
#include "scene/light.h"

namespace render::native {

class Renderer {
public:
    Renderer(std::span<const figures::Figure> figures, const scene::Light& light, int width, int height);

    void resize(int width, int height);
    void draw(const Frame& frame);
    Image read_image() const;
    BackdropPicture& backdrop() { return behind_; }

private:
    // What a thread needs to draw a tile.
    struct Bench {
        CoverTile cover;
        Array<std::int16_t> cells = Array<std::int16_t>(std::size_t{8} * largest_patch_side * largest_patch_side);
        std::array<std::uint64_t, largest_patch_side> used{};  // both all 0 between two people
    };

    void sort_by_depth(const Frame& frame);
    void bin_people();
    void draw_tile(std::size_t tile);
    Tile tile_at(std::size_t index) const;
    std::size_t tile_count() const { return static_cast<std::size_t>(columns_) * rows_; }

    PointPeople points_;
    BackdropPicture behind_;
    Plane<std::uint32_t> picture_;
    int width_ = 0, height_ = 0, columns_ = 0, rows_ = 0;
    std::vector<const Person*> point_people_, unsorted_;
    std::vector<std::uint32_t> keys_;
    std::vector<std::uint32_t> tile_begin_;  // per tile, then the total: into tile_people_
    std::vector<std::uint32_t> tile_people_;
    tbb::enumerable_thread_specific<Bench> benches_;
};

}  // namespace render::native
