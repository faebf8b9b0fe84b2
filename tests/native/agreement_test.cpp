// Whole frames by the processor and by OpenGL, of the same stadium at the same time, show the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "figures/way.h"
#include "render/gl/renderer.h"
#include "render/native/renderer.h"
#include "render/select.h"
#include "tests/bench/fidelity.h"
#include "tests/bench/flip.h"
#include "tests/render/gl_test.h"
#include "tests/render/small_scene.h"

namespace {

constexpr int width = 320, height = 180;  // [px]
constexpr std::int64_t tick = 100;

// The stadium as one renderer shows it.
class Drawer {
public:
    Drawer(const tests::SmallScene& place, const figures::Way& way, render::Renderer& renderer)
        : selector_(place.crowd, place.cast, place.figures(), options_of(way)), renderer_(renderer) {}

    // `finer`: times as many pixels, across and down.
    render::Image shoot(const scene::CameraPose& pose, const sfsm::Decision& decision, int finer = 1) {
        renderer_.resize(finer * width, finer * height);
        const render::View view = render::make_view(pose, finer * width, finer * height);
        selector_.survey(view, tick, renderer_.begin(view));
        renderer_.draw(selector_.select(decision, tick - 1));
        return renderer_.read_image();
    }

private:
    static render::SelectOptions options_of(const figures::Way& way) {
        render::SelectOptions options;
        options.way = &way;
        return options;
    }

    render::Selector selector_;
    render::Renderer& renderer_;
};

struct Stadium {
    tests::SmallScene place{1200, 2};
    scene::StaticMesh structure = scene::build_structure(place.plan);
    scene::Ground ground = scene::paint_ground(place.plan);
    scene::Cameras cameras = scene::aim_cameras(place.plan);
    render::gl::Renderer gl{structure, ground, {}, place.figures(), width, height};
    render::native::Renderer native{structure, ground, {}, place.figures(), width, height};
    Drawer by_gl{place, figures::by_opengl(), gl}, natively{place, figures::natively(), native};
};

constexpr const char* presets[] = {"still", "close", "medium", "remote"};

// [of 255] of the channel that differs most.
int apart(const std::uint8_t* a, const std::uint8_t* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

class NativeAndGl : public tests::GlTest {};

// OpenGL has one sample a pixel and the processor four, so only pixels are compared that one surface fills: which look
// the same in all its parts.
TEST_F(NativeAndGl, ShowTheSameTriangles) {
    constexpr int near_enough = 2;      // [of 255] rounding of two ways to the same number
    constexpr int even = 6;             // [of 255] shading within a pixel; across an edge it is nearly always more
    constexpr int finer = 4;            // times as many pixels, across and down, say what a pixel holds
    constexpr double others = 0.001;    // of those pixels: a sliver in one corner of them, and alike surfaces
    constexpr double least_even = 0.3;  // of all pixels, or nothing is shown
    if (IsSkipped()) return;
    Stadium stadium;
    for (const char* preset : presets) {
        const scene::CameraPose pose = stadium.cameras.named(preset).at(0);
        const render::Image native = stadium.natively.shoot(pose, {}), gl = stadium.by_gl.shoot(pose, {});
        const render::Image fine = stadium.by_gl.shoot(pose, {}, finer);
        int filled = 0, wrong = 0, worst = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const std::size_t at = 3 * (std::size_t{1} * y * width + x);
                bool is_even = true;
                for (int i = 0; i < finer * finer; ++i) {
                    const int fine_x = finer * x + i % finer, fine_y = finer * y + i / finer;
                    is_even &= apart(&gl.pixels[at],
                                     &fine.pixels[3 * (std::size_t{1} * fine_y * fine.width + fine_x)]) <= even;
                }
                if (!is_even) continue;
                const int off = apart(&gl.pixels[at], &native.pixels[at]);
                ++filled;
                wrong += off > near_enough;
                worst = std::max(worst, off);
            }
        const std::string what = std::string(preset) + ": " + std::to_string(wrong) + " of " + std::to_string(filled) +
                                 " pixels, by up to " + std::to_string(worst);
        std::printf("%s\n", what.c_str());
        EXPECT_LE(wrong, others * filled) << what;
        EXPECT_GE(filled, least_even * width * height) << what;
    }
}

// Two pictures with errors of their own may differ by their sum; these have most of theirs in common.
TEST_F(NativeAndGl, DifferByPointsLittleMoreThanTheyAreOff) {
    constexpr double most = 1.5;  // of the greater error
    constexpr int finer = 4;      // samples a pixel, across and down, of what they are held against
    const sfsm::Decision points{sfsm::State::points, 1e6, 1.0};
    if (IsSkipped()) return;
    Stadium stadium;
    for (const char* preset : presets) {
        const scene::CameraPose pose = stadium.cameras.named(preset).at(0);
        const render::Image truth = bench::box_filtered(stadium.by_gl.shoot(pose, {}, finer), finer);
        const render::Image gl = stadium.by_gl.shoot(pose, points), native = stadium.natively.shoot(pose, points);
        const double of_gl = bench::mean_flip_error(truth, gl), of_native = bench::mean_flip_error(truth, native);
        const double between = bench::mean_flip_error(gl, native);
        std::printf("%s: FLIP of OpenGL %.4f, natively %.4f, between them %.4f\n", preset, of_gl, of_native, between);
        EXPECT_GT(between, 0) << preset;
        EXPECT_LE(between, most * std::max(of_gl, of_native)) << preset;
    }
}

}  // namespace
