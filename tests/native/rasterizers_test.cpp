// Both rasterisers, the background's and the near people's, under hostile triangles: what every sample shows is held
// against a rasteriser that tries every triangle on it, in whole numbers and doubles.
//
// With --gtest_shuffle --gtest_repeat=N --gtest_random_seed=S these are N other sets of triangles, S, S + 1, ...
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "render/native/clip.h"
#include "render/native/fill.h"
#include "render/native/raster.h"
#include "tests/native/exact_triangle.h"
#include "tests/native/layers.h"
#include "tests/render/stiff_mesh.h"

namespace {

using namespace render::native;
using tests::Chance;
using tests::ExactTriangle;
using tests::GridPoint;

unsigned seed_of(unsigned round) {
    return 100000u * static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()) + round;
}

// What a sample may show: whatever covers it, unless something else is nearer by more than rounding may be.
class Sample {
public:
    explicit Sample(double behind) : least_(behind) { seen_.push_back({0, behind, 0}); }

    void add(std::uint32_t who, double depth, double rounding) {
        seen_.push_back({who, depth, rounding});
        least_ = std::max(least_, depth - rounding);
    }
    bool may_show(std::uint32_t who, double depth) const {
        for (const Seen& one : seen_)
            if (one.who == who && one.depth + one.rounding >= least_ && std::abs(depth - one.depth) <= one.rounding)
                return true;
        return false;
    }
    std::string expected() const {
        std::string text;
        for (const Seen& one : seen_)
            text += " " + std::to_string(one.who) + ": " + std::to_string(one.depth) + " +- " +
                    std::to_string(one.rounding);
        return text;
    }

private:
    struct Seen {
        std::uint32_t who;
        double depth, rounding;
    };
    std::vector<Seen> seen_;
    double least_;
};

// In (0, 1], of all magnitudes, and often alike.
std::array<double, 3> hostile_depths(Chance& chance) {
    std::array<double, 3> depths;
    const double near = std::pow(10, chance.real(-4, 0));
    for (double& depth : depths) {
        const double other = std::pow(10, chance.real(-4, 0));
        depth = static_cast<double>(static_cast<float>(chance.one_in(3) ? other : near));
    }
    return depths;
}

constexpr int sizes[] = {1, 7, 129, 200, 300, 8192};  // [px] of pictures

// ---- the background ----

// A cell somewhere in a picture, and triangles that reach as far as any may.
struct CellScene {
    int width, height, x0, y0;
    std::vector<ExactTriangle> triangles;

    explicit CellScene(Chance& chance) : width(sizes[chance.below(6)]), height(sizes[chance.below(6)]) {
        x0 = tile_side * static_cast<int>(chance.below((width + tile_side - 1) / tile_side));
        y0 = tile_side * static_cast<int>(chance.below((height + tile_side - 1) / tile_side));
        constexpr std::int64_t band = std::int64_t{guard_band} * subpixels;
        const auto steps = [](int pixels) { return std::int64_t{pixels} * subpixels; };
        const tests::Field field{{-band, -band},
                                 {steps(width) + band, steps(height) + band},
                                 {steps(x0), steps(y0)},
                                 {steps(std::min(x0 + tile_side, width)), steps(std::min(y0 + tile_side, height))},
                                 subpixels};
        for (unsigned i = 1 + chance.below(12); i > 0; --i)
            triangles.push_back({tests::hostile_corners(field, chance), hostile_depths(chance)});
    }

    static GridPoint sample(int x, int y, SamplePoint at) {
        constexpr int step = subpixels / sample_steps;
        return {std::int64_t{subpixels} * x + step * at.x, std::int64_t{subpixels} * y + step * at.y};
    }
};

// As a picture has it: corners that are projected, one panel a triangle. Shows who is where: their number from 1.
template <int samples>
std::unique_ptr<Cell<samples>> draw(const CellScene& scene) {
    const std::size_t count = 3 * scene.triangles.size();
    ScreenCorners screen(count);
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < count; ++i) {
        // Counter-clockwise where y is up is clockwise where it is down, and the other way around.
        const ExactTriangle& triangle = scene.triangles[i / 3];
        const std::size_t corner = (3 - i % 3) % 3;
        screen.x[i] = static_cast<std::int32_t>(triangle.corners[corner].x);
        screen.y[i] = static_cast<std::int32_t>(triangle.corners[corner].y);
        screen.depth[i] = static_cast<float>(triangle.depth[corner]);
        screen.sides[i] = 0;
        const auto first = static_cast<std::uint32_t>(i);
        if (i % 3 == 0)
            panels.push_back({{first, first + 1, first + 2, first + 2}, static_cast<std::uint32_t>(i / 3 + 1)});
    }
    render::View view;
    view.width = scene.width;
    view.height = scene.height;
    std::vector<ScreenTriangle> triangles;
    add_visible(view, Corners({glm::vec3(0)}), screen, panels, triangles);
    std::vector<std::uint32_t> all(triangles.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    auto cell = std::make_unique<Cell<samples>>();
    cell->x0 = scene.x0;
    cell->y0 = scene.y0;
    cell->last_column = (std::min(scene.width - scene.x0, tile_side) - 1) / block_side;
    cell->last_row = (std::min(scene.height - scene.y0, tile_side) - 1) / block_side;
    clear(*cell, scene.width, scene.height);
    rasterize(triangles, all, 0, *cell);
    return cell;
}

// Depth is stepped in floats from a block's first pixel on, so this is what is lost of the depths that its plane has
// around there.
double rounding_in_blocks(const ExactTriangle& triangle) {
    const double within_block = 0x1p-21 * block_side * subpixels * triangle.steepness();
    return 0x1p-21 * triangle.nearest() + std::min(within_block, triangle.nearest() - triangle.farthest());
}

struct SampleSeen {
    std::uint32_t surface;
    float depth;
};

// Number `number` of a pixel of the cell.
template <int samples>
SampleSeen seen_in(Cell<samples>& cell, int x, int y, int number) {
    const std::size_t block = cell.block(x / block_side, y / block_side);
    const int column = x % block_side, row = y % block_side;
    if (cell.is_sheet[block]) {
        const SamplePoint at = sample_points<samples>[static_cast<std::size_t>(number)];
        const auto pixels = [](int whole, int steps) {
            return static_cast<float>(sample_steps * whole + steps) / sample_steps;
        };
        return {cell.sheet[block].surface, cell.sheet[block].at(pixels(column, at.x), pixels(row, at.y))};
    }
    const int i = number * block_pixels + row * block_side + column;
    return {cell.surfaces(block)[i], cell.depths(block)[i]};
}

template <int samples>
void expect_what_samples_see() {
    int covered = 0;
    for (unsigned round = 0; round < 400; ++round) {
        Chance chance(seed_of(round));
        CellScene scene(chance);
        const std::unique_ptr<Cell<samples>> cell = draw<samples>(scene);
        for (int i = 0; i < tile_side * tile_side * samples; ++i) {
            const int number = i % samples, x = i / samples % tile_side, y = i / samples / tile_side;
            if (x / block_side > cell->last_column || y / block_side > cell->last_row) continue;
            const SampleSeen seen = seen_in(*cell, x, y, number);
            if (scene.x0 + x >= scene.width || scene.y0 + y >= scene.height) {
                ASSERT_EQ(seen.surface, finished) << "beyond the picture";
                continue;
            }
            const GridPoint place =
                CellScene::sample(scene.x0 + x, scene.y0 + y, sample_points<samples>[static_cast<std::size_t>(number)]);
            Sample sample(0);
            for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
                const ExactTriangle& triangle = scene.triangles[t];
                if (triangle.area() <= 0 || !triangle.covers(place)) continue;
                ++covered;
                sample.add(static_cast<std::uint32_t>(t + 1), triangle.depth_at(place), rounding_in_blocks(triangle));
            }
            ASSERT_TRUE(sample.may_show(seen.surface, static_cast<double>(seen.depth)))
                << "round " << round << ", " << x << ' ' << y << " sample " << number << " shows " << seen.surface
                << " at " << seen.depth << ", expected one of" << sample.expected();
        }
    }
    EXPECT_GT(covered, 100000 * samples);
}

TEST(BackgroundRasteriser, ShowsWhatEveryPixelsCenterSees) {
    expect_what_samples_see<1>();
}
TEST(BackgroundRasteriser, ShowsWhatEveryPixelsSamplesSee) {
    expect_what_samples_see<most_samples>();
}

// ---- near people ----

constexpr int steps = grid_per_sample;

GridPoint sample_at(int x, int y) {
    return {std::int64_t{steps} * x + steps / 2, std::int64_t{steps} * y + steps / 2};
}

// A tile of a picture, and what is seen of its samples.
struct TileScene {
    int width, height;
    Tile tile;
    float behind_depth;
    BackdropPicture behind;
    NearLayer layer;

    explicit TileScene(Chance& chance, bool is_small = false)
        : width(sizes[chance.below(is_small ? 3 : 5)]),
          height(sizes[chance.below(is_small ? 3 : 5)]),
          behind_depth(chance.one_in(2) ? 0.0f : static_cast<float>(chance.real(0, 0.1))),
          behind(tests::backdrop(width, height, behind_depth)) {
        tile.x0 = tile_side * static_cast<int>(chance.below((width + tile_side - 1) / tile_side));
        tile.y0 = tile_side * static_cast<int>(chance.below((height + tile_side - 1) / tile_side));
        tile.x1 = std::min(tile.x0 + tile_side, width);
        tile.y1 = std::min(tile.y0 + tile_side, height);
        layer.begin(tile, behind);
    }
    tests::Field field(std::int64_t reach, const GridPoint& origin) const {
        constexpr std::int64_t pixel = samples_across * steps;
        return {{-reach, -reach},
                {reach, reach},
                {std::max(pixel * tile.x0 - origin.x, -reach), std::max(pixel * tile.y0 - origin.y, -reach)},
                {std::min(pixel * tile.x1 - origin.x, reach), std::min(pixel * tile.y1 - origin.y, reach)},
                steps};
    }
    // Calls `look` with where each sample of the tile is in the picture [samples], who is there and how near.
    template <typename Look>
    void for_each_sample(Look look) {
        for (int y = 0; y < samples_across * (tile.y1 - tile.y0); y += sample_block_side)
            for (int x = 0; x < samples_across * (tile.x1 - tile.x0); x += sample_block_side) {
                const Block block = layer.block(x / sample_block_side, y / sample_block_side);
                for (int i = 0; i < block_samples; ++i) {
                    const int sx = samples_across * tile.x0 + x + sample_x(i);
                    const int sy = samples_across * tile.y0 + y + sample_y(i);
                    if (sx >= samples_across * width || sy >= samples_across * height) continue;
                    look(sx, sy, block.red_green[i] & 0xffffu, static_cast<double>(block.depth[i]));
                }
            }
    }
};

// In red, exactly.
float light_of(std::size_t who) {
    return static_cast<float>(who) / full;
}

// Of depths that are sums of the corners' by how near they are.
double rounding_of_shares(const ExactTriangle& triangle) {
    return 2e-6 * triangle.nearest();
}

// Fails where a sample shows what none of the triangles explains; those that have no area or face away show nothing.
// Returns how many samples were covered, all triangles together.
int compare_samples(TileScene& scene, const std::vector<ExactTriangle>& triangles, unsigned round) {
    int covered = 0;
    scene.for_each_sample([&](int x, int y, std::uint32_t who, double depth) {
        Sample sample(static_cast<double>(scene.behind_depth));
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (triangles[i].area() <= 0 || !triangles[i].covers(sample_at(x, y))) continue;
            ++covered;
            sample.add(static_cast<std::uint32_t>(i + 1), triangles[i].depth_at(sample_at(x, y)),
                       rounding_of_shares(triangles[i]));
        }
        ASSERT_TRUE(sample.may_show(who, depth)) << "round " << round << ", " << x << ' ' << y << " shows " << who
                                                 << " at " << depth << ", expected one of" << sample.expected();
    });
    return covered;
}

// Triangles that have nothing to do with each other, each with corners of its own.
model::Character loose_triangles(std::size_t count, bool double_sided) {
    model::Character character;
    model::Mesh& mesh = character.mesh;
    mesh.materials.emplace_back();
    mesh.materials[0].double_sided = double_sided;
    for (std::size_t i = 0; i < 3 * count; ++i) {
        mesh.indices.push_back(static_cast<std::uint32_t>(i));
        tests::add_vertex(mesh, glm::vec3(i % 3, i % 2, i / 3), {0, 1, 0});
    }
    tests::add_only_joint(character);
    return character;
}

TEST(PeoplesRasteriser, OnTheGridShowsWhatEverySampleSees) {
    int covered = 0;
    for (unsigned round = 0; round < 300; ++round) {
        Chance chance(seed_of(round));
        TileScene scene(chance);
        const bool double_sided = chance.one_in(2);
        const std::size_t count = 1 + chance.below(40);
        const model::Character character = loose_triangles(count, double_sided);
        const motion::PoseTable poses = motion::bake_poses(character, {}, {}, 1 << 20);
        const PersonMesh mesh({&character.mesh, &poses, nullptr});
        // Somewhere around the tile.
        const auto around = [&](int from, int end) {
            const int reach = chance.one_in(2) ? 8 : 900;
            const auto at = chance.whole(samples_across * from - reach, samples_across * end + reach);
            return sample_block_side * static_cast<int>(std::floor(static_cast<double>(at) / sample_block_side));
        };
        const int origin_x = around(scene.tile.x0, scene.tile.x1), origin_y = around(scene.tile.y0, scene.tile.y1);
        const GridPoint origin{std::int64_t{steps} * origin_x, std::int64_t{steps} * origin_y};
        const tests::Field field = scene.field(reach_on_grid / 2, origin);
        std::vector<ExactTriangle> triangles;
        std::vector<std::uint32_t> packed((3 * count + group - 1) / group * group);
        const auto lit = hwy::AllocateAligned<LitVertex>(2 * packed.size());
        float nearest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            triangles.push_back({tests::hostile_corners(field, chance), hostile_depths(chance)});
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t vertex = mesh.faces[i].corners[k];
                const GridPoint& at = triangles[i].corners[k];
                packed[vertex] = (static_cast<std::uint32_t>(at.x) & 0xffffu) | static_cast<std::uint32_t>(at.y) << 16;
                lit[vertex] = {{light_of(i + 1), 0, 0}, static_cast<float>(triangles[i].depth[k])};
                lit[mesh.behind() + vertex] = lit[vertex];
                nearest = std::max(nearest, lit[vertex].depth);
            }
            if (double_sided && triangles[i].area() < 0) triangles[i].turn_around();
            for (GridPoint& corner : triangles[i].corners) corner = {corner.x + origin.x, corner.y + origin.y};
        }
        const auto facing = hwy::AllocateAligned<FacingTriangle>((count + group - 1) / group * group + group);
        const std::uint32_t facing_count = find_facing(mesh, packed.data(), facing.get());
        const std::vector<Tint> tints(mesh.paints.size(), Tint{full, full, full});
        fill(mesh,
             {{facing.get(), facing_count},
              origin_x,
              origin_y,
              {0, 0, scene.width, scene.height},
              nearest,
              lit.get(),
              tints.data()},
             scene.layer);
        covered += compare_samples(scene, triangles, round);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(covered, 100000);
}

Corner look_of(std::size_t who, double depth) {
    return {{light_of(who), 0, 0}, static_cast<float>(depth), {full, full, full}, 0, 0};
}

WideTriangle wide(const ExactTriangle& triangle, std::size_t who) {
    WideTriangle out;
    out.texturing = {};
    for (int k = 0; k < 3; ++k) {
        out.x[k] = static_cast<std::int32_t>(triangle.corners[k].x);
        out.y[k] = static_cast<std::int32_t>(triangle.corners[k].y);
        out.corners[k] = look_of(who, triangle.depth[k]);
    }
    return out;
}

TEST(PeoplesRasteriser, OfAnySizeShowsWhatEverySampleSees) {
    int covered = 0;
    for (unsigned round = 0; round < 300; ++round) {
        Chance chance(seed_of(round));
        TileScene scene(chance);
        const tests::Field field = scene.field(wide_reach, {});
        std::vector<ExactTriangle> triangles;
        std::vector<WideTriangle> drawn;
        for (unsigned i = 1 + chance.below(12); i > 0; --i) {
            ExactTriangle triangle{tests::hostile_corners(field, chance), hostile_depths(chance)};
            if (triangle.area() < 0) triangle.turn_around();
            if (triangle.area() == 0) continue;
            triangles.push_back(triangle);
            drawn.push_back(wide(triangle, triangles.size()));
        }
        fill(TextureLayers(), drawn, scene.layer);
        covered += compare_samples(scene, triangles, round);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(covered, 100000);
}

// ---- near people, cut by the near plane and far beside the picture ----

// A camera's way from metres to the grid.
struct Lens {
    double center_x, center_y, steps_a_metre;

    Lens(const TileScene& scene, double fov_y)
        : center_x(0.5 * samples_across * steps * scene.width),
          center_y(0.5 * samples_across * steps * scene.height),
          steps_a_metre(center_y / std::tan(0.5 * fov_y)) {}

    PlacedCorner placed(const glm::dvec3& at, std::size_t who) const {
        return {{steps_a_metre * at.x, steps_a_metre * at.y, at.z}, look_of(who, 0)};
    }
    std::array<PlacedCorner, 3> placed(const std::array<glm::dvec3, 3>& at, std::size_t who) const {
        return {placed(at[0], who), placed(at[1], who), placed(at[2], who)};
    }
};

// Right, down and forward [m]: before and behind the camera and in it, on the near plane, up to 1e15 m away, thin, of
// no area.
std::array<glm::dvec3, 3> hostile_places(Chance& chance) {
    const auto at = [&](double reach) {
        const double x = chance.real(-reach, reach), y = chance.real(-reach, reach);
        return glm::dvec3(x, y, chance.real(-reach, reach));
    };
    const double near = static_cast<double>(render::near_plane);
    const double reach = std::pow(10, chance.real(-2, 3));
    std::array<glm::dvec3, 3> p{at(reach), at(reach), at(reach)};
    switch (chance.below(9)) {
        case 0:
            p[chance.below(3)] = at(1e6);
            break;
        case 1:
            p[chance.below(3)] = at(1e15);
            break;
        case 2:
            p[chance.below(3)].z = near;
            break;
        case 3:
            p[0].z = p[1].z = near;
            break;
        case 4:
            p[chance.below(3)] = glm::dvec3(0);
            break;
        case 5:
            p[2] = p[chance.below(2)];
            break;
        case 6:
            p[2] = glm::mix(p[0], p[1], chance.real(-1, 2)) + at(1e-4 * reach);
            break;
        case 7:
            for (glm::dvec3& corner : p) corner = glm::dvec3(0, 0, 3) + at(0.02);
            break;
        default:
            break;
    }
    return p;
}

// By the ray through a sample, without cutting or projecting anything.
struct Cast {
    bool is_inside, is_sure;  // no edge is so near that the grid decides
    double depth, rounding;   // of well-shaped triangles
};

// Of the edges from `first_edge` on: without the first, of a half-open triangle.
Cast cast(const std::array<glm::dvec3, 3>& p, const Lens& lens, bool double_sided, const GridPoint& sample,
          int first_edge = 0) {
    constexpr double snap = 1.0;  // [grid steps] Corners move by half of one along x and y, and edges with them.
    const glm::dvec3 ray((static_cast<double>(sample.x) - lens.center_x) / lens.steps_a_metre,
                         (static_cast<double>(sample.y) - lens.center_y) / lens.steps_a_metre, 1);
    Cast out{true, true, 0, 0};
    const auto side = [&](const glm::dvec3& normal) {  // > 0: inside
        const double here = glm::dot(normal, ray), all = glm::dot(glm::abs(normal), glm::abs(ray));
        const double a_step = std::hypot(normal.x, normal.y) / lens.steps_a_metre;
        constexpr double double_rounding = 1e-14;
        if (std::abs(here) <= snap * a_step + double_rounding * all) out.is_sure = false;
        out.is_inside = out.is_inside && here > 0;
        return here;
    };
    // Without differences of corners, where the near one would be lost in the far one's rounding.
    const glm::dvec3 normal = glm::cross(p[0], p[1]) + glm::cross(p[1], p[2]) + glm::cross(p[2], p[0]);
    const double volume = glm::dot(p[0], glm::cross(p[1], p[2]));
    if (volume == 0) return {false, true, 0, 0};
    // Clockwise on the screen, where y is down, is a normal away from the viewer.
    const double facing = volume > 0 ? 1 : -1;
    out.is_inside = facing > 0 || double_sided;
    for (int i = first_edge; i < 3; ++i) side(facing * glm::cross(p[i], p[(i + 1) % 3]));
    // Depth, which is linear on the screen: the near plane is where it is 1.
    const double near = static_cast<double>(render::near_plane);
    const glm::dvec3 depth = near / volume * normal;
    side(-depth + glm::dvec3(0, 0, 1));
    side(depth);
    out.depth = glm::dot(depth, ray);
    out.rounding = 2 * snap * std::hypot(depth.x, depth.y) / lens.steps_a_metre + 1e-5;
    return out;
}

struct Drawn {
    std::vector<std::uint8_t> covered;
    std::vector<double> depth;
};

Drawn draw(TileScene& scene, const Lens& lens, const std::vector<std::array<glm::dvec3, 3>>& places,
           bool double_sided) {
    std::vector<WideTriangle> triangles;
    for (const auto& place : places)
        append_clipped(lens.placed(place, 1), lens.center_x, lens.center_y, double_sided, {}, triangles);
    scene.layer.begin(scene.tile, scene.behind);
    fill(TextureLayers(), triangles, scene.layer);
    Drawn out;
    scene.for_each_sample([&](int, int, std::uint32_t who, double depth) {
        out.covered.push_back(who == 1);
        out.depth.push_back(depth);
    });
    return out;
}

constexpr double fovs[] = {0.0175, 0.9, 2.967};  // [rad]: 1, 50, 170 degrees

TEST(PeoplesRasteriser, CutsTrianglesToWhatRaysMeet) {
    int inside = 0, outside = 0;
    for (unsigned round = 0; round < 1500; ++round) {
        Chance chance(seed_of(round));
        TileScene scene(chance, true);
        scene.behind = tests::backdrop(scene.width, scene.height);
        const Lens lens(scene, fovs[chance.below(3)]);
        const bool double_sided = chance.one_in(2);
        const std::array<glm::dvec3, 3> places = hostile_places(chance);
        const Drawn drawn = draw(scene, lens, {places}, double_sided);
        std::size_t at = 0;
        scene.for_each_sample([&](int x, int y, std::uint32_t, double) {
            const Cast expected = cast(places, lens, double_sided, sample_at(x, y));
            const bool is_covered = drawn.covered[at] != 0;
            const double depth = drawn.depth[at++];
            ASSERT_TRUE(depth >= 0 && depth <= 1 + 1e-6) << "round " << round << ", " << x << ' ' << y;
            if (!expected.is_sure) return;
            (expected.is_inside ? inside : outside) += 1;
            ASSERT_EQ(is_covered, expected.is_inside) << "round " << round << ", " << x << ' ' << y;
            if (is_covered) {
                ASSERT_NEAR(depth, expected.depth, expected.rounding) << "round " << round << ", " << x << ' ' << y;
            }
        });
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(inside, 20000);
    EXPECT_GT(outside, 20000);
}

TEST(PeoplesRasteriser, GivesSamplesAtASharedEdgeToOneOfItsTwoTriangles) {
    int at_edge = 0;
    for (unsigned round = 0; round < 1500; ++round) {
        Chance chance(seed_of(round));
        TileScene scene(chance, true);
        scene.behind = tests::backdrop(scene.width, scene.height);
        const Lens lens(scene, fovs[chance.below(3)]);
        auto [a, b, c] = hostile_places(chance);
        if (glm::dot(a, glm::cross(b, c)) < 0) std::swap(a, b);  // it faces the viewer, and mostly so does the other
        const glm::dvec3 d = chance.one_in(4) ? hostile_places(chance)[0] : a + b - c + chance.real(0, 1) * (b - a);
        const std::array<glm::dvec3, 3> left{a, b, c}, right{b, a, d};
        const Drawn one = draw(scene, lens, {left}, false), other = draw(scene, lens, {right}, false);
        std::size_t at = 0;
        scene.for_each_sample([&](int x, int y, std::uint32_t, double) {
            const bool in_one = one.covered[at] != 0, in_other = other.covered[at++] != 0;
            // Where another edge is as near, the grid may even turn a triangle around.
            const Cast of_one = cast(left, lens, false, sample_at(x, y), 1);
            const Cast of_other = cast(right, lens, false, sample_at(x, y), 1);
            if (!of_one.is_sure || !of_other.is_sure) return;
            ASSERT_FALSE(in_one && in_other) << "round " << round << ", " << x << ' ' << y << " is covered twice";
            // What is inside but for that edge, which is each triangle's first, is on one side of it or the other.
            if (!of_one.is_inside || !of_other.is_inside) return;
            ASSERT_TRUE(in_one || in_other) << "round " << round << ", " << x << ' ' << y << " is left out";
            at_edge += !cast(left, lens, false, sample_at(x, y)).is_sure;
        });
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(at_edge, 20);
}

}  // namespace
