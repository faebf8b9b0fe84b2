// The shade around people's feet in a tile, against what it is defined as, in double precision.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "render/native/contact_tile.h"
#include "render/native/tile_lists.h"
#include "tests/native/painting.h"

namespace {

using render::ContactShade;
using render::native::BackdropPicture;
using render::native::Rect;
using render::native::Tile;

constexpr int width = 300, height = 170;  // [px] neither a multiple of a tile's side nor of a vector's
constexpr std::uint32_t grey = 0xff5a96c8;

const render::View view = render::make_view({{3, 4, 9}, {0, 0, 0}, 0.8}, width, height);

glm::dvec3 ray(int x, int y) {
    return glm::dvec3(view.forward) + ((x + 0.5) * 2 / width - 1) * view.tan_half_x * glm::dvec3(view.right) +
           (1 - (y + 0.5) * 2 / height) * view.tan_half_y * glm::dvec3(view.up);
}

// [m] to where the level plane at a height is seen, or infinite.
double depth_of(double at_height, int x, int y) {
    const double away = (at_height - view.position.y) / ray(x, y).y;
    return away > 0 ? away : INFINITY;
}

// A level plane of one colour, and sky.
BackdropPicture plane(double at_height) {
    BackdropPicture picture = tests::empty_picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            picture.color.row(y)[x] = grey;
            picture.depth.row(y)[x] = static_cast<float>(render::near_plane / depth_of(at_height, x, y));
        }
    return picture;
}

ContactShade shade_at(glm::vec3 world, float radius, float strength) {
    const float peak = std::sqrt(strength);
    return {view.relative(world), radius, peak, peak / (radius * radius)};
}

// The whole picture, tile by tile.
std::vector<std::uint32_t> darken(const BackdropPicture& picture, const std::vector<ContactShade>& shades,
                                  const std::vector<Rect>& bounds) {
    render::native::ContactTile contact;
    render::native::TileGrid grid(width, height);
    render::native::TileLists lists;
    lists.fill(grid, bounds);
    std::vector<std::uint32_t> out(std::size_t{width} * height);
    for (std::size_t i = 0; i < grid.count(); ++i) {
        const Tile tile = grid.tile(i);
        const auto colors = contact.darken(view, tile, picture, shades, bounds, lists.of(i));
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                out[std::size_t{width} * y + x] = colors.row(y - tile.y0)[x - tile.x0];
    }
    return out;
}
std::vector<std::uint32_t> darken(const BackdropPicture& picture, const std::vector<ContactShade>& shades) {
    std::vector<Rect> bounds;
    for (const ContactShade& shade : shades) bounds.push_back(render::native::bounds_of(view, shade));
    return darken(picture, shades, bounds);
}

// Two beside one another, one in a corner, one under the camera, one out of sight and one behind.
const std::vector<ContactShade> people = {shade_at({0, 0, 0}, 0.5f, 0.55f),     shade_at({0.4f, 0, 0.2f}, 0.6f, 0.3f),
                                          shade_at({-3.6f, 0, -1}, 0.5f, 0.5f), shade_at({2.4f, 0, 5.5f}, 1.5f, 0.5f),
                                          shade_at({40, 0, 0}, 0.5f, 0.5f),     shade_at({3, 3, 12}, 0.5f, 0.5f)};

TEST(ContactTile, LeavesWhatItIsDefinedAs) {
    const BackdropPicture picture = plane(0);
    const std::vector<std::uint32_t> found = darken(picture, people);
    int darkened = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double depth = depth_of(0, x, y);
            double left = 1;
            for (const ContactShade& shade : people) {
                if (std::isinf(depth)) continue;
                const glm::dvec3 away = depth * ray(x, y) - glm::dvec3(shade.feet);
                const double out = glm::dot(away, away) / (shade.radius * shade.radius);
                left *= 1 - shade.peak * shade.peak * std::pow(std::max(1 - out, 0.0), 2);
            }
            darkened += left < 1;
            const std::uint32_t pixel = found[std::size_t{width} * y + x];
            for (const int shift : {0, 8, 16})
                EXPECT_NEAR(pixel >> shift & 255, left * (grey >> shift & 255), 0.501) << x << ", " << y;
            EXPECT_EQ(pixel >> 24, 255u);
            EXPECT_EQ(picture.color.row(y)[x], grey) << "what is behind was painted over";
        }
    EXPECT_GT(darkened, width * height / 20);
}

TEST(ContactTile, TouchesNothingBeyondItsBounds) {
    const BackdropPicture picture = plane(0);
    EXPECT_EQ(darken(picture, people), darken(picture, people, std::vector(people.size(), Rect{0, 0, width, height})));
}

TEST(ContactTile, IsNoneOfWhoIsInTheAirNorOnTheSky) {
    const std::vector<std::uint32_t> untouched(std::size_t{width} * height, grey);
    const float radius = 0.5f;
    EXPECT_EQ(darken(plane(0), {shade_at({0, radius + 0.01f, 0}, radius, 0.5f)}), untouched);
    EXPECT_NE(darken(plane(0), {shade_at({0, radius / 2, 0}, radius, 0.5f)}), untouched);
    EXPECT_EQ(darken(plane(100), people), untouched) << "seen from below: nothing is there";
}

TEST(ContactTile, IsTheSameOnEveryInstructionSet) {
    const BackdropPicture picture = plane(0);
    const std::vector<std::uint32_t> expected = darken(picture, people);
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        EXPECT_EQ(darken(picture, people), expected) << hwy::TargetName(rest & -rest);
        hwy::SetSupportedTargetsForTest(0);
    }
}

}  // namespace
