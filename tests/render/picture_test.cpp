// What reaches the pixels, held against projections done here.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>

#include "render/gl/renderer.h"
#include "render/gl/texture_array.h"
#include "scene/static_mesh_builder.h"
#include "tests/render/gl_test.h"
#include "tests/render/small_scene.h"

namespace {

using Picture = tests::GlTest;

constexpr int width = 320, height = 240;

// One person, a camera in front of them, and nothing but sky behind.
struct Portrait {
    tests::SmallScene scene{1};
    scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};
    render::gl::Renderer renderer;

    explicit Portrait(const scene::Light& light = {}) : renderer(nothing, {}, light, scene.figures(), width, height) {}

    render::View view(double distance) const {
        const scene::Placement at = scene::place(scene.crowd, 0, scene.cast[0], 0);
        scene::CameraPose pose;
        pose.target = glm::dvec3(at.position) + glm::dvec3(0, 0.8, 0);
        pose.position = pose.target + glm::dvec3(std::sin(at.yaw), 0, std::cos(at.yaw)) * distance;
        return render::make_view(pose, width, height);
    }
    render::Image draw(const render::View& view, const sfsm::Decision& decision) {
        render::Selector selector(scene.crowd, scene.cast, scene.figures());
        selector.survey(view, 0);
        renderer.draw(selector.select(decision, -1));
        return renderer.read_image();
    }
    render::Image draw_nobody(const render::View& view) {
        render::Frame nobody;
        nobody.view = view;
        renderer.draw(nobody);
        return renderer.read_image();
    }
};

std::set<int> differing_pixels(const render::Image& a, const render::Image& b) {
    std::set<int> pixels;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (a.pixels[i] != b.pixels[i]) pixels.insert(static_cast<int>(i / 3));
    return pixels;
}

struct Box {
    int left = width, right = -1, top = height, bottom = -1;
};

Box box_of(const std::set<int>& pixels) {
    Box box;
    for (int pixel : pixels) {
        box.left = std::min(box.left, pixel % width);
        box.right = std::max(box.right, pixel % width);
        box.top = std::min(box.top, pixel / width);
        box.bottom = std::max(box.bottom, pixel / width);
    }
    return box;
}

// Where the posed vertices of the only person land.
Box projected_box(const Portrait& portrait, const render::View& view) {
    const tests::SmallScene& scene = portrait.scene;
    const motion::PoseTable& table = scene.poses[0];
    const scene::Placement at = scene::place(scene.crowd, 0, scene.cast[0], 0);
    const scene::Action action = scene::act(scene.crowd, 0, scene.cast[0], table, 0);
    const int pose = table.pose_at(action.clip, action.clip_tick);
    const float scale = scene.crowd.height[0] / table.rest_height;
    Box box;
    for (int vertex = 0; vertex < table.vertex_count; ++vertex) {
        const glm::vec3 p = motion::unpack_position(table.vertices[pose * table.vertex_count + vertex], table.box);
        const float s = std::sin(at.yaw), c = std::cos(at.yaw);
        const glm::vec3 placed =
            view.relative(at.position) + scale * glm::vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
        const glm::vec4 clip = view.clip_from_camera_relative * glm::vec4(placed, 1.0f);
        const auto x = static_cast<int>(std::floor(0.5f * width * (1.0f + clip.x / clip.w)));
        const auto y = static_cast<int>(std::floor(0.5f * height * (1.0f - clip.y / clip.w)));
        box.left = std::min(box.left, x);
        box.right = std::max(box.right, x);
        box.top = std::min(box.top, y);
        box.bottom = std::max(box.bottom, y);
    }
    return box;
}

TEST_F(Picture, PersonStandsWhereTheirPoseProjects) {
    Portrait portrait;
    const render::View view = portrait.view(3.0);
    const Box drawn = box_of(differing_pixels(portrait.draw(view, {}), portrait.draw_nobody(view)));
    const Box expected = projected_box(portrait, view);
    constexpr int rounding = 1;  // [px] a vertex need not cover the pixel it falls in
    EXPECT_NEAR(drawn.left, expected.left, rounding);
    EXPECT_NEAR(drawn.right, expected.right, rounding);
    EXPECT_NEAR(drawn.top, expected.top, rounding);
    EXPECT_NEAR(drawn.bottom, expected.bottom, rounding);
}

TEST_F(Picture, PointsCoverTheSilhouetteAndLittleElse) {
    Portrait portrait;
    // About 110 to 18 px tall. Some holes are left; and a splat sticks out of thin limbs by up to half its size on both
    // sides.
    for (const double distance : {4.0, 6.0, 12.0, 24.0}) {
        const render::View view = portrait.view(distance);
        const render::Image nobody = portrait.draw_nobody(view);
        const std::set<int> triangles = differing_pixels(portrait.draw(view, {}), nobody);
        for (const double splat_size : {1.0, 2.0, 4.0}) {
            const render::Image image = portrait.draw(view, {sfsm::State::points, 100, splat_size});
            const std::set<int> points = differing_pixels(image, nobody);
            std::vector<int> both;
            std::set_intersection(triangles.begin(), triangles.end(), points.begin(), points.end(),
                                  std::back_inserter(both));
            const double covered = static_cast<double>(both.size()) / static_cast<double>(triangles.size());
            const double grown = static_cast<double>(points.size()) / static_cast<double>(triangles.size());
            if (splat_size * distance > 48) continue;  // a splat is a quarter of the person: a mere blob
            EXPECT_GT(covered, 0.9) << "S " << splat_size << " px at " << distance << " m";
            EXPECT_LT(grown, 2.0) << "S " << splat_size << " px at " << distance << " m";
        }
    }
}

// [px] How far the farthest of `pixels` is from the nearest of `of`, along the rows or columns.
int farthest_from(const std::set<int>& of, const std::set<int>& pixels) {
    int farthest = 0;
    for (const int pixel : pixels) {
        int reach = 0;
        const auto any_within = [&] {
            for (int y = -reach; y <= reach; ++y)
                for (int x = -reach; x <= reach; ++x)
                    if (of.contains(pixel + y * width + x)) return true;
            return false;
        };
        while (!any_within()) ++reach;
        farthest = std::max(farthest, reach);
    }
    return farthest;
}

// What the forecast says that splats lose.
TEST_F(Picture, SplatsReachHalfTheirSizeBeyondTheOutline) {
    Portrait portrait;
    const render::View view = portrait.view(3.0);  // about 150 px tall
    const render::Image nobody = portrait.draw_nobody(view);
    const std::set<int> triangles = differing_pixels(portrait.draw(view, {}), nobody);
    render::Selector selector(portrait.scene.crowd, portrait.scene.cast, portrait.scene.figures());
    const sfsm::Forecast forecast = selector.survey(view, 0).forecast;
    int checked = 0;
    for (const sfsm::Step& step : std::vector(forecast.shapes.begin(), forecast.shapes.end())) {
        if (step.setting < 5 || step.setting > 14 || step.work[sfsm::WorkKind::point] == 0) continue;
        ++checked;
        EXPECT_NEAR(step.loss_px, step.setting / 2, 1e-6);
        const std::set<int> points =
            differing_pixels(portrait.draw(view, {sfsm::State::points, 100, step.setting}), nobody);
        // The outline's farthest spots may lie just off the nearest point.
        const int reach = farthest_from(triangles, points);
        EXPECT_LE(reach, step.loss_px + 1) << "S = " << step.setting;
        EXPECT_GE(reach, 0.6 * step.loss_px) << "S = " << step.setting;
    }
    EXPECT_GE(checked, 4);
}

TEST_F(Picture, SplatsNeverOutgrowTheirPerson) {
    Portrait portrait;
    const render::View view = portrait.view(60.0);  // about 7 px tall
    const render::Image nobody = portrait.draw_nobody(view);
    const Box person = projected_box(portrait, view);
    const Box splats = box_of(differing_pixels(portrait.draw(view, {sfsm::State::points, 100, 32.0}), nobody));
    ASSERT_GE(splats.right, 0);
    const int tall = person.bottom - person.top + 1;
    EXPECT_LE(splats.bottom - splats.top, tall + tall / 2);
    EXPECT_LE(splats.right - splats.left, tall + tall / 2);
}

TEST_F(Picture, IsTheSameTwice) {
    Portrait portrait;
    const render::View view = portrait.view(5.0);
    EXPECT_EQ(portrait.draw(view, {}).pixels, portrait.draw(view, {}).pixels);
}

TEST_F(Picture, ResizedTargetHasItsNewSize) {
    Portrait portrait;
    portrait.renderer.resize(64, 48);
    const render::Image image = portrait.draw_nobody(portrait.view(3.0));
    EXPECT_EQ(image.width, 64);
    EXPECT_EQ(image.pixels.size(), 64u * 48u * 3u);
    // A sky, not the cleared black.
    EXPECT_TRUE(
        std::all_of(image.pixels.begin(), image.pixels.begin() + 3 * 64, [](std::uint8_t v) { return v > 20; }));
}

TEST_F(Picture, IsLitByItsPlace) {
    scene::Light light;
    light.sun = light.glare = glm::vec3(0);
    light.from_above = light.from_below = {0.5f, 0, 0};
    light.haze = light.zenith = {0.2f, 0.4f, 0.6f};
    Portrait portrait(light);
    const render::View view = portrait.view(3.0);
    const render::Image nobody = portrait.draw_nobody(view), somebody = portrait.draw(view, {});
    for (std::size_t i = 0; i < nobody.pixels.size(); i += 3) {
        ASSERT_NEAR(nobody.pixels[i], 51, 1);
        ASSERT_NEAR(nobody.pixels[i + 1], 102, 1);
        ASSERT_NEAR(nobody.pixels[i + 2], 153, 1);
    }
    const std::set<int> person = differing_pixels(somebody, nobody);
    EXPECT_GT(person.size(), 1000u);
    for (const int pixel : person) {
        ASSERT_EQ(somebody.pixels[static_cast<std::size_t>(3 * pixel + 1)], 0) << "no light but red";
        ASSERT_EQ(somebody.pixels[static_cast<std::size_t>(3 * pixel + 2)], 0);
    }
}

TEST_F(Picture, OfAFigureWithoutPointsIsOfItsTriangles) {
    tests::SmallScene scene(1);
    scene.points = {};
    scene.poses[0].points.clear();
    scene.poses[0].point_count = 0;
    const scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};
    render::gl::Renderer renderer(nothing, {}, {}, scene.figures(), width, height);
    render::Selector selector(scene.crowd, scene.cast, scene.figures());
    Portrait portrait;
    const render::View view = portrait.view(3.0);
    selector.survey(view, 0);
    renderer.draw(selector.select({sfsm::State::points, 100, 8}, -1));
    EXPECT_EQ(renderer.read_image().pixels, portrait.draw(view, {}).pixels);
}

TEST_F(Picture, KeepsItsSizeWhenTheDriverHasNoneSoLarge) {
    Portrait portrait;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    const render::View view = portrait.view(3.0);
    const render::Image before = portrait.draw(view, {});
    EXPECT_THROW(portrait.renderer.resize(largest + 1, height), std::runtime_error);
    EXPECT_THROW(portrait.renderer.resize(width, largest + 1), std::runtime_error);
    EXPECT_EQ(portrait.draw(view, {}).pixels, before.pixels);
}

// The stadium's ground from straight above, 30 m from its middle, with parameters that put each of its parts there.
TEST_F(Picture, OfTheGroundIsWhatItsPlaceSays) {
    scene::StaticMeshBuilder builder;
    builder.ground();
    builder.close_sector();
    const scene::Light light;
    const glm::vec3 daylight = light.from_above + light.to_sun.y * light.sun;
    const std::pair<glm::vec3, glm::vec3> parts[] = {{{0, 24.5f, 30}, {0.32f, 0.075f, 0.045f}},  // track
                                                     {{0, 19, 30}, {0.10f, 0.17f, 0.20f}},       // apron
                                                     {{20, 0, 30}, {0.10f, 0.17f, 0.20f}},       // around a point
                                                     {{0, 5, 10}, {0.26f, 0.25f, 0.235f}}};      // paving
    for (const auto& [numbers, color] : parts) {
        render::gl::Renderer renderer(builder.mesh, {"stadium.glsl", {glm::vec4(numbers, 0)}}, light, {}, 8, 8);
        render::Frame nobody;
        nobody.view = render::make_view({{30.5, 2, 0.5}, {30.5, 0, 0.501}, 0.1}, 8, 8);
        renderer.draw(nobody);
        const render::Image image = renderer.read_image();
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(image.pixels[static_cast<std::size_t>(3 * 36 + channel)],
                        255 * std::sqrt(color[channel] * daylight[channel]), 1)
                << numbers.x << ' ' << numbers.y << ' ' << numbers.z << " channel " << channel;
    }
}

// Before it is drawn: triangles of the sectors in view, and all of the picture's pixels.
TEST_F(Picture, HasItsWorkAroundPeopleKnownBeforehand) {
    scene::StaticMeshBuilder builder;
    builder.ground();
    builder.close_sector();
    render::gl::Renderer renderer(builder.mesh, {"stadium.glsl", {}}, {}, {}, 8, 8);
    const auto triangles = static_cast<std::int64_t>(builder.mesh.indices.size() / 3);
    ASSERT_GT(triangles, 0);
    const auto work_towards = [&](glm::dvec3 target) {
        return renderer.begin(render::make_view({{0, 5, 0}, target, 0.5}, 16, 9)).work;
    };
    EXPECT_EQ(work_towards({1, 0, 0}), (sfsm::Work{0, 0, 0, 0, triangles, 16 * 9}));
    EXPECT_EQ(work_towards({0, 50, 0}), (sfsm::Work{0, 0, 0, 0, 0, 16 * 9})) << "straight up";
}

// A look has five bits for its layer, and one number says that there is none.
TEST_F(Picture, HasNoMoreTexturesThanALookCanName) {
    const model::Texture white{1, 1, {glm::u8vec4(255)}};
    std::vector<model::Texture> textures(31, white);
    EXPECT_NO_THROW(render::gl::make_texture_array(textures));
    textures.push_back(white);
    EXPECT_THROW(render::gl::make_texture_array(textures), std::runtime_error);
}

TEST(Png, StartsWithItsSignatureAndEndsWithItsLastChunk) {
    const render::Image image{3, 2, std::vector<std::uint8_t>(18, 77)};
    const std::vector<std::uint8_t> bytes = render::encode_png(image);
    ASSERT_GT(bytes.size(), 20u);
    EXPECT_EQ(std::string(bytes.begin() + 1, bytes.begin() + 4), "PNG");
    EXPECT_EQ(std::string(bytes.end() - 8, bytes.end() - 4), "IEND");
}

}  // namespace
