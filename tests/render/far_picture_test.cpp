// People who are drawn block by block, by OpenGL: each is a square of their mean light, or of a pixel by chance, so
// that many are right on average.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "render/gl/renderer.h"
#include "render/native/renderer.h"
#include "render/select.h"
#include "scene/static_mesh_builder.h"
#include "tests/native/far_crowd.h"
#include "tests/native/far_truth.h"
#include "tests/render/gl_test.h"
#include "tests/render/small_scene.h"

namespace {

using FarPicture = tests::GlTest;
using tests::before_black;
using tests::even_before_black;
using tests::FarFigure;
using tests::FarGathering;
using tests::FarPerson;

constexpr int side = 256, across = 60;  // [px] of the picture; people either way

const FarFigure& built_in() {
    static const FarFigure one(std::array{2, 5});
    return one;
}

const FarFigure& white() {
    static const glm::u8vec4 color(255);
    static const FarFigure one(std::array{2, 5}, &color);
    return one;
}

scene::StaticMesh nothing() {
    return {{{}, {}, {}}, {0, 0, 0}, {}};
}

render::Image shoot(render::Renderer& renderer, const render::Frame& frame) {
    renderer.begin(frame.view);
    renderer.draw(frame);
    return renderer.read_image();
}

// Many who are alike, four pixels apart, seen by one who is far away.
struct Likes {
    FarPerson one;
    render::View view;
    FarGathering people;

    Likes(const std::vector<figures::Figure>& figures, double height_px, int number, std::size_t keys)
        : people(figures) {
        const double azimuth = 2.4 * number, elevation = std::asin(0.15 * (number % 13) - 0.9);
        const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                              std::cos(azimuth) * std::cos(elevation));
        constexpr double tan_half = 0.002;
        const double metre = height_px / 1.75;  // [px]
        view = render::make_view({side / 2 / (tan_half * metre) * back, glm::dvec3(0), 2 * std::atan(tan_half)}, side,
                                 side);
        one.yaw = 0.9f * static_cast<float>(number);
        one.key = static_cast<std::uint8_t>(5 * static_cast<std::size_t>(number) % keys);
        for (int slot = 0; slot < model::slot_count; ++slot)
            one.palette.colors[static_cast<std::size_t>(slot)] = {250 - 40 * (slot + number % 3), 120 + 30 * slot,
                                                                  200 - 45 * slot, 255};
        std::vector<FarPerson> all;
        for (int y = 0; y < across; ++y)
            for (int x = 0; x < across; ++x) {
                all.push_back(one);
                const auto at = [&](int i, int j) {  // not always the same part of a pixel
                    return static_cast<float>((4 * i + 0.37 * j - 2 * across) / metre * 0.95);
                };
                all.back().at = at(x, y % 7) * view.right + at(y, x % 7) * view.up;
            }
        for (std::size_t first = 0; first < all.size(); first += 300)
            people.add_block(std::span(all).subspan(first, 300));
    }

    render::Frame frame() const {
        std::vector<std::size_t> blocks;
        for (std::size_t block = 0; block < people.crowd.blocks.size(); ++block) blocks.push_back(block);
        return people.frame(view, blocks);
    }
    tests::Seen truth(const FarFigure& figure, const scene::Light& light) const {
        return tests::look_at(figure.figure(), figure.keys.poses[one.key], {0, 0, 0}, one.yaw,
                              one.height / figure.height(), one.palette, light, view, 48);
    }
};

// Crowds are told apart by where they are.
template <typename... Arguments>
const Likes* kept(Arguments... arguments) {
    static std::vector<std::unique_ptr<Likes>> all;
    return all.emplace_back(std::make_unique<Likes>(arguments...)).get();
}

// [px] of each of them, linear.
glm::dvec3 light_each(const render::Image& image) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        sum[static_cast<int>(i % 3)] += std::pow(image.pixels[i] / 255.0, 2);
    return sum / static_cast<double>(across * across);
}

// Of 3600 who cover half a pixel by chance the sum is off by two hundredths now and then.
TEST_F(FarPicture, PeopleCoverTheirSilhouettesOnAverage) {
    const std::vector<figures::Figure> figures{white().figure()};
    render::gl::Renderer renderer(nothing(), {}, even_before_black(), figures, side, side);
    for (const double height : {0.7, 1.4, 3.0}) {
        double drawn = 0, truth = 0, worst = 0;
        for (int number = 0; number < 26; ++number) {
            const Likes* likes = kept(figures, height, number, white().keys.poses.size());
            const double one = light_each(shoot(renderer, likes->frame())).g;
            const double of = likes->truth(white(), even_before_black()).covered;
            drawn += one;
            truth += of;
            worst = std::max(worst, std::abs(one / of - 1));
        }
        EXPECT_NEAR(drawn / truth, 1, 0.03) << height << " px";
        EXPECT_LT(worst, 0.1) << height << " px";
    }
}

TEST_F(FarPicture, PeopleSendTheirMeanLightOnAverage) {
    const std::vector<figures::Figure> figures{built_in().figure()};
    render::gl::Renderer renderer(nothing(), {}, before_black(), figures, side, side);
    glm::dvec3 drawn(0.0), truth(0.0);
    double worst = 0;
    for (int number = 0; number < 39; ++number) {
        const Likes* likes = kept(figures, 1.6, number, built_in().keys.poses.size());
        const glm::dvec3 one = light_each(shoot(renderer, likes->frame()));
        const glm::dvec3 of = likes->truth(built_in(), before_black()).light;
        drawn += one;
        truth += of;
        for (int channel = 0; channel < 3; ++channel) worst = std::max(worst, std::abs(one[channel] / of[channel] - 1));
    }
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(drawn[channel] / truth[channel], 1, 0.04);
    }
    EXPECT_LT(worst, 0.35) << "from below little is lit";
}

TEST_F(FarPicture, WallsHidePeopleBehindThem) {
    const std::vector<figures::Figure> figures{white().figure()};
    const Likes likes(figures, 1.6, 6, 1);
    const double distance = glm::length(likes.view.position);
    const auto draw = [&](double depth, bool with_people) {
        const glm::dvec3 middle = likes.view.position + depth * glm::dvec3(likes.view.forward);
        const glm::dvec3 right = depth * 0.004 * glm::dvec3(likes.view.right);
        const glm::dvec3 up = depth * 0.004 * glm::dvec3(likes.view.up);
        scene::StaticMeshBuilder builder;
        builder.quad(glm::vec3(middle - up), glm::vec3(middle + right - up), glm::vec3(middle + right + up),
                     glm::vec3(middle + up), scene::painted(0, 90, 30));
        builder.close_sector();
        render::gl::Renderer renderer(builder.mesh, {}, even_before_black(), figures, side, side);
        render::Frame frame = likes.frame();
        if (!with_people) frame.far_blocks.clear();
        return shoot(renderer, frame);
    };
    const render::Image before = draw(0.9 * distance, true), alone = draw(0.9 * distance, false);
    const render::Image behind = draw(1.1 * distance, true);
    int hidden = 0, shown = 0;
    for (std::size_t i = 0; i < before.pixels.size(); i += 3) {
        const bool is_walls = alone.pixels[i + 1] > 0;
        ASSERT_EQ(before.pixels[i], is_walls ? alone.pixels[i] : behind.pixels[i]) << "pixel " << i / 3;
        (is_walls ? hidden : shown) += behind.pixels[i] > 200;
    }
    EXPECT_GT(hidden, 300);
    EXPECT_GT(shown, 300);
}

// A crowd that is drawn after another, and one of whom some have no points, who are never in a far block.
TEST_F(FarPicture, OfAnotherCrowdIsItsOwnAndNeedsNoPointsOfOthers) {
    const motion::PoseTable bare = motion::bake_poses(built_in().character, {}, {}, std::size_t{1} << 24);
    const std::vector<figures::Figure> all{built_in().figure(), {&built_in().character.mesh, &bare, nullptr}};
    const std::vector<figures::Figure> one{built_in().figure()};
    const Likes first(one, 1.6, 3, 20);
    Likes second(one, 1.6, 4, 20);
    render::gl::Renderer renderer(nothing(), {}, before_black(), all, side, side);
    render::gl::Renderer fresh(nothing(), {}, before_black(), one, side, side);
    shoot(renderer, first.frame());
    const render::Image drawn = shoot(renderer, second.frame());
    EXPECT_GT(light_each(drawn).r, 0.01);
    EXPECT_EQ(drawn.pixels, shoot(fresh, second.frame()).pixels);
    std::ranges::fill(second.people.keys, std::uint8_t{2});  // and they move
    EXPECT_NE(shoot(renderer, second.frame()).pixels, drawn.pixels);
}

// The stadium from so far that all are a pixel or two tall: squares of it, against the native picture, and against
// full triangles of that.
TEST_F(FarPicture, OfManyBlocksIsRightOnAverage) {
    constexpr int width = 480, height = 270, square = 20;
    const tests::SmallScene scene(6000, 2);
    const scene::StaticMesh structure = scene::build_structure(scene.plan);
    const scene::Ground ground = scene::paint_ground(scene.plan);
    render::gl::Renderer by_gl(structure, ground, {}, scene.figures(), width, height);
    render::native::Renderer natively(structure, ground, {}, scene.figures(), width, height);
    render::SelectOptions gl_way, native_way;
    native_way.way = &figures::natively();
    render::Selector gl_selector(scene.crowd, scene.cast, scene.figures(), gl_way);
    render::Selector native_selector(scene.crowd, scene.cast, scene.figures(), native_way);
    for (const glm::dvec3 from : {glm::dvec3(0, 700, 1400), glm::dvec3(1500, 300, 0), glm::dvec3(-900, 900, -900)}) {
        const render::View view = render::make_view({from, {0, 5, 0}, 0.14}, width, height);
        const auto picture = [&](render::Renderer& renderer, render::Selector& selector, double splat_size) {
            const render::Surroundings around = renderer.begin(view);
            selector.survey(view, 100, around);
            const render::Frame& frame = selector.select(
                splat_size > 0 ? sfsm::Decision{sfsm::State::points, 1e6, splat_size} : sfsm::Decision{}, 99);
            EXPECT_TRUE(splat_size == 0 || frame.far_blocks.size() > 10);
            renderer.draw(frame);
            return renderer.read_image();
        };
        const render::Image gl = picture(by_gl, gl_selector, 1.6);
        const render::Image gl_triangles = picture(by_gl, gl_selector, 0);
        const render::Image native = picture(natively, native_selector, 1.6);
        const render::Image native_triangles = picture(natively, native_selector, 0);
        // [of 255] The farthest that squares' mean colours are apart, and how far they are on average.
        const auto apart = [&](const render::Image& a, const render::Image& b) {
            double worst = 0, sum = 0;
            int squares = 0;
            for (int top = 0; top + square <= height; top += square)
                for (int left = 0; left + square <= width; left += square)
                    for (int channel = 0; channel < 3; ++channel) {
                        double off = 0;
                        for (int y = top; y < top + square; ++y)
                            for (int x = left; x < left + square; ++x) {
                                const int at = 3 * (y * width + x) + channel;
                                off += a.pixels[static_cast<std::size_t>(at)] - b.pixels[static_cast<std::size_t>(at)];
                            }
                        off /= square * square;
                        worst = std::max(worst, std::abs(off));
                        sum += off;
                        ++squares;
                    }
            return std::array{worst, sum / squares};
        };
        // Native triangles are as far from OpenGL's: seats are thinner than pixels, and natively sampled four times.
        constexpr double most = 8, most_to_native = 13, most_on_average = 0.5;
        for (const auto& [worst, mean] : {apart(gl, gl_triangles), apart(native, native_triangles)}) {
            EXPECT_LT(worst, most);
            EXPECT_LT(std::abs(mean), most_on_average);
        }
        EXPECT_LT(apart(gl, native)[0], most_to_native);
    }
}

}  // namespace
