// What people are expected to lose never gets better by drawing them coarser.
#include "figures/expected_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "figures/way.h"

namespace {

using figures::ExpectedError;

class ExpectedErrorOf : public testing::TestWithParam<const figures::Way*> {
protected:
    const ExpectedError& error() const { return GetParam()->error; }
};

INSTANTIATE_TEST_SUITE_P(Ways, ExpectedErrorOf, testing::Values(&figures::by_opengl(), &figures::natively()),
                         [](const auto& way) { return std::string(sfsm::name_of(way.param->drawing)); });

constexpr double finer = 1.07;  // a tenth of an octave

TEST_P(ExpectedErrorOf, GrowsWithThePointsSpacing) {
    for (const double cell : {1.0, 1.68, 2.4, 3.36, 8.0})
        for (double spacing = 0.01; spacing < 100; spacing *= finer)
            EXPECT_LE(error().of_points(spacing, cell), error().of_points(spacing * finer, cell))
                << spacing << " in " << cell;
}

// Where cells have a point and a half, hardly any is empty, and larger ones only blur.
TEST_P(ExpectedErrorOf, GrowsWithCellsBeyondHoles) {
    for (double spacing = 0.1; spacing < 8; spacing *= finer)
        for (double cell = std::max(1.0, 1.25 * spacing); cell < 16; cell *= finer)
            EXPECT_LE(error().of_points(spacing, cell), error().of_points(spacing, cell * finer) + 1e-12)
                << spacing << " in " << cell;
}

TEST_P(ExpectedErrorOf, OfTrianglesFallsAndOfSplatsGrowsWithHeight) {
    for (double height = 0.1; height < 4000; height *= finer) {
        EXPECT_GE(error().of_mesh(height), error().of_mesh(height * finer)) << height;
        EXPECT_LE(error().of_splat(height), error().of_splat(height * finer)) << height;
    }
    for (double cell = 1; cell < 16; cell *= finer)
        EXPECT_LE(error().times_in_cells(cell), error().times_in_cells(cell * finer)) << cell;
}

TEST_P(ExpectedErrorOf, GrowsWithMotionFromNone) {
    EXPECT_EQ(error().of_motion(0), 0);
    for (double off = 0.01; off < 100; off *= finer)
        EXPECT_LE(error().of_motion(off), error().of_motion(off * finer)) << off;
}

// FLIP is at most 1; of what is expected only the growth with spacing has no end.
TEST_P(ExpectedErrorOf, IsFiniteAndNotBelowNothingForWhatIsExtreme) {
    for (const double extreme : {1e-30, 1e-3, 1.0, 1e3, 1e30}) {
        for (const double cell : {1.0, 1e3}) {
            EXPECT_TRUE(std::isfinite(error().of_points(extreme, cell))) << extreme;
            EXPECT_GE(error().of_points(extreme, cell), 0) << extreme;
        }
        for (const double value : {error().of_mesh(extreme), error().of_splat(extreme), error().of_motion(extreme)}) {
            EXPECT_GE(value, 0) << extreme;
            EXPECT_LE(value, 1) << extreme;
        }
    }
}

TEST_P(ExpectedErrorOf, PointsErrorsAreThoseOfPoints) {
    constexpr double tolerance = 0.05;  // half an eighth of an octave, of what grows at most as the spacing does
    for (const double cell : {1.0, 1.68, 3.36}) {
        const figures::PointsErrors errors(error(), cell);
        for (double spacing = 0.07; spacing < 200; spacing *= finer) {
            const double exact = error().of_points(spacing, cell);
            EXPECT_NEAR(errors.at(static_cast<float>(spacing)), exact, tolerance * exact) << spacing << " in " << cell;
        }
        EXPECT_EQ(errors.at(1e-6f), errors.at(0.0626f));  // beyond: the nearest that is kept
        EXPECT_EQ(errors.at(1e6f), errors.at(255.0f));
    }
}

}  // namespace
