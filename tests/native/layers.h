// Pictures of people drawn as triangles: tile by tile, as a renderer would, put together again for tests to look at.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/native/triangles.h"

namespace tests {

// All pixels, rows from the top.
struct Layer {
    int width = 0, height = 0;
    std::vector<std::array<std::uint16_t, 4>> rgba;
    std::vector<float> depth;

    bool operator==(const Layer&) const = default;
    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

// Of one depth everywhere.
inline render::native::BackdropPicture backdrop(int width, int height, float depth = 0) {
    render::native::BackdropPicture picture;
    picture.width = width;
    picture.height = height;
    picture.depth = render::native::Plane<float>(width, height);
    for (int y = 0; y < height; ++y) std::fill_n(picture.depth.row(y), picture.depth.stride(), depth);
    return picture;
}

struct Cut {
    int tile_width = render::native::tile_side, tile_height = render::native::tile_side;  // [px], even
    int threads = 1;
};

inline void draw_tile(const render::native::TrianglePeople& people, const render::native::Tile& tile,
                      const render::native::BackdropPicture& behind, render::native::NearLayer& layer) {
    layer.begin(tile, behind);
    for (std::size_t i = 0; i < people.size(); ++i) {
        const render::native::Rect r = people.bounds(i);
        if (r.x0 < tile.x1 && r.x1 > tile.x0 && r.y0 < tile.y1 && r.y1 > tile.y0) people.draw(i, layer);
    }
    layer.resolve();
}

inline Layer draw(render::native::TrianglePeople& people, const render::View& view,
                  std::span<const render::Person* const> whom, const render::native::BackdropPicture& behind,
                  const Cut& cut = {}) {
    Layer out{view.width, view.height, {}, {}};
    out.rgba.resize(static_cast<std::size_t>(view.width) * view.height);
    out.depth.resize(out.rgba.size());
    std::vector<render::native::Tile> tiles;
    for (int y = 0; y < view.height; y += cut.tile_height)
        for (int x = 0; x < view.width; x += cut.tile_width)
            tiles.push_back(
                {x, y, std::min(x + cut.tile_width, view.width), std::min(y + cut.tile_height, view.height)});
    tbb::task_arena arena(cut.threads);
    arena.execute([&] {
        people.prepare(view, whom);
        tbb::enumerable_thread_specific<render::native::NearLayer> layers;
        tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
            render::native::NearLayer& layer = layers.local();
            draw_tile(people, tiles[t], behind, layer);
            const render::native::Rect r = layer.touched();
            for (int y = r.y0; y < r.y1; ++y) {
                for (int x = r.x0; x < r.x1; ++x) {
                    const std::uint16_t* pixel = layer.rgba(y) + 4 * (x - tiles[t].x0);
                    std::copy_n(pixel, 4, out.rgba[out.at(x, y)].begin());
                    out.depth[out.at(x, y)] = layer.depth(y)[x - tiles[t].x0];
                }
            }
        });
    });
    return out;
}

}  // namespace tests
