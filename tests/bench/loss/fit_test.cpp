// The fit finds what made-up pictures were made with; files and correlations are what they say.
#include "tests/bench/loss/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "figures/way.h"
#include "tests/bench/loss/least_squares.h"
#include "tests/bench/loss/report.h"

namespace {

using bench::loss::Measured;
using bench::loss::Motion;
using bench::loss::Picture;
using bench::loss::Sum;
using bench::loss::What;
using figures::ExpectedError;
using render::native::BackdropErrors;

constexpr double pixels = 1e6;

// The formulas once more, by what docs/measurements/loss.md says of them.
double made_up_flip(const Sum& sum, const ExpectedError& e) {
    const double cells_points = std::pow(sum.cell / sum.spacing, 2);
    const double coarse = std::sqrt(std::pow(sum.spacing, 2) + std::pow(e.blur * (sum.cell - 1), 2));
    switch (sum.what) {
        case What::mesh:
            return sum.shown * e.mesh / (1 + std::pow(sum.height / e.mesh_height, e.mesh_power));
        case What::points:
            return sum.shown *
                   (e.finest + e.growth * std::pow(coarse, e.power) + e.hole * std::exp(-e.filling * cells_points));
        default:
            return 0;
    }
}

Picture nobody(const std::string& view, double ground, double unrest, const BackdropErrors& errors) {
    const double flip = pixels * static_cast<double>(errors.all) + ground * static_cast<double>(errors.ground) +
                        unrest * static_cast<double>(errors.unrest);
    return {1000,
            view,
            true,
            sfsm::Drawing::native,
            "nobody",
            {{.what = What::all, .shown = pixels, .pixels = pixels, .flip = flip},
             {.what = What::ground, .shown = ground, .pixels = pixels, .flip = flip},
             {.what = What::unrest, .shown = unrest, .pixels = pixels, .flip = flip}}};
}

// One class of people in a picture of which they fill a half.
Picture picture_of(Sum sum, const std::string& view, const Picture& around, const ExpectedError& error) {
    sum.shown = sum.pixels = pixels / 2;
    sum.flip = made_up_flip(sum, error);
    const Sum background{
        .what = What::background, .shown = pixels / 2, .pixels = pixels / 2, .flip = around.of(What::all).flip / 2};
    const Sum frame{.what = What::frame, .shown = pixels, .pixels = pixels, .flip = sum.flip + background.flip};
    const std::string recipe =
        std::to_string(sum.spacing) + " in " + std::to_string(sum.cell) + " of " + std::to_string(sum.height);
    return {1000, view, true, sfsm::Drawing::native, recipe, {sum, background, frame}};
}

std::vector<Picture> made_up(const ExpectedError& error, const BackdropErrors& around) {
    std::vector<Picture> all = {nobody("a", 1e5, 1e3, around), nobody("b", 6e5, 4e3, around),
                                nobody("c", 3e5, 9e3, around)};
    for (const double cell : {1.0, 1.7, 2.4, 3.4})
        for (double spacing = 0.3; spacing < 5; spacing *= 1.3)
            all.push_back(
                picture_of({.what = What::points, .height = 20, .spacing = spacing, .cell = cell}, "a", all[0], error));
    for (double height = 2; height < 500; height *= 1.5)
        all.push_back(picture_of({.what = What::mesh, .height = height}, "b", all[1], error));
    return all;
}

TEST(FitLoss, FindsTheConstantsThatPicturesWereMadeWith) {
    constexpr double tolerance = 0.01;
    ExpectedError truth = figures::natively().error;
    truth.finest *= 1.3;
    truth.growth *= 0.8;
    truth.hole *= 1.5;
    truth.mesh *= 0.7;
    truth.mesh_height *= 1.6;
    const BackdropErrors around{0.002f, 0.01f, 1.2f};
    const std::vector<Picture> pictures = made_up(truth, around);
    const BackdropErrors found = bench::loss::fit_backdrop(pictures);
    EXPECT_NEAR(found.all, around.all, tolerance * static_cast<double>(around.all));
    EXPECT_NEAR(found.ground, around.ground, tolerance * static_cast<double>(around.ground));
    EXPECT_NEAR(found.unrest, around.unrest, tolerance * static_cast<double>(around.unrest));
    const Measured measured(pictures, sfsm::Drawing::native);
    const ExpectedError fitted = bench::loss::fit_people(measured, found, figures::natively().error, Motion::held);
    for (const double cell : {1.0, 2.0, 3.0})
        for (const double spacing : {0.4, 1.0, 3.0}) {
            const double wanted = truth.of_points(spacing, cell);
            EXPECT_NEAR(fitted.of_points(spacing, cell), wanted, tolerance * wanted) << spacing << " in " << cell;
        }
    for (const double height : {3.0, 30.0, 300.0})
        EXPECT_NEAR(fitted.of_mesh(height), truth.of_mesh(height), tolerance * truth.of_mesh(height)) << height;
}

// Of what is 0 there is no way of drawing that has it.
TEST(FitLoss, LeavesConstantsThatAreNothing) {
    ExpectedError start = figures::natively().error;
    start.hole = start.blur = 0;
    const BackdropErrors around;
    const std::vector<Picture> pictures = made_up(start, around);
    const ExpectedError fitted =
        bench::loss::fit_people(Measured(pictures, sfsm::Drawing::native), around, start, Motion::held);
    EXPECT_EQ(fitted.hole, 0);
    EXPECT_EQ(fitted.blur, 0);
}

TEST(FitLoss, ViewsWithoutAPictureOfNobodyAreNamed) {
    const std::vector<Picture> all = made_up(figures::natively().error, {});
    const std::vector<Picture> pictures(all.begin() + 1, all.end());
    try {
        const Measured measured(pictures, sfsm::Drawing::native);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()), "found no picture of nobody of 1000 in a, expected one a view");
    }
}

TEST(LeastSquares, FindsWhereResidualsVanish) {
    const auto found = bench::loss::least_squares({1, 1}, [](std::span<const double> at) {
        std::vector<double> off;
        for (const double x : {0.5, 1.0, 2.0, 4.0}) off.push_back(at[0] * std::pow(x, at[1]) - 3 * std::pow(x, 0.7));
        return off;
    });
    EXPECT_NEAR(found[0], 3, 1e-5);
    EXPECT_NEAR(found[1], 0.7, 1e-5);
}

TEST(RankCorrelation, IsThatOfRanks) {
    using bench::loss::rank_correlation;
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {10, 200, 3000, 3e9}), 1);
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {4, 3, 2, 1}), -1);
    // 1 - 6 (1 + 1 + 4 + 4) / (5 * 24)
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4, 5}, {2, 1, 5, 4, 3}), 0.5);
    EXPECT_DOUBLE_EQ(rank_correlation({1, 1, 2}, {5, 5, 9}), 1);
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2}, {7, 7}), 1);
}

TEST(LossFile, ReadsBackAsItWasWritten) {
    const std::vector<Picture> pictures = made_up(figures::natively().error, {});
    const std::string text = to_csv(pictures);
    const std::vector<Picture> read = bench::loss::from_csv(text, "loss.csv");
    EXPECT_EQ(to_csv(read), text);
    EXPECT_EQ(read.size(), pictures.size());
}

TEST(LossFile, SaysWhatIsWrongWhere) {
    const std::string text = to_csv(made_up(figures::natively().error, {}));
    const auto refuses = [](const std::string& wrong, const std::string& start) {
        try {
            bench::loss::from_csv(wrong, "loss.csv");
            ADD_FAILURE() << start;
        } catch (const std::runtime_error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("loss.csv:" + start)) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    };
    refuses("", "1: found no pictures");
    refuses("people,view\n", "1: found other columns");
    const std::size_t second = text.find('\n') + 1;
    refuses(text.substr(0, second) + "1000,a,1,native\n", "2: found '1000,a,1,native'");
    refuses(text.substr(0, second) + "x" + text.substr(second), "2: found 'x1000");
}

}  // namespace
