// Cameras, pictures, crowds and splat sizes that nobody asks for, without OpenGL: every byte is a light that people can
// send, and the same bytes come back whatever was drawn before.
//
// Everybody is of the same grey, in light from everywhere alike, before a black sky: no pixel can be lighter than they.
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "figures/way.h"
#include "render/native/renderer.h"
#include "render/select.h"
#include "tests/render/small_scene.h"

namespace {

using render::native::Renderer;
using sfsm::State;

constexpr std::uint8_t grey = 128;  // of 255: as pixels have it, too
constexpr int rounding = 3;         // [of 255] of sums of few points in fixed point
constexpr std::int64_t tick = 100;

struct Grey : tests::SmallScene {
    Grey() : SmallScene(150, 2) {
        std::ranges::fill(person.mesh.colors, glm::u8vec4(grey, grey, grey, 255));
        std::ranges::fill(person.mesh.slots, model::no_slot);
        std::ranges::fill(points.colors, glm::u8vec4(grey, grey, grey, 255));
        std::ranges::fill(points.slots, model::no_slot);
    }
    glm::dvec3 inside_somebody() const { return glm::dvec3(crowd.position[7]) + glm::dvec3(0, 1, 0); }
};

const Grey& grey_people() {
    static const Grey all;
    return all;
}

// All of them on the spot of one, who sits there.
scene::Crowd in_one_spot() {
    scene::Crowd crowd = grey_people().crowd;
    constexpr float reach = 4;  // [m]
    const glm::vec3 spot = crowd.position[7];
    std::ranges::fill(crowd.position, spot);
    std::ranges::fill(crowd.role, scene::Role::spectator);
    for (scene::CrowdBlock& block : crowd.blocks) block.box = {spot - reach, spot + reach};
    return crowd;
}

scene::Light even_light() {
    scene::Light light;
    light.sun = light.glare = light.haze = light.zenith = glm::vec3(0);
    light.from_above = light.from_below = glm::vec3(1);
    return light;
}

std::unique_ptr<Renderer> make_renderer() {
    return std::make_unique<Renderer>(scene::StaticMesh{}, scene::Ground{}, even_light(), grey_people().figures(), 1,
                                      1);
}

// A crowd before one of two renderers, which keep what they have from picture to picture.
class Stage {
public:
    explicit Stage(const scene::Crowd& crowd, int number = 0)
        : renderer_(renderer(number)), selector_(crowd, grey_people().cast, grey_people().figures(), natively()) {}

    render::Frame frame(const render::View& view, double splat_size) {
        renderer_.resize(view.width, view.height);
        selector_.survey(view, tick, renderer_.begin(view));
        return selector_.select(splat_size > 0 ? sfsm::Decision{State::points, 1e6, splat_size} : sfsm::Decision{},
                                tick - 1);
    }
    render::Image shoot(const render::Frame& frame) {
        renderer_.resize(frame.view.width, frame.view.height);
        renderer_.begin(frame.view);
        renderer_.draw(frame);
        return renderer_.read_image();
    }
    render::Image shoot(const render::View& view, double splat_size) { return shoot(frame(view, splat_size)); }

private:
    static render::SelectOptions natively() {
        render::SelectOptions options;
        options.way = &figures::natively();
        return options;
    }
    static Renderer& renderer(int number) {
        static const std::unique_ptr<Renderer> both[] = {make_renderer(), make_renderer()};
        return *both[number];
    }

    Renderer& renderer_;
    render::Selector selector_;
};

render::View look(const glm::dvec3& from, const glm::dvec3& towards, double degrees, int width = 160, int height = 90) {
    return render::make_view({from, from + towards, degrees * std::numbers::pi / 180}, width, height);
}

std::vector<render::View> hostile_views() {
    const glm::dvec3 inside = grey_people().inside_somebody();
    std::vector<render::View> views;
    for (const double degrees : {1.0, 50.0, 170.0}) {
        for (const glm::dvec3 towards : {glm::dvec3(1, 0.1, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0)})
            views.push_back(look(inside, towards, degrees));
        views.push_back(look(inside + glm::dvec3(0.3, 0, 0), {-1, 0, 0}, degrees));
        views.push_back(look({0, 3000, 0}, {0, -1, 0}, degrees));
        views.push_back(look(inside - glm::dvec3(0, 0.9, 2), {0, 0, 1}, degrees, 1, 1));
        views.push_back(look(inside - glm::dvec3(0, 0.9, 2), {0, 0, 1}, degrees, 1, 300));
        views.push_back(look(inside - glm::dvec3(0, 0.9, 2), {0, 0, 1}, degrees, 300, 1));
    }
    return views;
}

constexpr double splat_sizes[] = {0, 0.1, 0.5, 1, 1.4, 4, 64};  // [px] 0: all as triangles

void expect_light_of_people(const render::Image& image, const std::string& what) {
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const auto [least, most] = std::minmax({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
        ASSERT_LE(most, grey + rounding) << what << ", pixel " << i / 3;
        ASSERT_LE(most - least, rounding) << what << ", pixel " << i / 3;
    }
}

std::string name_of(const render::View& view, double splat_size) {
    return "S " + std::to_string(splat_size) + ", " + std::to_string(view.width) + "x" + std::to_string(view.height) +
           ", half of the view's height " + std::to_string(view.tan_half_y);
}

class HostileCrowd : public testing::TestWithParam<bool> {
protected:
    static scene::Crowd crowd() { return GetParam() ? in_one_spot() : grey_people().crowd; }
};

TEST_P(HostileCrowd, ShowsNothingButLightThatPeopleSend) {
    const scene::Crowd everybody = crowd();
    Stage stage(everybody);
    int lit = 0;
    for (const render::View& view : hostile_views())
        for (const double splat_size : splat_sizes) {
            const render::Image image = stage.shoot(view, splat_size);
            expect_light_of_people(image, name_of(view, splat_size));
            if (HasFatalFailure()) return;
            lit += std::ranges::any_of(image.pixels, [](std::uint8_t byte) { return byte > 0; });
        }
    EXPECT_GT(lit, 50) << "nothing is shown";
}

// In the other order, on another number of threads, and by the portable instruction set.
TEST_P(HostileCrowd, IsTheSameWhateverWasDrawnBefore) {
    const scene::Crowd everybody = crowd();
    std::vector<render::Frame> frames;
    std::vector<render::Image> expected;
    Stage stage(everybody), again(everybody, 1);
    for (const render::View& view : hostile_views())
        for (const double splat_size : {0.0, 0.5, 64.0}) {
            frames.push_back(stage.frame(view, splat_size));
            expected.push_back(stage.shoot(frames.back()));
        }
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);  // on any machine
    const std::int64_t all = hwy::SupportedTargets(), portable = HWY_EMU128;
    for (std::size_t i = frames.size(); i-- > 0;) {
        tbb::task_arena arena(i % 2 ? 1 : 7);
        const bool is_portable = i % 3 == 0 && (all & portable) != 0;
        hwy::SetSupportedTargetsForTest(is_portable ? portable : 0);
        arena.execute([&] { EXPECT_EQ(again.shoot(frames[i]).pixels, expected[i].pixels) << "frame " << i; });
        hwy::SetSupportedTargetsForTest(0);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, HostileCrowd, testing::Bool(), [](const auto& one) {
    return one.param ? std::string("EverybodyInOneSpot") : std::string("AStadium");
});

TEST(HostileViews, OfManyTrianglePeopleInOnePlaceAreThoseOfOne) {
    Stage stage(grey_people().crowd);
    for (const render::View& view : hostile_views()) {
        render::Frame frame = stage.frame(view, 0);
        if (frame.people.empty()) continue;
        frame.people.resize(1);
        const render::Image one = stage.shoot(frame);
        frame.people.resize(500, frame.people[0]);
        EXPECT_EQ(stage.shoot(frame).pixels, one.pixels) << name_of(view, 0);
    }
}

TEST(HostileViews, OfNobodyAreBlack) {
    Stage stage(grey_people().crowd);
    const glm::dvec3 above = grey_people().inside_somebody() + glm::dvec3(0, 60, 0);
    for (const double degrees : {1.0, 50.0, 170.0})
        for (const double splat_size : splat_sizes) {
            // Straight up, and into the ground from below it.
            for (const render::View& view :
                 {look(above, {0, 1, 0}, degrees), look(above - glm::dvec3(0, 500, 0), {0, -1, 0}, degrees)}) {
                const render::Frame frame = stage.frame(view, splat_size);
                EXPECT_TRUE(frame.people.empty());
                const std::vector<std::uint8_t> pixels = stage.shoot(frame).pixels;
                EXPECT_EQ(std::ranges::count(pixels, 0), static_cast<std::ptrdiff_t>(pixels.size()));
            }
        }
}

TEST(HostileViews, OfTheLargestPicturesAreTheSameTwice) {
    Stage stage(grey_people().crowd), again(grey_people().crowd, 1);
    const glm::dvec3 before = grey_people().inside_somebody() - glm::dvec3(0, 0.5, 3);
    for (const auto& [width, height] : {std::pair(8192, 64), std::pair(64, 8192)})
        for (const double splat_size : {0.0, 1.4, 64.0}) {
            const render::View view = look(before, {0, 0, 1}, 50, width, height);
            const render::Image image = stage.shoot(view, splat_size);
            expect_light_of_people(image, name_of(view, splat_size));
            EXPECT_EQ(again.shoot(view, splat_size).pixels, image.pixels) << name_of(view, splat_size);
        }
}

}  // namespace
