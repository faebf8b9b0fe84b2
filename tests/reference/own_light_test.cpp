// What shines by itself, natively: as points and as triangles, in any light.
#include "tests/reference/own_light.h"

#include <gtest/gtest.h>

#include <array>

#include "render/native/splat_model.h"

namespace {

using reference::Shine;
using Booth = reference::Booth<render::native::Renderer>;

constexpr std::size_t point_count = 1500;
// Triangles; what stands for both sides, what is a mean, what is summed up, and more.
constexpr std::size_t counts[] = {0, 7, 20, 60, 300, 1200};

const reference::Model& dull() {
    static const reference::Model model(reference::make_shining_harlequin(Shine::no), {0, 1}, point_count);
    return model;
}
const reference::Model& unlit() {
    static const reference::Model model(reference::make_shining_harlequin(Shine::unlit), {0, 1}, point_count);
    return model;
}

const reference::Model& glowing() {
    static const reference::Model model(reference::make_shining_harlequin(Shine::glowing), {0, 1}, point_count);
    return model;
}

TEST(NativeOwnLight, TheUnlitShowTheirColoursInAnyLight) {
    constexpr int rounding = 2;  // [of 255] of sums in 16 bits, where it is dark
    reference::expect_own_colors<render::native::Renderer>(dull(), unlit(), figures::natively(), counts, 4, rounding);
}

// What very far people and the few points of far ones show.
TEST(NativeOwnLight, FromFarTheUnlitSendTheirColoursInAnyLight) {
    const render::native::SplatModel plain(dull().product(), reference::plain_light());
    for (const scene::Light& light : {reference::odd_light(), reference::no_light()}) {
        const render::native::SplatModel shining(unlit().product(), light);
        for (const int azimuth : {0, 3, 6})
            for (int node = 0; node < render::native::direction_nodes; node += 7) {
                const auto expected = plain.lights(2, azimuth, node), found = shining.lights(2, azimuth, node);
                for (std::size_t slot = 0; slot < expected.size(); ++slot)
                    for (int channel = 0; channel < 3; ++channel)
                        EXPECT_NEAR(found[slot][channel], expected[slot][channel], 1e-3);
            }
    }
}

TEST(ReferenceOwnLight, TheUnlitShowTheirColours) {
    model::Character character = reference::make_shining_harlequin(Shine::unlit);
    character.mesh.materials.resize(1);
    std::ranges::fill(character.mesh.material_ids, std::uint16_t{0});
    std::ranges::fill(character.mesh.slots, model::no_slot);
    const glm::u8vec4 color(200, 120, 60, 255);
    std::ranges::fill(character.mesh.colors, color);
    const reference::Model model(std::move(character), {0, 1}, 100);
    for (const std::size_t points : {0, 6, 96}) {
        reference::Person person = reference::sitter(model, 0, 0);
        person.points = points;
        const reference::Picture picture =
            reference::draw({{reference::camera(person, 1, 0.2, 4), 60, 50}, {person}, nullptr, {}, 0, 4});
        int seen = 0;
        for (std::size_t i = 0; i < picture.colors.size(); ++i) {
            if (picture.shades[i].size() > 1 || picture.sky[i]) continue;
            ++seen;
            for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(picture.colors[i][channel], color[channel], 1e-6);
        }
        EXPECT_GT(seen, 10) << points;
    }
}

TEST(NativeOwnLight, WhatIsEmittedIsAdded) {
    constexpr int rounding = 8;        // [of 255] of few points: their colours are scaled to send what all do
    constexpr double in_total = 0.03;  // of the light
    Booth lit(dull(), reference::weak_light(), figures::natively());
    Booth both(glowing(), reference::weak_light(), figures::natively());
    Booth in_the_dark(glowing(), reference::no_light(), figures::natively());
    for (const std::size_t points : counts)
        for (const int side : {0, 1, 2, 3}) {
            const render::Image emitted = in_the_dark.shoot(points, side);
            EXPECT_GT(reference::brightest(emitted), 100);
            const render::Image sum = reference::sum_of(lit.shoot(points, side), emitted);
            const render::Image found = both.shoot(points, side);
            EXPECT_LE(reference::worst_difference(sum, found), rounding) << points << " points from side " << side;
            const glm::dvec3 ratio = reference::light_of(found) / reference::light_of(sum);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(ratio[channel], 1, in_total) << points << " points from side " << side;
        }
}

TEST(NativeOwnLight, PointsEmitWhatTrianglesDo) {
    constexpr double near_enough = 0.1;
    Booth in_the_dark(glowing(), reference::no_light(), figures::natively());
    for (const int side : {0, 1, 2, 3}) {
        const glm::dvec3 sent = reference::light_of(in_the_dark.shoot(1200, side, 12));
        const glm::dvec3 truth = reference::light_of(in_the_dark.shoot(0, side, 12));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(sent[channel] / truth[channel], 1, near_enough) << "side " << side;
    }
}

TEST(NativeOwnLight, FromFarWhatIsEmittedIsAdded) {
    const render::native::SplatModel lit(dull().product(), reference::weak_light());
    const render::native::SplatModel both(glowing().product(), reference::weak_light());
    const render::native::SplatModel in_the_dark(glowing().product(), reference::no_light());
    for (const int azimuth : {0, 3, 6})
        for (int node = 0; node < render::native::direction_nodes; node += 7)
            for (std::size_t slot = 0; slot <= model::slot_count; ++slot) {
                const glm::vec3 sum = lit.lights(2, azimuth, node)[slot] + in_the_dark.lights(2, azimuth, node)[slot];
                const glm::vec3 found = both.lights(2, azimuth, node)[slot];
                for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(found[channel], sum[channel], 1e-3);
            }
}

TEST(PointsOwnLight, IsTheMaterials) {
    for (const glm::u8vec4& own : unlit().points.own_lights) ASSERT_EQ(own, glm::u8vec4(0, 0, 0, 255));
    EXPECT_TRUE(dull().points.own_lights.empty());
    const model::Mesh& mesh = glowing().character.mesh;
    int plain = 0;
    for (std::size_t i = 0; i < glowing().points.size(); ++i) {
        const std::uint32_t corner = mesh.indices[3 * std::size_t{glowing().points.surface[i].triangle} + 2];
        if (mesh.material_ids[corner] != 0) continue;
        ASSERT_EQ(glowing().points.own_lights[i], glm::u8vec4(124, 63, 170, 0));  // sRGB of 0.2, 0.05, 0.4
        ++plain;
    }
    EXPECT_GT(plain, 100);
}

TEST(NativeOwnLight, IsTheReferences) {
    constexpr int width = 200, height = 160;  // [px]
    const scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};
    const figures::Way& way = figures::natively();
    for (const reference::Model* model : {&unlit(), &glowing()}) {
        const auto renderer = reference::make_renderer(way, nothing, {}, std::vector{model->product()}, width, height);
        for (const reference::Sitting& one : reference::all_around(*model, {1.2, 12.0})) {
            const render::View view = render::make_view(one.pose, width, height);
            renderer->begin(view);
            renderer->draw(reference::frame_of({&one.person, 1}, std::array{model}, view, 0, way));
            const reference::Scene scene{{one.pose, width, height},    {one.person}, nullptr, {}, 0, 0,
                                         reference::samples_of(way, 0)};
            const reference::Comparison found = reference::compare(renderer->read_image(), reference::draw(scene));
            EXPECT_LE(found.wrong, 1 + found.pixels / 1000) << one.what << ": " << found.text();
        }
    }
}

}  // namespace
