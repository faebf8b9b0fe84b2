#include "render/native/cover.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/view.h"

namespace render::native {

CoverTile::CoverTile() : cover_(std::size_t{tile_side} * tile_side) {}

void CoverTile::begin(const Tile& tile) {
    tile_ = tile;
    std::memset(cover_.data(), 0, cover_.size() * sizeof(Cover));
}

void CoverTile::lay(const SplatPerson& person, const Patch& patch, const BackdropPicture& behind) {
    for (int y = std::max(patch.y0, tile_.y0); y < std::min(patch.y0 + patch.height, tile_.y1); ++y)
        lay_row(person, patch, behind, y);
}

void CoverTile::lay_row(const SplatPerson& person, const Patch& patch, const BackdropPicture& behind, int y) {
    const std::int16_t* cells = patch.cells + std::ptrdiff_t{8} * patch.width * (y - patch.y0);
    const float* depth = behind.depth.row(y);
    Cover* cover = row(y);
    const float nearest = near_plane, middle = person.depth, reach = person.reach;
    for (int x = std::max(patch.x0, tile_.x0); x < std::min(patch.x0 + patch.width, tile_.x1); ++x) {
        const std::int16_t* cell = cells + 8 * (x - patch.x0);
        int share = cell[3];
        if (share <= 0) continue;
        Cover& to = cover[x];
        const int open = pixel_full - to.share;
        if (open <= 0) continue;
        const float back = middle + reach * static_cast<float>(cell[4]) / static_cast<float>(share);
        if (back * depth[x] >= nearest) continue;
        int red = cell[0], green = cell[1], blue = cell[2];
        if (share > cell_full) {
            red = red * cell_full / share;
            green = green * cell_full / share;
            blue = blue * cell_full / share;
            share = cell_full;
        }
        const auto part = [open](int value) { return static_cast<std::uint16_t>((value * open + 4096) >> 13); };
        to.red = static_cast<std::uint16_t>(to.red + part(red));
        to.green = static_cast<std::uint16_t>(to.green + part(green));
        to.blue = static_cast<std::uint16_t>(to.blue + part(blue));
        to.share = static_cast<std::uint16_t>(std::min<int>(to.share + part(share), pixel_full));
    }
}

void CoverTile::resolve(const BackdropPicture& behind, Plane<std::uint32_t>& out) const {
    for (int y = tile_.y0; y < tile_.y1; ++y) {
        const Cover* cover = &cover_[static_cast<std::size_t>(y - tile_.y0) * tile_side];
        const std::uint32_t* back = behind.color.row(y) + tile_.x0;
        std::uint32_t* to = out.row(y) + tile_.x0;
        for (int x = 0; x < tile_.x1 - tile_.x0; ++x) {
            if (cover[x].share == 0) {
                to[x] = back[x];
                continue;
            }
            const float open = static_cast<float>(pixel_full - cover[x].share) / 32767.0f;
            const auto channel = [&](std::uint16_t light, int shift) {
                const float c = static_cast<float>(back[x] >> shift & 255u) / 255.0f;
                const float sum = static_cast<float>(light) / 32767.0f + open * c * c;
                return static_cast<std::uint32_t>(std::sqrt(std::min(sum, 1.0f)) * 255.0f + 0.5f) << shift;
            };
            to[x] = channel(cover[x].red, 0) | channel(cover[x].green, 8) | channel(cover[x].blue, 16) | 255u << 24;
        }
    }
}

}  // namespace render::native
