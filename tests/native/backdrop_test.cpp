// The native background: the same bits on every instruction set, thread and tile, against a rasteriser of plain
// doubles.
#include "render/native/backdrop.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include "scene/places/stadium.h"
#include "tests/native/painting.h"

namespace {

using render::native::BackdropPicture;
using render::native::Tile;

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Stadium {
    scene::StadiumPlan plan = scene::plan_stadium(600);
    scene::StaticMesh structure = scene::build_structure(plan);
    scene::Cameras cameras = scene::aim_cameras(plan);
    render::native::Backdrop backdrop{structure, scene::paint_ground(plan), scene::Light{}};

    std::vector<scene::CameraPose> poses() const {
        return {cameras.still.at(0), cameras.close.at(0), cameras.medium.at(0), cameras.remote.at(0),
                cameras.roam.at(7)};
    }
};

bool are_equal(const BackdropPicture& a, const BackdropPicture& b) {
    for (int y = 0; y < a.height; ++y)
        if (std::memcmp(a.color.row(y), b.color.row(y), sizeof(std::uint32_t) * a.width) != 0 ||
            std::memcmp(a.depth.row(y), b.depth.row(y), sizeof(float) * a.width) != 0)
            return false;
    const int across = render::native::blocks_across(a.width);
    for (int y = 0; y < render::native::blocks_across(a.height); ++y)
        if (std::memcmp(a.farthest.row(y), b.farthest.row(y), sizeof(float) * across) != 0) return false;
    return true;
}

// Restores the processor's own instruction sets.
struct OnlyTarget {
    explicit OnlyTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
    ~OnlyTarget() { hwy::SetSupportedTargetsForTest(0); }
};

TEST(NativeBackdrop, IsTheSameOnEveryInstructionSet) {
    const std::int64_t all = hwy::SupportedTargets();
    for (const auto& [width, height] : {std::pair(323, 187), std::pair(1, 1), std::pair(64, 8)})
        for (std::size_t camera = 0; camera < Stadium().poses().size(); ++camera) {
            std::optional<BackdropPicture> first;
            for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
                const OnlyTarget only(rest & -rest);
                Stadium stadium;
                BackdropPicture picture =
                    tests::paint(stadium.backdrop, render::make_view(stadium.poses()[camera], width, height));
                if (first)
                    EXPECT_TRUE(are_equal(*first, picture)) << hwy::TargetName(rest & -rest) << ", camera " << camera;
                else
                    first = std::move(picture);
            }
        }
}

TEST(NativeBackdrop, IsTheSameForAnyThreadsAndTiles) {
    Stadium stadium;
    for (const scene::CameraPose& pose : stadium.poses()) {
        const render::View view = render::make_view(pose, 517, 301);
        const BackdropPicture whole = tests::paint(stadium.backdrop, view);
        for (const int threads : {1, 2, 3, 8}) {
            oneapi::tbb::task_arena arena(threads);
            for (const int side : {8, 24, 128, 200}) {
                BackdropPicture picture = tests::empty_picture(view.width, view.height);
                arena.execute([&] {
                    stadium.backdrop.aim(view);
                    const std::vector<Tile> tiles = tests::tiles_of(view.width, view.height, side);
                    oneapi::tbb::parallel_for(std::size_t{0}, tiles.size(),
                                              [&](std::size_t i) { stadium.backdrop.paint(tiles[i], picture); });
                });
                EXPECT_TRUE(are_equal(whole, picture)) << threads << " threads, tiles of " << side;
            }
        }
    }
}

TEST(NativeBackdrop, KnowsTheFarthestOfEveryBlock) {
    Stadium stadium;
    const BackdropPicture picture = tests::paint(stadium.backdrop, render::make_view(stadium.poses()[3], 333, 99));
    for (int row = 0; row < render::native::blocks_across(99); ++row)
        for (int column = 0; column < render::native::blocks_across(333); ++column) {
            float least = infinity;
            for (int y = 8 * row; y < std::min(8 * row + 8, 99); ++y)
                for (int x = 8 * column; x < std::min(8 * column + 8, 333); ++x)
                    least = std::min(least, picture.depth.row(y)[x]);
            EXPECT_EQ(picture.farthest.row(row)[column], least);
        }
}

// From a kilometre away, from above and from where nothing of the scene is a pixel: whatever looks down sees ground.
TEST(NativeBackdrop, HasGroundWhereverACameraLooksDown) {
    Stadium stadium;
    constexpr double least_dip = 0.02;  // [rad] ten kilometres up the sheet ends that far below the horizon
    constexpr int width = 320, height = 180;
    for (const glm::dvec3 position : {glm::dvec3(1000, 300, 400), glm::dvec3(10, 1000, 5), glm::dvec3(3000, 30, -4000),
                                      glm::dvec3(-1e5, 1e4, 1e5)}) {
        const render::View view = render::make_view({position, {0, 0, 0}, 1}, width, height);
        const BackdropPicture picture = tests::paint(stadium.backdrop, view);
        int looking_down = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float u = (2 * static_cast<float>(x) + 1) / width - 1,
                            v = 1 - (2 * static_cast<float>(y) + 1) / height;
                const glm::vec3 ray = view.forward + u * view.tan_half_x * view.right + v * view.tan_half_y * view.up;
                if (glm::normalize(ray).y > -least_dip) continue;
                ++looking_down;
                ASSERT_GT(picture.depth.row(y)[x], 0) << x << ", " << y << " from " << position.x << ", " << position.y;
            }
        EXPECT_GT(looking_down, width * height / 3);
    }
}

// Triangles of one colour each; `corners` three a triangle.
scene::StaticMesh mesh_of(const std::vector<glm::vec3>& corners) {
    scene::StaticMesh mesh;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto id = static_cast<std::uint8_t>(1 + i / 3 % 250);
        mesh.vertices.push_back({corners[i], glm::vec3(0, 1, 0), glm::u8vec4(id, 255 - id, 40, 0)});
        mesh.indices.push_back(static_cast<std::uint32_t>(i));
    }
    constexpr float everywhere = 1e30f;
    mesh.sectors = {{{glm::vec3(-everywhere), glm::vec3(everywhere)}, 0, static_cast<std::uint32_t>(corners.size())}};
    return mesh;
}

// Light that shows colours as they are.
scene::Light plain_light() {
    scene::Light light;
    light.sun = light.glare = glm::vec3(0);
    light.from_above = light.from_below = glm::vec3(1);
    return light;
}

// [px] What float32 leaves open about where a camera-relative corner is on the screen.
double blur(const render::View& view, glm::dvec3 corner) {
    const double away = glm::dot(corner, glm::dvec3(view.forward));
    if (away < static_cast<double>(render::near_plane)) return 0;  // clipped in doubles
    const double across = glm::length(corner) / away;
    const double pixels = 2 * static_cast<double>(view.pixels_per_metre(1.0f));
    return 4e-7 * across * pixels * (1 + across);
}

struct Seen {
    double nearest = 0;  // reversed depth
    double slope = 0;    // of it, a pixel
    std::size_t triangle = 0;
    bool is_sure = true;  // no edge, and no two depths, are near
};

// By rays in doubles, without projecting or clipping anything: what a place on the screen [px] sees, front sides only.
Seen look(const render::View& view, const std::vector<glm::vec3>& corners, double x, double y) {
    const auto ray_at = [&](double px, double py) {
        const double across = 2 * px / view.width - 1, up = 1 - 2 * py / view.height;
        return glm::dvec3(view.forward) + across * view.tan_half_x * glm::dvec3(view.right) +
               up * view.tan_half_y * glm::dvec3(view.up);
    };
    const glm::dvec3 ray = ray_at(x, y);
    constexpr double rounding = 1.5 / 256;  // [px] corners are rounded to 1/256, which moves an edge by less than 1/256
    Seen seen;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        glm::dvec3 v[3];
        for (int c = 0; c < 3; ++c) v[c] = glm::dvec3(corners[i + c] - glm::vec3(view.position));
        if (!std::isfinite(v[0].x + v[0].y + v[0].z + v[1].x + v[1].y + v[1].z + v[2].x + v[2].y + v[2].z)) continue;
        const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
        const double nearby = rounding + std::max({blur(view, v[0]), blur(view, v[1]), blur(view, v[2])});
        // Reversed depth is linear in the pixel, as forward . ray is 1; at 1 the near plane cuts.
        const auto depth_at = [&](double px, double py) {
            return static_cast<double>(render::near_plane) * glm::dot(normal, ray_at(px, py)) / glm::dot(normal, v[0]);
        };
        const double depth = depth_at(x, y);
        const double slope = std::hypot(depth_at(x + 1, y) - depth, depth_at(x, y + 1) - depth);
        // Corners that coincide, a back, or in front of the near plane.
        if (!(glm::dot(normal, ray) < 0) || depth <= 0 || depth - 1 > nearby * slope) continue;
        bool is_near_edge = false, is_outside = false;
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 edge = glm::cross(v[c], v[(c + 1) % 3]);
            const auto side = [&](double px, double py) { return glm::dot(edge, ray_at(px, py)); };
            const double here = side(x, y);
            const double per_pixel = std::hypot(side(x + 1, y) - here, side(x, y + 1) - here);
            is_near_edge = is_near_edge || std::abs(here) <= nearby * per_pixel;
            is_outside = is_outside || here > nearby * per_pixel;
        }
        if (is_outside) continue;
        const bool is_edge_on = std::abs(glm::dot(normal, ray)) < 1e-4 * glm::length(normal) * glm::length(ray);
        if (is_near_edge || is_edge_on || std::abs(depth - 1) <= nearby * slope) seen.is_sure = false;
        if (std::abs(depth - seen.nearest) < 1e-2 * depth) seen.is_sure = false;
        if (depth > seen.nearest) seen = {depth, slope, i / 3 + 1, seen.is_sure};
    }
    return seen;
}

// Which red a pixel shows that sees these.
std::uint8_t red_of(std::size_t triangle) {
    return static_cast<std::uint8_t>(1 + (triangle - 1) % 250);
}

// What a pixel's samples see. `red`: of the mean of their light; of the sky nothing is known.
struct Pixel {
    bool is_sure = true, is_sky = true, has_sky = false, is_even = true;
    double red = 0;
    std::array<double, 4> depth{};  // reversed, the farthest first
    double steepest = 0;            // slope of the samples' surfaces
};

Pixel look_at_pixel(const render::View& view, const std::vector<glm::vec3>& corners, int x, int y) {
    Pixel pixel;
    double light = 0;
    std::size_t first = 0, count = 0;
    for (const render::native::SamplePoint& at : render::native::sample_points<4>) {
        const Seen seen = look(view, corners, x + at.x / 8.0, y + at.y / 8.0);
        pixel.is_sure &= seen.is_sure;
        pixel.is_sky &= seen.triangle == 0;
        pixel.has_sky |= seen.triangle == 0;
        if (at.x == 3) first = seen.triangle;
        pixel.is_even &= seen.triangle == first;
        pixel.depth[count++] = seen.nearest;
        pixel.steepest = std::max(pixel.steepest, seen.slope);
        if (seen.triangle > 0) light += red_of(seen.triangle) * red_of(seen.triangle) / 4.0;
    }
    pixel.red = std::sqrt(light);
    std::ranges::sort(pixel.depth);
    return pixel;
}

struct Case {
    const char* name;
    double fov_degrees;
    glm::dvec3 target;
    int width, height;
};

class Soup : public testing::TestWithParam<Case> {};

// Around the camera, large and small, across the near plane, behind it, slivers, degenerate, not finite.
std::vector<glm::vec3> soup(unsigned seed) {
    std::mt19937 bits(seed);
    const auto uniform = [&] { return static_cast<float>(bits()) * 0x1p-31f - 1.0f; };
    const auto point = [&](float size) { return size * glm::vec3(uniform(), uniform(), uniform()); };
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 90; ++i) {
        const float sizes[] = {0.3f, 3.0f, 50.0f, 20000.0f};
        const glm::vec3 a = point(i % 2 ? 5.0f : 40.0f);
        glm::vec3 b = a + point(sizes[i % 4]), c = a + point(sizes[i % 4]);
        if (i % 9 == 0) c = glm::mix(a, b, 0.4f) + point(1e-3f);
        if (i % 31 == 0) c = b;
        if (i == 40) c.x = std::numeric_limits<float>::quiet_NaN();
        if (i == 41) b.y = infinity;
        if (i == 43) c.z = -infinity;
        corners.insert(corners.end(), {a, b, c});
    }
    return corners;
}

TEST_P(Soup, IsWhatRaysSee) {
    const Case& how = GetParam();
    int sure = 0, mixed = 0, pixels = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        std::vector<glm::vec3> corners = soup(seed);
        scene::CameraPose pose{{0.1, 0.2, -0.3}, how.target, how.fov_degrees / 180 * std::numbers::pi};
        const render::View view = render::make_view(pose, how.width, how.height);
        render::native::Backdrop backdrop(mesh_of(corners), {}, plain_light());
        const BackdropPicture picture = tests::paint(backdrop, view);
        for (int y = 0; y < how.height; ++y)
            for (int x = 0; x < how.width; ++x) {
                ++pixels;
                const Pixel seen = look_at_pixel(view, corners, x, y);
                if (!seen.is_sure) continue;
                // Corners that are rounded to 1/256 px move a sliver's plane by more than that.
                const double off = 0.01 * seen.depth[1] + 0.1 * seen.steepest;
                EXPECT_NEAR(picture.depth.row(y)[x], seen.depth[1], off) << x << ' ' << y << " seed " << seed;
                if (seen.has_sky && !seen.is_sky) continue;
                ++sure;
                mixed += !seen.is_even;
                const std::uint32_t color = picture.color.row(y)[x];
                if (seen.is_sky)
                    EXPECT_EQ(picture.depth.row(y)[x], 0.0f) << x << ' ' << y << " seed " << seed;
                else
                    EXPECT_NEAR(color & 255, seen.red, seen.is_even ? 0 : 0.501) << x << ' ' << y << " seed " << seed;
            }
    }
    EXPECT_GE(sure, pixels / 3) << "too few pixels say anything";
    const bool has_edges = how.fov_degrees > 1 && pixels > 20000;
    EXPECT_GE(mixed, has_edges ? pixels / 200 : 0) << "too few edges say anything";
}

INSTANTIATE_TEST_SUITE_P(Of, Soup,
                         testing::Values(Case{"ahead", 50, {0.3, 0.4, -9}, 160, 90},
                                         Case{"up", 70, {0.1, 9, -0.3}, 61, 47},
                                         Case{"down", 70, {0.1, -9, -0.3}, 61, 47},
                                         Case{"wide", 170, {4, 1, 9}, 96, 64}, Case{"narrow", 1, {4, 1, 9}, 96, 64},
                                         Case{"slit", 50, {1, 0, -2}, 1, 300}, Case{"row", 50, {1, 0, -2}, 300, 1},
                                         Case{"pixel", 50, {0, 0, -2}, 1, 1}),
                         [](const auto& one) { return one.param.name; });

// Rectangles of two triangles each; `apart`: of two colours each, so that they are drawn as two.
scene::StaticMesh rectangles(unsigned seed, bool apart) {
    std::mt19937 bits(seed);
    const auto uniform = [&] { return static_cast<float>(bits()) * 0x1p-31f - 1.0f; };
    const auto point = [&](float size) { return size * glm::vec3(uniform(), uniform(), uniform()); };
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 a = point(30), b = point(6), d = glm::cross(b, point(i % 2 ? 0.02f : 1));
        corners.insert(corners.end(), {a, a + b, a + b + d, a, a + b + d, a + d});
    }
    scene::StaticMesh mesh = mesh_of(corners);
    for (std::size_t i = 0; i < corners.size(); ++i)
        mesh.vertices[i].color = glm::u8vec4(static_cast<std::uint8_t>(1 + i / 6), 0, apart && i % 6 > 2 ? 0 : 255, 0);
    return mesh;
}

TEST(NativeBackdrop, TwoTrianglesAsOneCoverTheSamePixels) {
    constexpr int width = 300, height = 200;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        scene::CameraPose pose;
        pose.target = {seed % 3 - 1.0, 0.1 * seed, 1};
        const render::View view = render::make_view(pose, width, height);
        render::native::Backdrop one(rectangles(seed, false), {}, plain_light());
        render::native::Backdrop two(rectangles(seed, true), {}, plain_light());
        const BackdropPicture joined = tests::paint(one, view), apart = tests::paint(two, view);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                EXPECT_EQ(joined.color.row(y)[x] & 255, apart.color.row(y)[x] & 255) << x << ' ' << y;
    }
}

// Neighbours share their edges: every pixel of a fan around the axis of view is covered, and by no two.
TEST(NativeBackdrop, NeighboursLeaveNoPixelOut) {
    std::vector<glm::vec3> corners;
    constexpr int count = 97;
    for (int i = 0; i < count; ++i) {
        const auto at = [](int k) {
            const double turn = 2 * std::numbers::pi * (k % count) / count;
            return glm::vec3(500 * std::cos(turn), 500 * std::sin(turn), -7);
        };
        corners.insert(corners.end(), {glm::vec3(0.013f, 0.021f, -7), at(i), at(i + 1)});
    }
    render::native::Backdrop backdrop(mesh_of(corners), {}, plain_light());
    scene::CameraPose pose;
    pose.target = {0, 0, -1};
    const BackdropPicture picture = tests::paint(backdrop, render::make_view(pose, 700, 500));
    for (int y = 0; y < 500; ++y)
        for (int x = 0; x < 700; ++x) ASSERT_GT(picture.depth.row(y)[x], 0.0f) << x << ' ' << y;
}

// The share of a pixel that a black wall has which covers `covered` of it from the left, or from below, before a sky of
// one colour. Right of the pixel and below it other blocks begin.
double share_of_wall(double covered, bool is_level) {
    constexpr int side = 48, at = side / 2 - 1;
    const render::View view = render::make_view({{0, 0, 0}, {0, 0, -1}}, side, side);
    constexpr float away = 10, far = 500;
    const float pixel = 2 * view.tan_half_y * away / side;
    const float end = pixel * static_cast<float>(is_level ? covered : covered - 1);
    std::vector<glm::vec3> corners{{end, -far, -away}, {end, far, -away}, {-far, 0, -away}};
    if (is_level) corners = {{-far, end, -away}, {0, -far, -away}, {far, end, -away}};
    scene::StaticMesh mesh = mesh_of(corners);
    for (scene::StaticVertex& vertex : mesh.vertices) vertex.color = glm::u8vec4(0);
    scene::Light light = plain_light();
    light.haze = light.zenith = glm::vec3(1);
    render::native::Backdrop backdrop(mesh, {}, light);
    const BackdropPicture picture = tests::paint(backdrop, view);
    const double red = picture.color.row(at)[at] & 255, sky = picture.color.row(0)[side - 1] & 255;
    return 1 - red / sky * (red / sky);
}

TEST(NativeBackdrop, EdgesCountForAsMuchOfAPixelAsTheyCover) {
    constexpr int steps = 16;
    for (const bool is_level : {false, true})
        for (int i = 1; i < steps; i += 2) {
            const double covered = static_cast<double>(i) / steps;
            // Half of the way from one sample to the next, less what the places of samples are rounded to.
            EXPECT_NEAR(share_of_wall(covered, is_level), covered, 0.08) << (is_level ? "level" : "upright");
        }
}

TEST(NativeBackdrop, SurvivesWhatIsFartherThanAnyPlace) {
    std::vector<glm::vec3> corners;
    constexpr float far = std::numeric_limits<float>::max();
    for (const glm::vec3 c : {glm::vec3(far, -far, 1), glm::vec3(1, far, -far), glm::vec3(-1e30f, 1e31f, -1e30f)})
        corners.insert(corners.end(), {glm::vec3(-1, -1, -3), glm::vec3(1, -1, -3), c, c, glm::vec3(1, 1, 1), -c});
    render::native::Backdrop backdrop(mesh_of(corners), {}, plain_light());
    const BackdropPicture picture = tests::paint(backdrop, render::make_view({{0, 0, 0}, {0, 0, -1}}, 70, 50));
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 70; ++x) EXPECT_TRUE(std::isfinite(picture.depth.row(y)[x]));
}

TEST(NativeBackdrop, TakesPicturesAsLargeAsItSays) {
    Stadium stadium;
    for (const auto& [width, height] : {std::pair(8192, 40), std::pair(24, 8192)}) {
        const BackdropPicture picture =
            tests::paint(stadium.backdrop, render::make_view(stadium.poses()[0], width, height));
        EXPECT_EQ(picture.color.row(height - 1)[width - 1] >> 24, 255u);
    }
}

TEST(NativeBackdrop, RefusesAGroundThatItHasNotGot) {
    EXPECT_THROW(render::native::Backdrop(mesh_of({}), {"street.glsl", {}}, {}), std::runtime_error);
}

}  // namespace
