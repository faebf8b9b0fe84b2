// By OpenGL, too, a place ten thousand kilometres away looks as it does at the world's origin.
#include <gtest/gtest.h>

#include "render/gl/renderer.h"
#include "tests/precision/moved.h"
#include "tests/render/gl_test.h"

namespace {

using namespace precision;

std::unique_ptr<render::Renderer> by_opengl(const scene::Place& place) {
    return std::make_unique<render::gl::Renderer>(place.structure, place.ground, place.light, cast_of_one().figures(),
                                                  width, height);
}

using MovedGl = tests::GlTest;

TEST_F(MovedGl, ByWholeMetresIsTheSameToTheByte) {
    expect_alike_elsewhere(even_way, figures::by_opengl(), by_opengl, 0);
}

TEST_F(MovedGl, ByAnyWayIsTheSameButForAFewPixels) {
    expect_alike_elsewhere(odd_way, figures::by_opengl(), by_opengl, few_pixels);
}

TEST_F(MovedGl, BlocksMayBeToldFromAnyOrigin) {
    expect_alike_from_everywhere(figures::by_opengl(), by_opengl);
}

TEST_F(MovedGl, AfterThirtyDaysASteadyCrowdIsAsItWas) {
    expect_alike_after_thirty_days(figures::by_opengl(), by_opengl);
}

TEST_F(MovedGl, PicturesShowPeople) {
    expect_people_in_pictures(figures::by_opengl(), by_opengl);
}

}  // namespace
