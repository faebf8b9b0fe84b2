#include "pointsample/uniform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/pointsample/shapes.h"
#include "tests/pointsample/surfaces.h"

namespace {

// Chi squared over degrees of freedom.
double chi2(const std::vector<double>& found, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        sum += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    return sum / static_cast<double>(found.size() - 1);
}

// Chi squared of counts that are to be equal.
double chi2_of_equal(const std::vector<double>& found, std::size_t count) {
    return chi2(found,
                std::vector<double>(found.size(), static_cast<double>(count) / static_cast<double>(found.size())));
}

// Five standard deviations.
double slack(std::size_t cells) {
    return 5 * std::sqrt(2.0 / static_cast<double>(cells - 1));
}

TEST(Uniform, TrianglesAreDrawnByTheirArea) {
    const model::Mesh mesh = tests::make_bumpy();
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const pointsample::Surface surface(mesh.indices, {&rest, 1});
    const pointsample::AliasTable table(surface);
    constexpr std::size_t count = 1000000;
    std::vector<double> found(mesh.triangle_count()), expected(mesh.triangle_count());
    for (std::size_t i = 0; i < count; ++i) ++found[table.draw(3, i).triangle];
    for (std::size_t t = 0; t < expected.size(); ++t)
        expected[t] = static_cast<double>(count) * surface.area(t) / surface.total_area();
    EXPECT_NEAR(chi2(found, expected), 1, slack(found.size()));
}

TEST(Uniform, PlacesInATriangleAreUniform) {
    const model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const pointsample::AliasTable table(pointsample::Surface(mesh.indices, {&rest, 1}));
    constexpr std::size_t count = 200000, steps = 8;
    std::vector<double> found(steps * steps);  // the triangle cut into 64 of equal area
    for (std::size_t i = 0; i < count; ++i) {
        const motion::SurfacePoint point = table.draw(5, i);
        ASSERT_GE(point.u, 0);
        ASSERT_GE(point.v, 0);
        ASSERT_LE(static_cast<double>(point.u) + static_cast<double>(point.v), 1.0);
        const double u = steps * static_cast<double>(point.u), v = steps * static_cast<double>(point.v);
        const double row = std::min(std::floor(v), steps - 1.0), column = std::min(std::floor(u), steps - 1.0 - row);
        const bool upper = u - column + v - row > 1 && column + row < steps - 1.0;
        // Row r has 2 (steps - r) - 1 triangles.
        ++found[static_cast<std::size_t>(row * (2 * steps - row) + 2 * column + (upper ? 1 : 0))];
    }
    EXPECT_NEAR(chi2_of_equal(found, count), 1, slack(found.size()));
}

TEST(Uniform, NeighboursInTheStreamAreIndependent) {
    const model::Mesh mesh = tests::make_cube();
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const pointsample::AliasTable table(pointsample::Surface(mesh.indices, {&rest, 1}));
    constexpr std::size_t count = 200000, triangles = 12;
    for (const std::size_t lag : {1u, 2u, 7u}) {
        std::vector<double> found(triangles * triangles);
        for (std::size_t i = 0; i < count; ++i)
            ++found[table.draw(1, i).triangle * triangles + table.draw(1, i + lag).triangle];
        EXPECT_NEAR(chi2_of_equal(found, count), 1, slack(found.size()));
    }
}

}  // namespace
