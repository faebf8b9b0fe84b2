// Every prefix of a progressive model is even, by an evaluator that knows nothing of how it is made.
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "pointsample/opening.h"
#include "pointsample/sample.h"
#include "tests/pointsample/evaluate.h"
#include "tests/pointsample/shapes.h"
#include "tests/pointsample/surfaces.h"

namespace {

using pointsample::Order;
using pointsample::PointModel;
using tests::Opposed;

PointModel sample(const model::Mesh& mesh, std::size_t count, Order order, std::uint64_t seed) {
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    return pointsample::sample(mesh, {&rest, 1}, {count, seed, order, false});
}

// What every prefix is to reach, in units of the densest packing's distance.
struct Bounds {
    double nearest_to_most = 0.69;  // least nearest-neighbour distance up to 0.6 of all points,
    double nearest_to_all = 0.675;  // and up to all, where candidates run out
    double mean_nearest = 0.78;
    double mean_nearest_of_few = 0.78;  // below 1,024 points
    double farthest = 0.90;             // covering radius: largest,
    double farthest_99 = 0.69;          // and of 99 % of the surface
    double farthest_99_of_few = 0.69;
    double patches = 0.17;  // chi squared over degrees of freedom of patches of 64 - 128 points, from 4,096 on
};

struct Subject {
    const char* name;
    model::Mesh (*make)();
    Bounds bounds;
};

// At few points a bumpy surface's distances are chords across its bumps, and points on an open edge cover half a disc.
// Points sit on open edges, so that patches there are fuller; the sides of a plate still see a little of each other.
constexpr Bounds closed{}, bumpy{.nearest_to_most = 0.685, .mean_nearest_of_few = 0.75},
    open{.farthest_99_of_few = 0.80, .patches = 0.23},
    plate{.nearest_to_most = 0.685, .nearest_to_all = 0.665, .farthest_99_of_few = 0.72, .patches = 0.30};

class EveryPrefix : public testing::TestWithParam<Subject> {};

TEST_P(EveryPrefix, IsEven) {
    constexpr std::size_t count = 10000, few = 1024, enough_for_patches = 4096;
    const model::Mesh mesh = GetParam().make();
    const Bounds& bounds = GetParam().bounds;
    const double area = tests::area_of(mesh);
    const tests::Sample spots = tests::dense(mesh, 100000);
    const tests::Patches patches(tests::dense(mesh, 262144), 6, false);
    // Of so few patches the figure scatters by 0.02 or so: the mean over the seeds is judged.
    const std::vector<std::uint64_t> seeds{1, 2, 3};
    std::map<std::size_t, double> chi2;
    for (const std::uint64_t seed : seeds) {
        const tests::Sample points = tests::sample_of(sample(mesh, count, Order::progressive, seed), mesh);
        for (const std::size_t n :
             {std::size_t{64}, std::size_t{256}, few, enough_for_patches, count * 6 / 10, count}) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(n) + " points");
            const tests::Spread spread = tests::spread(points, n, area, Opposed::doubled);
            EXPECT_GE(spread.min, n < count ? bounds.nearest_to_most : bounds.nearest_to_all);
            EXPECT_GE(spread.mean, n < few ? bounds.mean_nearest_of_few : bounds.mean_nearest);
            const tests::Cover cover = tests::cover(spots, points, n, area, Opposed::doubled);
            EXPECT_LE(cover.max, bounds.farthest);
            EXPECT_LE(cover.p99, n < few ? bounds.farthest_99_of_few : bounds.farthest_99);
            if (n >= enough_for_patches) chi2[n] += patches.chi2(points, n) / static_cast<double>(seeds.size());
        }
    }
    for (const auto& [n, mean] : chi2) EXPECT_LE(mean, bounds.patches) << n << " points";
}

INSTANTIATE_TEST_SUITE_P(PointModel, EveryPrefix,
                         testing::Values(Subject{"Sphere", tests::make_ball, closed},
                                         Subject{"Bumpy", tests::make_bumpy, bumpy},
                                         Subject{"CubeAndPlate", tests::make_cube_and_plate, plate},
                                         Subject{"HugeAmongTiny", tests::make_huge_among_tiny, open}),
                         [](const auto& subject) { return subject.param.name; });

// The evaluator itself tells what is known: random points on any surface have these figures.
TEST(Evaluator, KnowsRandomPoints) {
    const model::Mesh mesh = tests::make_bumpy();
    constexpr std::size_t count = 20000;
    const double area = tests::area_of(mesh);
    const tests::Sample random = tests::sample_of(sample(mesh, count, Order::uniform, 1), mesh);
    EXPECT_NEAR(tests::spread(random, count, area, Opposed::same).mean, 0.465, 0.01);  // 1 / 2 of sqrt(area / n)
    const tests::Patches patches(tests::dense(mesh, 262144), 8, false);
    EXPECT_NEAR(patches.chi2(random, count), 1.0, 0.25);  // three standard deviations of 255 degrees of freedom
}

TEST(Opening, StartsInTheMiddleAndNotAtTheCorners) {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        const PointModel model = sample(tests::make_plane(), 1000, Order::progressive, seed);
        EXPECT_LT(glm::distance(model.positions[0], glm::vec3(0.5f, 0.5f, 0)), 0.1f);
        for (std::size_t i = 0; i < 12; ++i)
            for (const glm::vec3 corner : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)})
                EXPECT_GT(glm::distance(model.positions[i], corner), 0.1f);
    }
}

// A start at the corners would give a square the lattice of its middle, its sides' middles and so on, whose holes are
// alike and are filled row by row: patches of 64 points would differ as much as random ones at some prefixes.
TEST(Opening, KeepsLatticesOffASquare) {
    const model::Mesh mesh = tests::make_plane();
    const tests::Patches few(tests::dense(mesh, 262144), 4, false), many(tests::dense(mesh, 262144), 6, false);
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        const tests::Sample points = tests::sample_of(sample(mesh, 10000, Order::progressive, seed), mesh);
        EXPECT_LT(few.chi2(points, 1024), 0.4);  // fifteen degrees of freedom: random is 1.0 +- 0.37
        EXPECT_LT(many.chi2(points, 4096), 0.25);
        EXPECT_LT(many.chi2(points, 10000), 0.25);
    }
}

TEST(EvenOrder, ReachesThreeQuartersOfTheDensestPacking) {
    constexpr std::size_t count = 10000;
    constexpr double reached = 0.76, farthest = 0.90;
    for (const auto make : {tests::make_ball, tests::make_bumpy, tests::make_cube_and_plate}) {
        const model::Mesh mesh = make();
        const PointModel model = sample(mesh, count, Order::even, 1);
        ASSERT_EQ(model.size(), count);
        const tests::Sample points = tests::sample_of(model, mesh);
        const double area = tests::area_of(mesh);
        EXPECT_GE(tests::spread(points, count, area, Opposed::doubled).min, reached);
        EXPECT_LE(tests::cover(tests::dense(mesh, 100000), points, count, area, Opposed::doubled).max, farthest);
        // Prefixes are those of an order over these points alone: less even, but far from random, which have 0.002.
        EXPECT_GE(tests::spread(points, count / 8, area, Opposed::doubled).min, 0.6);
    }
}

TEST(EvenOrder, FewPointsAreNoSpecialCase) {
    const model::Mesh mesh = tests::make_cube_and_plate();
    for (const std::size_t count : {1u, 2u, 3u, 17u}) EXPECT_EQ(sample(mesh, count, Order::even, 1).size(), count);
}

TEST(Spacing, IsTheDistanceToThePointsBefore) {
    const model::Mesh mesh = tests::make_ball();
    const PointModel model = sample(mesh, 3000, Order::progressive, 1);
    ASSERT_EQ(model.spacing.size(), model.size());
    EXPECT_EQ(model.spacing[0], std::numeric_limits<float>::infinity());
    const tests::Sample points = tests::sample_of(model, mesh);
    const auto distance = [&](std::size_t a, std::size_t b) {
        const bool opposed = glm::dot(points.normals[a], points.normals[b]) < -0.7;
        return glm::distance(points.positions[a], points.positions[b]) * (opposed ? 2 : 1);
    };
    // The order takes what is nearly the farthest, to keep the density level: a point may be farther from those before
    // it than the last one was, by two regions' 4 % of the square each, and the spacing never rises.
    constexpr double rounding = 1e-5, give = 0.04;
    for (std::size_t i = 1; i < model.size(); ++i) {
        ASSERT_LE(model.spacing[i], model.spacing[i - 1]);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < i; ++k) nearest = std::min(nearest, distance(i, k));
        const double spacing = static_cast<double>(model.spacing[i]);
        ASSERT_LE(spacing, nearest * (1 + rounding)) << i;
        if (i >= 2 * pointsample::opening_size) {  // before, the opening has brought points nearer than these
            ASSERT_GE(spacing, nearest * (1 - give)) << i;
        }
    }
}

TEST(Spacing, OfIndependentPointsIsWhatIsExpectedOfTheSurfaceThatIsSeen) {
    model::Mesh mesh = tests::make_ball();
    const std::size_t shown = mesh.triangle_count();
    for (std::size_t i = 0; i < 3 * shown; ++i) mesh.indices.push_back(mesh.indices[i]);  // and as much within, unseen
    const std::size_t vertices = mesh.vertex_count();
    for (std::size_t i = 3 * shown; i < mesh.indices.size(); ++i)
        mesh.indices[i] += static_cast<std::uint32_t>(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        mesh.positions.push_back(0.9f * mesh.positions[i]);
        mesh.normals.push_back(mesh.normals[i]);
    }
    tests::fill_looks(mesh);
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const PointModel model = pointsample::sample(mesh, {&rest, 1}, {2000, 1, Order::uniform, true});
    double said = 0, found = 0;
    for (std::size_t i = 200; i < model.size(); ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < i; ++k)
            nearest = std::min(nearest, static_cast<double>(glm::distance(model.positions[i], model.positions[k])));
        said += static_cast<double>(model.spacing[i]);
        found += nearest;
    }
    EXPECT_NEAR(said / found, 1, 0.06);  // five deviations of the mean of 1,800, each of half of itself
}

}  // namespace
