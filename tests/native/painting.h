// Whole pictures of a native background.
#pragma once

#include <algorithm>
#include <vector>

#include "render/native/backdrop.h"

namespace tests {

inline render::native::BackdropPicture empty_picture(int width, int height) {
    const int across = render::native::blocks_across(width), down = render::native::blocks_across(height);
    return {width, height, {width, height}, {width, height}, {across, down}, {across, down}};
}

inline std::vector<render::native::Tile> tiles_of(int width, int height, int side) {
    std::vector<render::native::Tile> tiles;
    for (int y = 0; y < height; y += side)
        for (int x = 0; x < width; x += side)
            tiles.push_back({x, y, std::min(x + side, width), std::min(y + side, height)});
    return tiles;
}

inline render::native::BackdropPicture paint(render::native::Backdrop& backdrop, const render::View& view) {
    render::native::BackdropPicture picture = empty_picture(view.width, view.height);
    backdrop.aim(view);
    backdrop.paint({0, 0, view.width, view.height}, picture);
    return picture;
}

}  // namespace tests
