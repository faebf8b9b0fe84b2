// People who are drawn block by block, a splat each: what they cover and send, and that nothing of a block changes it.
#include "render/native/far_people.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "figures/way.h"
#include "render/native/renderer.h"
#include "render/select.h"
#include "scene/static_mesh_builder.h"
#include "tests/native/far_crowd.h"
#include "tests/native/far_truth.h"
#include "tests/render/drawn_points.h"
#include "tests/render/small_scene.h"

namespace {

using render::native::Renderer;
using tests::before_black;
using tests::even_before_black;
using tests::FarFigure;
using tests::FarGathering;
using tests::FarPerson;

const std::vector<int>& clips() {
    static const std::vector<int> some = {2, 5};  // cheer and walk
    return some;
}

const FarFigure& built_in() {
    static const FarFigure one(clips());
    return one;
}

// All of one colour, or with the built-in person's.
const FarFigure& white() {
    static const glm::u8vec4 color(255);
    static const FarFigure one(clips(), &color);
    return one;
}

const FarFigure& red() {
    static const glm::u8vec4 color(255, 0, 0, 255);
    static const FarFigure one({}, &color);
    return one;
}

const FarFigure& blue() {
    static const glm::u8vec4 color(0, 0, 255, 255);
    static const FarFigure one({}, &color);
    return one;
}

scene::Palette motley(std::uint32_t seed) {
    scene::Palette palette;
    for (glm::u8vec4& color : palette.colors)
        for (int channel = 0; channel < 4; ++channel)
            color[channel] = static_cast<std::uint8_t>(60 + (seed = seed * 1664525u + 1013904223u) % 5 * 48);
    return palette;
}

render::Image shoot(Renderer& renderer, const render::Frame& frame) {
    renderer.begin(frame.view);
    renderer.draw(frame);
    return renderer.read_image();
}

// Linear light, summed over the picture, by channel.
glm::dvec3 light_of(const render::Image& image) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        sum[static_cast<int>(i % 3)] += std::pow(image.pixels[i] / 255.0, 2);
    return sum;
}

// Alone in a picture, at this height in pixels.
class Alone {
public:
    static constexpr int side = 96;

    Alone(const FarFigure& figure, const scene::Light& light, int count)
        : figure_(figure),
          light_(light),
          figures_{figure.figure()},
          people_(figures_),
          renderer_(scene::StaticMesh{}, scene::Ground{}, light, figures_, side, side) {
        for (int i = 0; i < count; ++i) people_.add_block(std::array{person(i)});
        people_.add_others();
    }

    // From any side, they turned anyhow, in any key pose and size.
    FarPerson person(int i) const {
        FarPerson one;
        one.at = glm::vec3(3.0f * static_cast<float>(i % 7), 1, -5.0f * static_cast<float>(i % 3));
        one.yaw = 0.7f * static_cast<float>(i);
        one.height = 1.5f + 0.02f * static_cast<float>(i % 25);
        one.key = static_cast<std::uint8_t>(static_cast<std::size_t>(i) * 7 % figure_.keys.poses.size());
        one.palette = motley(static_cast<std::uint32_t>(i));
        return one;
    }

    // `off`: from the picture's middle, in tangents.
    render::View view(int i, double height_px, double azimuth, double elevation, double fov, glm::dvec2 off) const {
        const FarPerson one = person(i);
        const double distance = one.height * 0.5 * side / (std::tan(0.5 * fov) * height_px);
        const glm::dvec3 middle = glm::dvec3(one.at) + glm::dvec3(0, 0.5 * one.height, 0);
        const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                              std::cos(azimuth) * std::cos(elevation));
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right);
        const glm::dvec3 eye = middle + distance * (back - off.x * right - off.y * up);
        return render::make_view({eye, eye - back, fov}, side, side);
    }

    glm::dvec3 drawn(int i, const render::View& view, double splat_size = 1) {
        return light_of(shoot(renderer_, people_.frame(view, std::array{static_cast<std::size_t>(i)}, splat_size)));
    }

    tests::Seen truth(int i, const render::View& view, int samples) const {
        const FarPerson one = person(i);
        const double scale = one.height / figure_.height();
        return tests::look_at(figures_[0], figure_.keys.poses[one.key], one.at, one.yaw, scale, one.palette, light_,
                              view, samples);
    }

private:
    const FarFigure& figure_;
    scene::Light light_;
    std::vector<figures::Figure> figures_;
    FarGathering people_;
    Renderer renderer_;
};

// How far single ones, and the sum of them all, are from what they should be.
struct Off {
    double drawn = 0, truth = 0, worst = 0, squares = 0;
    int count = 0;
    void add(double one, double of) {
        drawn += one;
        truth += of;
        worst = std::max(worst, std::abs(one / of - 1));
        squares += (one / of - 1) * (one / of - 1);
        ++count;
    }
    double mean() const { return drawn / truth - 1; }
    double deviation() const { return std::sqrt(squares / count); }
};

// [rad] Another for each of many people, the golden angle apart, and all elevations but the poles.
double azimuth_of(int i) {
    return 2.399963 * i;
}
double elevation_of(int i, int count) {
    return std::asin(1.96 * (i + 0.5) / count - 0.98);
}

// [tangents] Anywhere in some cells.
glm::dvec2 aside(int i) {
    return 0.05 / Alone::side * glm::dvec2(std::fmod(1.618034 * i, 6.0), std::fmod(2.754878 * i, 6.0));
}

constexpr int many = 240, samples = 48;

TEST(FarPerson, CoversTheirSilhouette) {
    Alone alone(white(), even_before_black(), many);
    for (const double height : {0.6, 1.2}) {
        Off off;
        for (int i = 0; i < many; ++i) {
            const render::View view = alone.view(i, height, azimuth_of(i), elevation_of(i, many), 0.05, aside(i));
            off.add(alone.drawn(i, view).g, alone.truth(i, view, samples).covered);
        }
        EXPECT_NEAR(off.mean(), 0, 0.02) << height << " px";
        EXPECT_LT(off.deviation(), 0.03) << height << " px";
        EXPECT_LT(off.worst, 0.12) << height << " px";
    }
}

// Silhouettes' images are larger towards the corners.
TEST(FarPerson, CoversMoreOffThePicturesMiddle) {
    Alone alone(white(), even_before_black(), many);
    for (const glm::dvec2 corner : {glm::dvec2(1.4, 0), glm::dvec2(-1.2, 1.2), glm::dvec2(0, -1.4)}) {
        Off off;
        for (int i = 0; i < many; ++i) {
            const render::View view = alone.view(i, 1.0, azimuth_of(i), 0.6 * elevation_of(i, many), 2.0, corner);
            off.add(alone.drawn(i, view).g, alone.truth(i, view, samples).covered);
        }
        EXPECT_NEAR(off.mean(), 0, 0.025) << corner.x << " " << corner.y;
        EXPECT_LT(off.deviation(), 0.03);
        EXPECT_LT(off.worst, 0.12);
    }
}

TEST(FarPerson, SendsTheMeanLightOfWhatIsSeen) {
    const scene::Light daylight = before_black();
    Alone alone(built_in(), daylight, many);
    std::array<Off, 3> off;
    for (int i = 0; i < many; ++i) {
        const render::View view = alone.view(i, 1.2, azimuth_of(i), elevation_of(i, many), 0.05, aside(i));
        const glm::dvec3 drawn = alone.drawn(i, view);
        const tests::Seen truth = alone.truth(i, view, samples);
        for (int channel = 0; channel < 3; ++channel)
            off[static_cast<std::size_t>(channel)].add(drawn[channel], truth.light[channel]);
    }
    for (const Off& channel : off) {
        EXPECT_NEAR(channel.mean(), 0, 0.03);
        EXPECT_LT(channel.deviation(), 0.1);
        EXPECT_LT(channel.worst, 0.5) << "from below little is lit";
    }
}

TEST(FarPerson, SendsAsMuchHoweverLargeCellsAre) {
    Alone alone(white(), even_before_black(), many);
    for (const double splat_size : {2.0, 3.7}) {
        Off off;
        for (int i = 0; i < many; ++i) {
            const render::View view = alone.view(i, 1.2, azimuth_of(i), elevation_of(i, many), 0.05, aside(i));
            off.add(alone.drawn(i, view, splat_size).g, alone.drawn(i, view).g);
        }
        EXPECT_NEAR(off.mean(), 0, 0.03) << splat_size;
    }
}

// A field of people `spacing` [px] apart, about a pixel tall, seen from so far that all are seen from the same side: in
// blocks of whatever sizes they are the same.
constexpr int field_side = 128;
constexpr double field_height_px = 1.2;

std::vector<FarPerson> field(double spacing_px, int across, std::size_t characters, unsigned seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    const float metres = 1.75f / static_cast<float>(field_height_px), spacing = metres * static_cast<float>(spacing_px);
    std::vector<FarPerson> people;
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x) {
            FarPerson one;
            const glm::vec2 at = spacing * (glm::vec2(x, y) - 0.5f * static_cast<float>(across - 1)) + metres * unit();
            one.at = {at.x, at.y, 20.0f * unit()};
            one.yaw = 6.28f * unit();
            one.height = 1.6f + 0.3f * unit();
            one.character = static_cast<std::uint8_t>(random() % characters);
            if (one.character == 0) one.key = static_cast<std::uint8_t>(random() % built_in().keys.poses.size());
            one.palette = motley(static_cast<std::uint32_t>(random()));
            people.push_back(one);
        }
    return people;
}

render::View field_view(int width = field_side, int height = field_side) {
    constexpr double tan_half = 0.002;
    const double distance = 1.75 * 0.5 * field_side / (tan_half * field_height_px);
    const double fov = 2 * std::atan(tan_half * height / field_side);
    const glm::dvec3 back = glm::normalize(glm::dvec3(0.2, 0.3, 1));
    return render::make_view({distance * back, glm::dvec3(0.0), fov}, width, height);
}

const std::vector<figures::Figure>& cast() {
    static const std::vector<figures::Figure> all{built_in().figure(), red().figure(), blue().figure()};
    return all;
}

Renderer make_renderer(const scene::StaticMesh& structure = {}, const scene::Light& light = before_black()) {
    return {structure, scene::Ground{}, light, cast(), field_side, field_side};
}

// Kept, as crowds are told apart by where they are.
FarGathering& gathering(std::span<const FarPerson> people, std::span<const std::size_t> sizes) {
    static std::deque<FarGathering> all;
    FarGathering& one = all.emplace_back(cast());
    std::size_t first = 0;
    for (std::size_t i = 0; first < people.size(); ++i) {
        const std::size_t count = std::min(sizes[i % sizes.size()], people.size() - first);
        one.add_block(people.subspan(first, count));
        first += count;
    }
    return one;
}

std::vector<std::size_t> all_of(const FarGathering& people) {
    std::vector<std::size_t> blocks(people.crowd.blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] = i;
    return blocks;
}

// [of 255] The farthest that two pictures are apart.
int farthest(const render::Image& a, const render::Image& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
    return most;
}

TEST(FarPeople, AreTheSameInBlocksOfAnySize) {
    constexpr int rounding = 3;  // [of 255] where little is covered a step of coverage is some of colour
    Renderer renderer = make_renderer();
    const render::View view = field_view();
    for (const std::size_t characters : {std::size_t{1}, std::size_t{3}}) {
        const std::vector<FarPerson> people = field(5, 23, characters, 1);
        FarGathering& single = gathering(people, std::array<std::size_t, 1>{1});
        const render::Image expected = shoot(renderer, single.frame(view, all_of(single)));
        EXPECT_GT(light_of(expected).g, 5);
        const std::vector<std::vector<std::size_t>> partitions = {{529}, {16},           {15},      {17},
                                                                  {3},   {1, 31, 16, 2}, {500, 29}, {500, 1}};
        for (const std::vector<std::size_t>& sizes : partitions) {
            FarGathering& blocks = gathering(people, sizes);
            EXPECT_LE(farthest(shoot(renderer, blocks.frame(view, all_of(blocks))), expected), rounding)
                << characters << " characters, blocks of " << sizes.front();
        }
    }
}

// Dense, of several characters, in blocks that lie across one another's borders and the tiles'.
FarGathering& crowded() {
    static FarGathering& one = []() -> FarGathering& {
        const std::vector<FarPerson> people = field(0.9, 120, 3, 2);
        return gathering(people, std::array<std::size_t, 5>{300, 17, 1, 129, 64});
    }();
    return one;
}

TEST(FarPeople, AreTheSameOnEveryInstructionSet) {
    Renderer renderer = make_renderer();
    shoot(renderer, crowded().frame(field_view(), all_of(crowded())));  // makes the characters' tables
    for (const double splat_size : {1.0, 3.3}) {
        std::optional<render::Image> first;
        for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
            render::Frame frame = crowded().frame(field_view(), all_of(crowded()), splat_size);
            frame.far_blocks[0].tick = rest;  // else it is drawn already
            hwy::SetSupportedTargetsForTest(rest & -rest);
            const render::Image image = shoot(renderer, frame);
            hwy::SetSupportedTargetsForTest(0);
            if (!first) first = image;
            EXPECT_EQ(first->pixels, image.pixels) << hwy::TargetName(rest & -rest) << ", S " << splat_size;
        }
        EXPECT_GT(light_of(*first).r, 100);
    }
}

TEST(FarPeople, AreTheSameOnAnyNumberOfThreads) {
    const render::View view = field_view(300, 300);
    std::optional<render::Image> first;
    for (const int threads : {1, 2, 4}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            Renderer renderer = make_renderer();
            renderer.resize(300, 300);
            const render::Image image = shoot(renderer, crowded().frame(view, all_of(crowded())));
            if (!first) first = image;
            EXPECT_EQ(first->pixels, image.pixels) << threads << " threads";
        });
    }
}

// The middle of a larger picture is the smaller picture, whatever tiles it is cut into and whoever is outside:
// positions are rounded a little otherwise.
TEST(FarPeople, AreTheSameWhereverTilesAre) {
    Renderer renderer = make_renderer();
    const auto draw = [&](int width, int height) {
        renderer.resize(width, height);
        return shoot(renderer, crowded().frame(field_view(width, height), all_of(crowded())));
    };
    constexpr int large = 300;
    const render::Image whole = draw(large, large);
    for (const int side : {298, 240, 128, 90, 46, 2}) {
        const render::Image part = draw(side, side);
        const int offset = (large - side) / 2;
        int off = 0;
        for (int y = 0; y < side; ++y)
            for (int i = 0; i < 3 * side; ++i) {
                const std::size_t at = std::size_t{3} * large * static_cast<std::size_t>(y + offset) + 3 * offset + i;
                const int apart = std::abs(whole.pixels[at] - part.pixels[std::size_t{3} * side * y + i]);
                EXPECT_LE(apart, 6) << side;
                off += apart > 1;
            }
        EXPECT_LE(off, side * side / 20) << side;
    }
}

TEST(FarPeople, AreDrawnInPicturesOfAnySize) {
    Renderer renderer = make_renderer();
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 500), std::pair(700, 1), std::pair(8192, 33)}) {
        renderer.resize(width, height);
        for (const double splat_size : {0.5, 1.0, 32.0}) {
            const render::Frame frame = crowded().frame(field_view(width, height), all_of(crowded()), splat_size);
            EXPECT_GT(light_of(shoot(renderer, frame)).r, 0) << width << " x " << height;
        }
    }
}

TEST(FarPeople, OutsideOfThePictureLeaveNothing) {
    Renderer renderer = make_renderer();
    for (const glm::vec3 aside : {glm::vec3(300, 0, 0), glm::vec3(-300, 0, 0), glm::vec3(0, 300, 0),
                                  glm::vec3(0, -300, 0), glm::vec3(1e5, 0, 0), glm::vec3(0, 0, 2e6)}) {
        std::vector<FarPerson> people = field(1, 10, 3, 3);
        for (FarPerson& person : people) person.at += aside;
        FarGathering& moved = gathering(people, std::array<std::size_t, 1>{100});
        EXPECT_EQ(light_of(shoot(renderer, moved.frame(field_view(), all_of(moved)))), glm::dvec3(0.0)) << aside.x;
    }
}

// What a person covers of a cell, and many on the same spot.
TEST(FarPeople, CoverByChanceWhatTheirAreasSay) {
    const std::vector<figures::Figure> figures{white().figure()};
    const render::native::SplatModel model(figures[0], even_before_black());
    render::native::PatchRoom room;
    for (const scene::Role role : {scene::Role::standing, scene::Role::spectator}) {
        const auto covered = [&](std::size_t people) {
            FarPerson one;
            one.at = {0.3f, 0.2f, 0};
            one.role = role;
            FarGathering same(figures);
            same.add_block(std::vector<FarPerson>(people, one));
            same.add_others();
            render::native::FarCrowd crowd(figures, even_before_black());
            crowd.learn(std::array<const render::native::SplatModel*, 1>{&model});
            const render::View view = field_view();
            crowd.prepare(same.frame(view, std::array{std::size_t{0}}), 1);
            const render::native::Rect cells = crowd.blocks()[0].cells();
            const render::native::Patch patch =
                room.patch(cells.x0, cells.y0, cells.x1 - cells.x0, cells.y1 - cells.y0);
            crowd.splat(crowd.blocks()[0], patch);
            std::vector<double> shares;
            for (int y = 0; y < patch.height; ++y)
                for (int x = 0; x < patch.width; ++x)
                    shares.push_back(patch.cells[8 * (patch.stride * y + x) + 3] / 8192.0);
            render::native::clear(patch);
            return shares;
        };
        const auto share = [&](double areas) {
            return role == scene::Role::standing ? 1 - std::exp(-areas) : areas / std::sqrt(1 + areas * areas);
        };
        // Of ten little is rounded: what they add up to is found back from what they cover.
        std::vector<double> areas = covered(4);
        for (double& area : areas) {
            double low = 0, high = 4;
            while (high - low > 1e-9) (share(0.5 * (low + high)) < area ? low : high) = 0.5 * (low + high);
            area = low / 4;
        }
        for (const std::size_t people : {std::size_t{1}, std::size_t{2}, std::size_t{9}, std::size_t{25}}) {
            const std::vector<double> found = covered(people);
            double most = 0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                constexpr double fullest = 4;  // more areas aren't told apart
                const double all = std::min(fullest, areas[i] * static_cast<double>(people));
                EXPECT_NEAR(found[i], share(all), 0.01 + 0.02 * share(all)) << people << " people, " << all;
                most = std::max(most, found[i]);
            }
            EXPECT_GT(most, people == 25 ? 0.95 : 0.1);
        }
    }
}

TEST(FarPeople, AreDrawnAgainOnlyWhenTheyAreAskedAnew) {
    Renderer renderer = make_renderer();
    const std::vector<FarPerson> people = field(3, 30, 1, 5);
    FarGathering& one = gathering(people, std::array<std::size_t, 1>{100});
    const render::View view = field_view();
    render::Frame frame = one.frame(view, all_of(one));
    const render::Image before = shoot(renderer, frame);
    for (std::uint8_t& key : one.keys) key = static_cast<std::uint8_t>((key + 9) % built_in().keys.poses.size());
    EXPECT_EQ(shoot(renderer, frame).pixels, before.pixels) << "of the same tick everything is the same";
    frame.far_blocks[3].tick = 4;
    const render::Image after = shoot(renderer, frame);
    EXPECT_NE(after.pixels, before.pixels);
    Renderer fresh = make_renderer();
    EXPECT_EQ(shoot(fresh, frame).pixels, after.pixels);
}

TEST(FarPeople, OfAnotherCrowdAreItsOwn) {
    Renderer renderer = make_renderer(), fresh = make_renderer();
    FarGathering& few = gathering(field(9, 6, 3, 6), std::array<std::size_t, 1>{18});
    const render::View view = field_view();
    shoot(renderer, few.frame(view, all_of(few)));
    FarGathering& others = gathering(field(9, 6, 3, 7), std::array<std::size_t, 1>{18});
    for (FarGathering* next : {&others, &crowded()}) {
        const render::Frame frame = next->frame(view, all_of(*next));
        EXPECT_EQ(shoot(renderer, frame).pixels, shoot(fresh, frame).pixels);
    }
}

// Nobody of it is ever in a far block.
TEST(FarPeople, StandBesideOthersWhoHaveNoPoints) {
    const motion::PoseTable bare = motion::bake_poses(built_in().character, {}, {}, std::size_t{1} << 24);
    std::vector<figures::Figure> figures = cast();
    figures[1] = {&built_in().character.mesh, &bare, nullptr};
    Renderer renderer(scene::StaticMesh{}, scene::Ground{}, before_black(), figures, field_side, field_side);
    Renderer with_all = make_renderer();
    std::vector<FarPerson> people = field(3, 20, 3, 8);
    for (FarPerson& person : people)
        if (person.character == 1) person.character = 2;
    FarGathering& one = gathering(people, std::array<std::size_t, 1>{50});
    const render::Frame frame = one.frame(field_view(), all_of(one));
    EXPECT_EQ(shoot(renderer, frame).pixels, shoot(with_all, frame).pixels);
}

// Seen along -z from a kilometre, with others and walls at other depths: far people are red, all others blue or green.
class FarOrder : public testing::Test {
protected:
    static constexpr double distance = 1000;  // [m] to the far people
    static render::View view() {
        const double fov = 2 * std::atan(1.75 * 0.5 * field_side / (field_height_px * distance));
        return render::make_view({{0, 0, distance}, {0, 0, 0}, fov}, field_side, field_side);
    }
    // A crowd in red, in blocks all over the picture.
    static FarGathering& reds() {
        static FarGathering& one = []() -> FarGathering& {
            std::vector<FarPerson> people = field(1.4, 80, 1, 9);
            for (FarPerson& person : people) {
                person.character = 1;
                person.key = 0;
                person.at.z = 0;
            }
            return gathering(people, std::array<std::size_t, 1>{160});
        }();
        return one;
    }
    // At this view depth, a wall that covers the picture to the right of pixel `first`.
    static scene::StaticMesh wall(double depth, int first) {
        const double half = depth * static_cast<double>(view().tan_half_x);
        const auto left = static_cast<float>(half * (2.0 * first / field_side - 1));
        const auto z = static_cast<float>(distance - depth), out = static_cast<float>(2 * half);
        scene::StaticMeshBuilder builder;
        builder.quad({left, -out, z}, {out, -out, z}, {out, out, z}, {left, out, z}, scene::painted(0, 255, 0));
        builder.close_sector();
        return builder.mesh;
    }
    static render::Frame frame(bool with_reds) {
        return reds().frame(view(), with_reds ? all_of(reds()) : std::vector<std::size_t>{});
    }
    // Somebody in blue, 60 px tall, by this representation.
    static render::Person tall(const char* name, double depth, float aside_px = 0) {
        const render::View from = view();
        render::Person person{};
        const float metre = 1.0f / from.pixels_per_metre(static_cast<float>(depth));  // of a pixel
        person.instance.scale = 60 * metre / 1.75f;
        person.instance.position = {aside_px * metre, -30 * metre, -static_cast<float>(depth)};
        person.instance.turn.cos_yaw = 32767;
        person.character = person.batch = 2;
        person.depth = static_cast<float>(depth);
        person.last_share = 1;
        const auto all = figures::natively().representations;
        person.representation = static_cast<std::uint32_t>(
            std::ranges::find(all, std::string_view(name), &figures::Representation::name) - all.begin());
        if (!all[person.representation].is_mesh) person.count = 1500;
        return person;
    }
    static double share(std::uint8_t byte) { return byte / 255.0 * (byte / 255.0); }
    static constexpr double rounding = 0.015;  // as of two people in order_test.cpp
};

TEST_F(FarOrder, WallsHideThemPixelByPixel) {
    Renderer open = make_renderer({}, even_before_black());
    const render::Image alone = shoot(open, frame(true));
    EXPECT_GT(light_of(alone).r, 1000);
    for (const int first : {0, 37, 127}) {
        const scene::StaticMesh before = wall(distance - 20, first), behind = wall(distance + 20, first);
        for (const double splat_size : {1.0, 2.5}) {
            Renderer hiding = make_renderer(before, even_before_black());
            render::Frame with = frame(true), without = frame(false);
            with.splat_size = without.splat_size = splat_size;
            const render::Image far_alone = shoot(open, with), both = shoot(hiding, with);
            const render::Image wall_alone = shoot(hiding, without);
            for (std::size_t i = 0; i < both.pixels.size(); ++i)
                ASSERT_EQ(both.pixels[i],
                          (static_cast<int>(i / 3 % field_side) < first ? far_alone : wall_alone).pixels[i])
                    << "pixel " << i / 3 << ", wall from " << first << ", S " << splat_size;
        }
        Renderer backed = make_renderer(behind, even_before_black());
        const render::Image both = shoot(backed, frame(true));
        for (std::size_t i = 0; i < both.pixels.size(); i += 3)
            ASSERT_EQ(both.pixels[i], alone.pixels[i]) << "before a wall, pixel " << i / 3;
    }
}

TEST_F(FarOrder, WhoeverIsBeforeThemHidesThem) {
    for (const double splat_size : {1.0, 2.5})
        for (const char* name : {"triangles", "points"}) {
            Renderer renderer = make_renderer({}, even_before_black());
            render::Frame reds_alone = frame(true), both = frame(true), blue_alone = frame(false);
            reds_alone.splat_size = both.splat_size = blue_alone.splat_size = splat_size;
            both.people = blue_alone.people = {tall(name, distance - 200)};
            const render::Image far = shoot(renderer, reds_alone), near = shoot(renderer, blue_alone);
            const render::Image mixed = shoot(renderer, both);
            double hidden = 0;
            for (std::size_t i = 0; i < far.pixels.size(); i += 3) {
                const double open = 1 - share(near.pixels[i + 2]);
                ASSERT_NEAR(share(mixed.pixels[i + 2]), share(near.pixels[i + 2]), rounding) << name << i / 3;
                ASSERT_NEAR(share(mixed.pixels[i]), open * share(far.pixels[i]), 2 * rounding)
                    << name << ", pixel " << i / 3 << ", S " << splat_size;
                hidden += (1 - open) * share(far.pixels[i]);
            }
            EXPECT_GT(hidden, 50) << name;
        }
}

TEST_F(FarOrder, WhoeverIsBehindThemIsHidden) {
    for (const double splat_size : {1.0, 2.5})
        for (const char* name : {"triangles", "points"}) {
            Renderer renderer = make_renderer({}, even_before_black());
            render::Frame reds_alone = frame(true), both = frame(true), blue_alone = frame(false);
            reds_alone.splat_size = both.splat_size = blue_alone.splat_size = splat_size;
            both.people = blue_alone.people = {tall(name, distance + 200)};
            const render::Image far = shoot(renderer, reds_alone), behind = shoot(renderer, blue_alone);
            const render::Image mixed = shoot(renderer, both);
            for (std::size_t i = 0; i < far.pixels.size(); i += 3) {
                const double open = 1 - share(far.pixels[i]);
                ASSERT_NEAR(share(mixed.pixels[i]), share(far.pixels[i]), rounding) << name << ", pixel " << i / 3;
                ASSERT_NEAR(share(mixed.pixels[i + 2]), open * share(behind.pixels[i + 2]), 2 * rounding)
                    << name << ", pixel " << i / 3 << ", S " << splat_size;
            }
        }
}

// The stadium, all of whose people are a pixel or two tall: block by block, one by one as points, and as triangles. How
// light is shared out within a pixel differs, what people hide of one another too: so much is lost, or won.
TEST(FarPeople, AreAsBrightAsOneByOne) {
    constexpr double of_points = 0.12, of_triangles = 0.08;
    static const tests::SmallScene scene(6000, 2);
    const scene::StaticMesh structure = scene::build_structure(scene.plan);
    Renderer renderer(structure, scene::paint_ground(scene.plan), scene::Light{}, scene.figures(), 480, 270);
    const figures::Way one_by_one = tests::without_blocks(figures::natively());
    render::SelectOptions blocks, singles;
    blocks.way = &figures::natively();
    singles.way = &one_by_one;
    render::Selector by_block(scene.crowd, scene.cast, scene.figures(), blocks);
    render::Selector by_one(scene.crowd, scene.cast, scene.figures(), singles);
    for (const glm::dvec3 from : {glm::dvec3(0, 700, 1400), glm::dvec3(1500, 300, 0), glm::dvec3(-900, 900, -900)})
        for (const double fov : {0.16, 0.13}) {
            const render::View view = render::make_view({from, {0, 5, 0}, fov}, 480, 270);
            const render::Surroundings around = renderer.begin(view);
            const auto picture = [&](render::Selector& by, const sfsm::Decision& decision) {
                by.survey(view, 100, around);
                renderer.draw(by.select(decision, 99));
                return renderer.read_image();
            };
            const sfsm::Decision decision{sfsm::State::points, 1e6, 1.19};
            const render::Image drawn = picture(by_block, decision), points = picture(by_one, decision),
                                truth = picture(by_one, {});
            const std::size_t far = by_block.select(decision, 99).far_blocks.size();
            EXPECT_GT(far, 10u);
            double block = 0, single = 0, triangles = 0;
            for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
                if (truth.pixels[i] == drawn.pixels[i] && truth.pixels[i] == points.pixels[i]) continue;
                block += std::pow(drawn.pixels[i] / 255.0, 2);
                single += std::pow(points.pixels[i] / 255.0, 2);
                triangles += std::pow(truth.pixels[i] / 255.0, 2);
            }
            EXPECT_NEAR(block / single, 1, of_points);
            EXPECT_NEAR(block / triangles, 1, of_triangles);
        }
}

// Whatever a frame may hold, whether or not a selector would ask for it.
TEST(FarPeople, AreDrawnFromAnywhereHoweverTallOrFar) {
    Renderer renderer = make_renderer();
    std::vector<FarGathering*> crowds;
    for (const float metres : {0.0f, 1e3f, 1e6f})
        for (const float height : {0.01f, 1.75f, 100.0f}) {
            std::vector<FarPerson> people = field(1, 12, 3, 11);
            for (FarPerson& person : people) {
                person.at += glm::vec3(metres, 0.1f * metres, -metres);
                person.height = height;
            }
            crowds.push_back(&gathering(people, std::array<std::size_t, 2>{50, 7}));
        }
    for (FarGathering* people : crowds) {
        const glm::dvec3 middle(people->crowd.blocks[0].box.center());
        for (const glm::dvec3 eye :
             {middle, middle + glm::dvec3(0, 5, 0.01), glm::dvec3(0, 0, 50), middle + glm::dvec3(1e6, 1e5, 1e6)})
            for (const double degrees : {1.0, 60.0, 170.0})
                for (const glm::dvec3 along : {glm::dvec3(0, 0, -1), glm::dvec3(0, -1, 0), glm::dvec3(1, 0.2, 1)})
                    for (const double splat_size : {0.5, 1.0, 32.0}) {
                        const render::View view =
                            render::make_view({eye, eye + along, degrees * std::numbers::pi / 180}, 128, 128);
                        shoot(renderer, people->frame(view, all_of(*people), splat_size));
                    }
    }
}

}  // namespace
