// The processor's pictures against the reference's: five characters before the sky, and the stadium's presets. Needs no
// OpenGL.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/reference/harlequin.h"
#include "tests/reference/stadium.h"
#include "tests/reference/studio.h"

namespace {

using reference::Comparison;
using sfsm::Decision;
using sfsm::State;

const figures::Way& way = figures::natively();
const scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};

// [of 255] That bytes are round alone makes 0.38: the mean of the largest of three errors of up to a half.
// A plain body that fills the picture adds a packed normal's share.
constexpr double most_mean = 1;

// As triangles. Pixels may be off by reference::tolerance, as OpenGL's may, with these exceptions:
struct Exceptions {
    double plain, all;  // the shares of plain pixels, and of all, that may be off by more
};

void expect_alike(const render::Image& image, const reference::Picture& expected, const Exceptions& exceptions,
                  const std::string& what) {
    const Comparison found = reference::compare(image, expected);
    EXPECT_LE(found.wrong_plain, 1 + exceptions.plain * found.plain) << what << ": " << found.text();
    EXPECT_LE(found.wrong, 1 + exceptions.all * found.pixels) << what << ": " << found.text();
    EXPECT_LE(found.mean, most_mean) << what << ": " << found.text();
}

// As points. Where in a pixel a point falls is left to chance, so that squares of some pixels are compared.
struct Averages {
    int side;            // [px]
    double worst, mean;  // [of 255] of any square, and of pixels
};

void expect_alike_on_average(const render::Image& image, const reference::Picture& expected, const Averages& most,
                             const std::string& what) {
    const double worst = reference::worst_mean(image, expected, most.side);
    const double mean = reference::mean_error(image, expected);
    EXPECT_LE(worst, most.worst) << what;
    EXPECT_LE(mean, most.mean) << what;
}

class NativePortrait : public testing::TestWithParam<const char*> {
protected:
    static constexpr int width = 200, height = 160;  // [px]

    void SetUp() override {
        model_ = reference::model_of_file(GetParam(), way);
        if (!model_) GTEST_SKIP() << "NO ../shared/assets/" << GetParam() << ", IT IS NOT DRAWN";
        renderer_ = reference::make_renderer(way, nothing, {}, std::vector{model_->product()}, width, height);
    }

    render::Image shoot(const reference::Person& person, const scene::CameraPose& pose, double splat_size) {
        const render::View view = render::make_view(pose, width, height);
        const reference::Model* const models[] = {model_.get()};
        renderer_->begin(view);
        renderer_->draw(reference::frame_of({&person, 1}, models, view, splat_size, way));
        return renderer_->read_image();
    }

    reference::Picture expect(const reference::Person& person, const scene::CameraPose& pose, double splat_size) const {
        return reference::draw(
            {{pose, width, height}, {person}, nullptr, {}, 0, splat_size, reference::samples_of(way, splat_size)});
    }

    std::unique_ptr<reference::Model> model_;
    std::unique_ptr<render::Renderer> renderer_;
};

TEST_P(NativePortrait, IsTheReferences) {
    // Vertices are snapped to a 32nd of a pixel, the places that the reference looks at are a 32nd apart from a sample.
    constexpr Exceptions exceptions{0, 1.0 / 2000};
    for (const reference::Sitting& one : reference::all_around(*model_, {0.35, 1.2, 3.0, 12.0, 90.0, 400.0}))
        expect_alike(shoot(one.person, one.pose, 0), expect(one.person, one.pose, 0), exceptions, one.what);
}

TEST_P(NativePortrait, IsTheReferencesOnAverageByPoints) {
    // Splats of S pixels blur outlines by about as much, and textures.
    constexpr double worst_by_size = 15, most_mean_error = 0.6;  // [of 255 / px], [of 255]
    constexpr std::size_t every = 5;                             // of the sittings: with all sides, and both poses
    const std::vector<reference::Sitting> all = reference::all_around(*model_, {40.0, 120.0});
    for (std::size_t i = 0; i < all.size(); i += every) {
        const reference::Sitting& one = all[i];
        const reference::Picture expected = expect(one.person, one.pose, 1);
        const double distance = glm::distance(one.pose.position, one.pose.target);
        const render::View view = render::make_view(one.pose, width, height);
        const double pixels = one.person.scale * view.pixels_per_metre(static_cast<float>(distance));
        const figures::Figure figure = model_->product();
        for (const double splat_size : {1.0}) {
            const double squares = figure.poses->area * pixels * pixels / (splat_size * splat_size);
            reference::Person by_points = one.person;
            by_points.points =
                figures::part_of(way.representations[1].levels(figure).back(), static_cast<float>(1.2 * squares)).count;
            expect_alike_on_average(shoot(by_points, one.pose, splat_size), expected,
                                    {8, worst_by_size * splat_size, most_mean_error},
                                    one.what + ", S " + std::to_string(splat_size));
        }
    }
}

void expect_harlequin_alike(model::Character harlequin) {
    constexpr int width = 200, height = 160;  // [px]
    constexpr Exceptions exceptions{0, 1.0 / 2000};
    const reference::Model model(std::move(harlequin), {0, 1}, 400);
    const auto renderer = reference::make_renderer(way, nothing, {}, std::vector{model.product()}, width, height);
    const reference::Model* const models[] = {&model};
    for (const reference::Sitting& one : reference::all_around(model, {0.35, 1.2, 3.0, 12.0, 90.0})) {
        const render::View view = render::make_view(one.pose, width, height);
        renderer->begin(view);
        renderer->draw(reference::frame_of({&one.person, 1}, models, view, 0, way));
        const reference::Picture expected = reference::draw(
            {{one.pose, width, height}, {one.person}, nullptr, {}, 0, 0, reference::samples_of(way, 0)});
        expect_alike(renderer->read_image(), expected, exceptions, one.what);
    }
}

TEST(NativeHarlequin, WithCutoutsAndSamplersIsTheReferences) {
    expect_harlequin_alike(reference::make_masked_harlequin());
}

// Which side is seen the triangle says, not the normals.
TEST(NativeHarlequin, OfLeaningNormalsIsTheReferences) {
    expect_harlequin_alike(reference::make_leaning_harlequin());
}

// Black, a little larger than all of it, and facing inward.
void add_outline_hull(model::Mesh& mesh) {
    constexpr float thickness = 0.01f;  // [m]
    const std::size_t vertices = mesh.vertex_count(), corners = mesh.indices.size();
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.positions.push_back(mesh.positions[v] + thickness * mesh.normals[v]);
        mesh.normals.push_back(-mesh.normals[v]);
        mesh.uvs.push_back(mesh.uvs[v]);
        mesh.colors.emplace_back(0, 0, 0, 255);
        mesh.slots.push_back(model::no_slot);
        mesh.material_ids.push_back(static_cast<std::uint16_t>(mesh.materials.size()));
        mesh.joints.push_back(mesh.joints[v]);
        mesh.weights.push_back(mesh.weights[v]);
    }
    mesh.materials.emplace_back();
    for (std::size_t i = 0; i < corners; i += 3)
        for (const std::size_t k : {1, 0, 2})
            mesh.indices.push_back(static_cast<std::uint32_t>(vertices) + mesh.indices[i + k]);
}

// Beside materials of both kinds, as triangles and as points: drawn from both sides, the hull would make it black.
TEST(NativeHarlequin, InAnOutlineHullLooksAsItDoesWithout) {
    constexpr int width = 200, height = 160;        // [px]
    constexpr double rim = 0.35, by_chance = 0.35;  // of what a black body would be off
    for (const bool is_double_sided : {false, true}) {
        model::Character bare = reference::make_harlequin(false);
        for (model::Material& material : bare.mesh.materials) material.double_sided = is_double_sided;
        model::Character hulled = bare;
        bare.mesh.morphs.clear();
        hulled.mesh.morphs.clear();
        add_outline_hull(hulled.mesh);
        model::Character black = bare;
        for (glm::u8vec4& color : black.mesh.colors) color = {0, 0, 0, 255};
        constexpr std::size_t points = 2000;
        const reference::Model model(bare, {}, points), in_hull(hulled, {}, points), all_black(black, {}, points);
        const auto shoot = [&](const reference::Model& of, const reference::Sitting& one, std::size_t by_points) {
            reference::Person person = one.person;
            person.figure = &of.figure;
            person.points = by_points;
            const reference::Model* const models[] = {&of};
            const auto renderer = reference::make_renderer(way, nothing, {}, std::vector{of.product()}, width, height);
            const render::View view = render::make_view(one.pose, width, height);
            renderer->begin(view);
            renderer->draw(reference::frame_of({&person, 1}, models, view, 1, way));
            return renderer->read_image();
        };
        const auto off = [](const render::Image& a, const render::Image& b) {
            double sum = 0;
            for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
            return sum / static_cast<double>(a.pixels.size());
        };
        const auto mean = [](const render::Image& image) {
            double sum = 0;
            for (const std::uint8_t value : image.pixels) sum += value;
            return sum / static_cast<double>(image.pixels.size());
        };
        for (const reference::Sitting& one : reference::all_around(model, {12.0})) {
            const render::Image without = shoot(model, one, 0), with = shoot(in_hull, one, 0);
            EXPECT_LT(off(without, with), rim * off(without, shoot(all_black, one, 0))) << one.what;
            // Points' places differ, so that only what they send together is compared.
            const double sent = mean(shoot(in_hull, one, points));
            const double lost = mean(with) - mean(shoot(all_black, one, 0));
            EXPECT_NEAR(sent, mean(with), by_chance * lost) << one.what;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Files, NativePortrait,
                         testing::Values("CesiumMan/CesiumMan.glb", "Fox/Fox.glb", "KayKitMage/Mage.glb",
                                         "QuaterniusKnight/KnightCharacter.glb", "RaylibRobot/robot.glb"));

constexpr std::int64_t tick = 1234;

reference::Stadium& stadium() {
    static const tests::SmallScene scene(600, 2);
    static reference::Stadium stadium(scene, 320, 180, way);
    return stadium;
}

class NativeStadiumPicture : public testing::TestWithParam<const char*> {
protected:
    reference::Frame shoot(const Decision& decision) {
        return stadium().shoot(stadium().preset(GetParam()), decision, tick);
    }
};

// The shade around who runs and walks, on the track.
TEST(NativeFeet, AreTheReferences) {
    for (const scene::CameraPose& pose : stadium().at_feet(tick)) {
        const reference::Frame frame = stadium().shoot(pose, {}, tick);
        const reference::Frame without = stadium().shoot(pose, {}, tick, false);
        EXPECT_GT(reference::compare(without.drawn, without.expected).wrong, 200) << "nothing is shown";
        expect_alike(frame.drawn, frame.expected, {1.0 / 10000, 1.0 / 2000},
                     "feet at " + std::to_string(pose.target.x));
    }
}

TEST_P(NativeStadiumPicture, IsTheReferences) {
    // Seats that are far are thinner than it is between the places that the reference looks at, and any of four samples
    // may meet one there.
    constexpr Exceptions exceptions{1.0 / 10000, 1.0 / 2000};
    for (const Decision& decision : {Decision{}, Decision{State::slowed, 1, 0}, Decision{State::slowed, 30, 0}}) {
        const reference::Frame frame = shoot(decision);
        expect_alike(frame.drawn, frame.expected, exceptions,
                     std::string(GetParam()) + ", D = " + std::to_string(decision.motion_distance));
    }
}

TEST_P(NativeStadiumPicture, IsTheReferencesOnAverageByPoints) {
    // Coverage is right on average, and outlines are spread over the pixels beside them.
    constexpr Averages most{20, 8, 3};
    for (const double splat_size : {1.0}) {
        const reference::Frame frame = shoot({State::points, 40, splat_size});
        expect_alike_on_average(frame.drawn, frame.expected, most,
                                std::string(GetParam()) + ", S " + std::to_string(splat_size));
    }
}

INSTANTIATE_TEST_SUITE_P(Presets, NativeStadiumPicture, testing::Values("still", "close", "medium", "remote"));

}  // namespace
