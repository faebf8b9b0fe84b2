// What shines by itself, by OpenGL: as points and as triangles, in any light.
#include "tests/reference/own_light.h"
#include "tests/render/gl_test.h"

namespace {

using reference::Shine;
using Booth = reference::Booth<render::gl::Renderer>;

using GlOwnLight = tests::GlTest;

constexpr std::size_t point_count = 800;
constexpr std::size_t counts[] = {0, 6, 24, 384};  // triangles; means, of both sides and of one; single points

TEST_F(GlOwnLight, TheUnlitShowTheirColoursInAnyLight) {
    constexpr int rounding = 1;  // [of 255]
    const reference::Model dull(reference::make_shining_harlequin(Shine::no), {0, 1}, point_count);
    const reference::Model unlit(reference::make_shining_harlequin(Shine::unlit), {0, 1}, point_count);
    reference::expect_own_colors<render::gl::Renderer>(dull, unlit, figures::by_opengl(), counts, 3, rounding);
}

TEST_F(GlOwnLight, WhatIsEmittedIsAdded) {
    constexpr int rounding = 2;  // [of 255] of three pictures
    const reference::Model dull(reference::make_shining_harlequin(Shine::no), {0, 1}, point_count);
    const reference::Model glowing(reference::make_shining_harlequin(Shine::glowing), {0, 1}, point_count);
    Booth lit(dull, reference::weak_light(), figures::by_opengl());
    Booth both(glowing, reference::weak_light(), figures::by_opengl());
    Booth in_the_dark(glowing, reference::no_light(), figures::by_opengl());
    for (const std::size_t points : counts)
        for (const int side : {0, 1, 2}) {
            const render::Image emitted = in_the_dark.shoot(points, side);
            EXPECT_GT(reference::brightest(emitted), 100);
            EXPECT_LE(reference::worst_difference(reference::sum_of(lit.shoot(points, side), emitted),
                                                  both.shoot(points, side)),
                      rounding)
                << points << " points from side " << side;
        }
}

}  // namespace
