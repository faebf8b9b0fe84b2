// A place ten thousand kilometres away looks as it does at the world's origin, and after thirty days as it did before.
#include "tests/precision/moved.h"

#include <gtest/gtest.h>

#include "render/native/renderer.h"

namespace {

using namespace precision;

std::unique_ptr<render::Renderer> natively(const scene::Place& place) {
    return std::make_unique<render::native::Renderer>(place.structure, place.ground, place.light,
                                                      cast_of_one().figures(), width, height);
}

TEST(Moved, ByWholeMetresIsTheSameToTheByte) {
    expect_alike_elsewhere(even_way, figures::natively(), natively, 0);
}

TEST(Moved, ByAnyWayIsTheSameButForAFewPixels) {
    expect_alike_elsewhere(odd_way, figures::natively(), natively, few_pixels);
}

TEST(Moved, BlocksMayBeToldFromAnyOrigin) {
    expect_alike_from_everywhere(figures::natively(), natively);
}

TEST(Moved, AfterThirtyDaysASteadyCrowdIsAsItWas) {
    expect_alike_after_thirty_days(figures::natively(), natively);
}

TEST(Moved, PicturesShowPeople) {
    expect_people_in_pictures(figures::natively(), natively);
}

}  // namespace
