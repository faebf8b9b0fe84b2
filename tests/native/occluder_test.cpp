// Who is dropped from OpenGL's pictures as the structure hides them: the pictures are the same with them, to the bit.
#include "render/native/occluder.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "render/gl/renderer.h"
#include "render/select.h"
#include "tests/render/gl_test.h"
#include "tests/render/small_scene.h"

namespace {

constexpr int width = 640, height = 360;
constexpr std::int64_t tick = 100;

struct Place : tests::SmallScene {
    Place() : SmallScene(10000, 1) {}
    scene::StaticMesh structure = scene::build_structure(plan);
    scene::Ground ground = scene::paint_ground(plan);
    scene::Cameras cameras = scene::aim_cameras(plan);
};

const Place& place() {
    static const Place one;
    return one;
}

double between(std::mt19937& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

// Around the stadium, mostly low, with a wide view and a narrow one.
scene::CameraPose outside(std::mt19937& random) {
    const double around = between(random, 0, 2 * std::numbers::pi), away = between(random, 80, 260);
    const double up = std::exp(between(random, 0.7, 4.5));
    const glm::dvec3 target(between(random, -60, 60), between(random, 0, 15), between(random, -40, 40));
    return {{1.3 * away * std::cos(around), up, away * std::sin(around)}, target, std::exp(between(random, -1.5, 0.2))};
}

class HiddenByTheStructure : public tests::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        render::gl::Renderer renderer(place().structure, place().ground, {}, {}, width, height);
        if (!renderer.begin(render::make_view(place().cameras.remote.at(0), width, height)).occlusion)
            GTEST_SKIP() << "THIS OPENGL DRAWS EVERYBODY, NOTHING IS TESTED HERE";
    }
};

// The picture's depths by OpenGL, from the lower left corner.
std::vector<float> depths(render::gl::Renderer& renderer, const render::View& view) {
    render::Frame nobody;
    nobody.view = view;
    renderer.draw(nobody);
    std::vector<float> depths(static_cast<std::size_t>(width) * height);
    glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    return depths;
}

TEST_F(HiddenByTheStructure, NothingIsDrawnFartherThanBelieved) {
    constexpr int cameras = 300;  // without seams every three hundred or so show a pixel of what is behind a wall
    render::gl::Renderer renderer(place().structure, place().ground, {}, {}, width, height);
    std::mt19937 random(9);
    std::int64_t closed = 0, pixels = 0;
    for (int camera = 0; camera < cameras; ++camera) {
        const render::View view = render::make_view(outside(random), width, height);
        const render::Occlusion* occlusion = renderer.begin(view).occlusion;
        if (!occlusion) continue;  // from within
        const std::vector<float> drawn = depths(renderer, view);
        std::int64_t wrong = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float believed = occlusion->farthest[y / render::Occlusion::block_side * occlusion->stride +
                                                           x / render::Occlusion::block_side];
                wrong += drawn[static_cast<std::size_t>(height - 1 - y) * width + x] < believed;
                closed += believed > 0;
            }
        EXPECT_EQ(wrong, 0) << "camera " << camera;
        pixels += std::int64_t{width} * height;
    }
    EXPECT_GT(closed, pixels / 10) << "hardly anything hides anybody: little is shown";
}

// The presets, nearly all of which are inside where nobody is looked for, and from outside.
std::vector<scene::CameraPose> cameras() {
    const scene::Cameras& presets = place().cameras;
    std::vector<scene::CameraPose> poses{presets.still.at(0),  presets.close.at(0), presets.medium.at(0),
                                         presets.remote.at(0), presets.roam.at(4),  presets.roam.at(8)};
    std::mt19937 random(7);
    for (int i = 0; i < 24; ++i) poses.push_back(outside(random));
    return poses;
}

TEST_F(HiddenByTheStructure, PeopleAreNotMissedInOpenGlsPictures) {
    constexpr sfsm::Decision decisions[] = {
        {}, {sfsm::State::points, 1e9, 1.0}, {sfsm::State::points, 1e9, 4.0}, {sfsm::State::points, 1e9, 32.0}};
    render::gl::Renderer renderer(place().structure, place().ground, {}, place().figures(), width, height);
    render::Selector selector(place().crowd, place().cast, place().figures());
    std::int64_t hidden = 0, visible = 0;
    std::size_t next = 0;
    for (const scene::CameraPose& pose : cameras()) {
        const render::View view = render::make_view(pose, width, height);
        const render::Surroundings around = renderer.begin(view);
        const sfsm::Decision& decision = decisions[next++ % std::size(decisions)];
        hidden += selector.survey(view, tick, around).hidden;
        const render::Frame& frame = selector.select(decision, tick - 1);
        visible += static_cast<std::int64_t>(frame.people.size());
        renderer.draw(frame);
        const render::Image without = renderer.read_image();
        EXPECT_EQ(selector.survey(view, tick, {around.work, nullptr}).hidden, 0);
        renderer.draw(selector.select(decision, tick - 1));
        EXPECT_EQ(renderer.read_image().pixels, without.pixels)
            << "S " << decision.splat_size << " from " << pose.position.x << ' ' << pose.position.y << ' '
            << pose.position.z;
    }
    EXPECT_GT(hidden, visible / 20) << "hardly anybody was hidden: little is shown";
}

TEST_F(HiddenByTheStructure, IsTheSameOnAnyNumberOfThreads) {
    render::native::Occluder occluder(place().structure);
    const render::View view = render::make_view(place().cameras.remote.at(0), width, height);
    const render::View other = render::make_view(place().cameras.roam.at(4), width, height);
    const auto look = [&](int threads) {
        std::vector<float> farthest;
        tbb::task_arena(threads).execute([&] {
            occluder.look(other);
            const render::Occlusion& seen = *occluder.look(view);
            for (int row = 0; row < seen.rows; ++row)
                farthest.insert(farthest.end(), seen.farthest + row * seen.stride,
                                seen.farthest + row * seen.stride + seen.columns);
        });
        return farthest;
    };
    const std::vector<float> alone = look(1);
    EXPECT_TRUE(std::ranges::any_of(alone, [](float depth) { return depth > 0; }));
    for (const int threads : {2, 3, 8}) EXPECT_EQ(look(threads), alone) << threads << " threads";
}

}  // namespace
