// The surface that is sampled: its poses, its stretch, its line, and the candidates along it.
#include "pointsample/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "motion/pose.h"
#include "pointsample/candidates.h"
#include "pointsample/posed_mesh.h"
#include "pointsample/surface_line.h"
#include "tests/motion/rig.h"
#include "tests/pointsample/shapes.h"
#include "tests/pointsample/surfaces.h"

namespace {

using pointsample::PosedMesh;
using pointsample::Surface;

double area_of(const PosedMesh& pose, const model::Mesh& mesh, std::size_t triangle) {
    const auto at = [&](std::size_t k) { return glm::dvec3(pose.positions[mesh.indices[3 * triangle + k]]); };
    return 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
}

// --- Poses

TEST(SpreadPoses, TakeTheClipsInTurnAtEvenTimesFromTheirStart) {
    const model::Character character = tests::make_rig(4, 3);
    const std::vector<int> clips{2, 0};
    for (const std::size_t count : {1u, 2u, 5u, 8u}) {
        const std::vector<PosedMesh> poses = pointsample::spread_poses(character, clips, count);
        ASSERT_EQ(poses.size(), count);
        for (std::size_t slot = 0; slot < clips.size(); ++slot) {
            const model::Clip& clip = character.clips[static_cast<std::size_t>(clips[slot])];
            const double of_this_clip = std::ceil(static_cast<double>(count) / 2);  // the most that any clip has
            for (std::size_t i = slot; i < count; i += 2) {
                const double share = static_cast<double>(i / 2) / of_this_clip;
                motion::Pose pose;
                PosedMesh expected;
                motion::evaluate(character, clip, share * clip.duration, pose);
                motion::skin(character.mesh, pose, expected.positions, expected.normals);
                EXPECT_EQ(poses[i].positions, expected.positions) << i << " of " << count;
                EXPECT_EQ(poses[i].normals, expected.normals);
            }
        }
    }
}

TEST(SpreadPoses, WithoutClipsAreTheRestPoseAlone) {
    const model::Character character = tests::make_rig(4, 3);
    const std::vector<PosedMesh> poses = pointsample::spread_poses(character, {}, 7);
    motion::Pose pose;
    PosedMesh rest;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, rest.positions, rest.normals);
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ(poses[0].positions, rest.positions);
    EXPECT_EQ(poses[0].normals, rest.normals);
}

TEST(PosedMesh, FacesLookToTheSideOfTheirCornersNormals) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (const float side : {1.0f, -1.0f}) {
        const PosedMesh pose{mesh.positions, {{0, 0.9f, side}, {0.9f, 0, side}, {0, 0, -0.5f * side}}};
        EXPECT_EQ(pointsample::face_normal(mesh.indices, pose, 0), glm::vec3(0, 0, side));
        const pointsample::Place place = pointsample::place_of({0, 0.25f, 0.5f}, mesh.indices, pose);
        EXPECT_EQ(place.position, glm::vec3(0.25f, 0.5f, 0));
        EXPECT_EQ(place.normal, glm::vec3(0, 0, side));
    }
    const PosedMesh flat{std::vector<glm::vec3>(3, glm::vec3(1)), mesh.normals};
    EXPECT_EQ(pointsample::face_normal(mesh.indices, flat, 0), glm::vec3(0));
}

// --- Area and stretch

TEST(Surface, CountsATriangleWithTheLargestAreaOfAnyPose) {
    const model::Mesh mesh = tests::make_bumpy();
    for (const std::vector<float>& sizes : {std::vector<float>{1, 3, 0.5f}, {1, 0.5f, 2}, {2, 1, 1}}) {
        std::vector<PosedMesh> poses;
        for (const float size : sizes) {
            PosedMesh& pose = poses.emplace_back(PosedMesh{mesh.positions, mesh.normals});
            for (glm::vec3& p : pose.positions) p.x *= p.y > 0 ? size : 1.0f;
        }
        const Surface surface(mesh.indices, poses);
        double total = 0, first_total = 0;
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            const double first = area_of(poses[0], mesh, t);
            double largest = first;
            for (const PosedMesh& pose : poses) largest = std::max(largest, area_of(pose, mesh, t));
            ASSERT_NEAR(surface.first_area(t), first, 1e-9 * first);
            ASSERT_NEAR(surface.area(t), largest, 1e-6 * largest);
            ASSERT_GE(surface.stretch(t), 1.0f);
            total += largest;
            first_total += first;
        }
        EXPECT_NEAR(surface.total_area(), total, 1e-6 * total);
        EXPECT_NEAR(surface.total_first_area(), first_total, 1e-9 * first_total);
    }
}

TEST(Surface, NothingStretchesMoreThanAThousandTimes) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1e-6f, 0});
    tests::append(mesh, tests::make_triangle({0, 0, 0}, {0, 0, 1}, {0, 1, 0}));
    std::vector<PosedMesh> poses(2, {mesh.positions, mesh.normals});
    poses[1].positions[2].y = 1;
    const Surface surface(mesh.indices, poses);
    EXPECT_EQ(surface.stretch(0), 1024.0f);
    EXPECT_EQ(surface.stretch(1), 1.0f);
}

TEST(Surface, IsScaledToItsLongestSideAroundItsCentroid) {
    for (const glm::vec3& sides : {glm::vec3(2, 1, 1), glm::vec3(1, 3, 2), glm::vec3(1, 2, 8)}) {
        model::Mesh cube = tests::make_cube();
        for (glm::vec3& p : cube.positions) p = p * sides + glm::vec3(100, -50, 7);
        const PosedMesh pose{cube.positions, cube.normals};
        const Surface surface(cube.indices, {&pose, 1});
        EXPECT_EQ(surface.unit(), std::max({sides.x, sides.y, sides.z}));
        glm::vec3 sum(0);
        for (const glm::vec3& p : cube.positions) sum += surface.scaled(p);
        EXPECT_LT(glm::length(sum), 1e-4f);
        const float apart = glm::distance(surface.scaled(cube.positions[0]), surface.scaled(cube.positions[2]));
        EXPECT_NEAR(apart, glm::distance(cube.positions[0], cube.positions[2]) / surface.unit(), 1e-5);
    }
}

// --- The line

TEST(SurfaceLine, HasEveryTriangleWithAnAreaOnce) {
    model::Mesh mesh = tests::make_bumpy();
    tests::append(mesh, tests::make_triangle({0, 0, 0}, {0, 0, 0}, {1, 1, 1}));
    const PosedMesh pose{mesh.positions, mesh.normals};
    const Surface surface(mesh.indices, {&pose, 1});
    const std::vector<std::uint32_t> line = pointsample::order_along_line(surface);
    EXPECT_EQ(line.size(), mesh.triangle_count() - 1);
    EXPECT_EQ(std::set<std::uint32_t>(line.begin(), line.end()).size(), line.size());
    EXPECT_FALSE(std::count(line.begin(), line.end(), mesh.triangle_count() - 1));
}

// Runs of a Hilbert curve are patches: a quarter of a sphere's triangles has a box far smaller than the sphere's, an
// eightieth one of a few triangles' size. Rows of a grid, or two sorted axes of three, would be bands around it.
TEST(SurfaceLine, RunsAreCompactAtEveryScale) {
    const model::Mesh mesh = tests::make_sphere(1, 5);
    const PosedMesh pose{mesh.positions, mesh.normals};
    const Surface surface(mesh.indices, {&pose, 1});
    const std::vector<std::uint32_t> line = pointsample::order_along_line(surface);
    for (const std::size_t run : {8u, 32u, 128u, 512u}) {
        double sum = 0;
        std::size_t runs = 0;
        for (std::size_t first = 0; first + run <= line.size(); first += run, ++runs) {
            motion::Bounds box{glm::vec3(9), glm::vec3(-9)};
            for (std::size_t i = first; i < first + run; ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::vec3 p = mesh.positions[mesh.indices[3 * line[i] + k]];
                    box = {glm::min(box.min, p), glm::max(box.max, p)};
                }
            sum += static_cast<double>(glm::length(box.size()));
        }
        // A disc of the same area has this diameter; a run's box is longer by its corners and by its patch's shape.
        const double disc = 2 * std::sqrt(static_cast<double>(run) / static_cast<double>(line.size()) * 4);
        EXPECT_LT(sum / static_cast<double>(runs), 2.2 * disc) << run;
    }
}

double area_of(const pointsample::Cell& cell) {
    const glm::dvec2 a(cell.to - cell.from), b(cell.apex - cell.from);
    return 0.5 * std::abs(a.x * b.y - a.y * b.x);
}

TEST(SurfaceLine, CellsOfATriangleAreEqualAndFollowEachOther) {
    tests::Random random(6);
    for (int i = 0; i < 20; ++i) {
        const glm::vec3 a = random.vector(-1, 1), b = random.vector(-1, 1), c = random.vector(-1, 1);
        for (const int halvings : {0, 1, 2, 5, 8}) {
            const int count = 1 << halvings;
            glm::dvec2 centroid(0);
            pointsample::Cell before{};
            for (int k = 0; k < count; ++k) {
                const pointsample::Cell cell = pointsample::cell_along(a, b, c, (k + 0.5) / count, halvings);
                ASSERT_NEAR(area_of(cell), 0.5 / count, 1e-6);
                if (k > 0) {
                    ASSERT_EQ(cell.from, before.to) << k;
                }
                for (const glm::vec2& corner : {cell.from, cell.to, cell.apex}) {
                    ASSERT_GE(std::min(corner.x, corner.y), 0.0f);
                    ASSERT_LE(corner.x + corner.y, 1.0f);
                    centroid += glm::dvec2(corner) / (3.0 * count);
                }
                before = cell;
            }
            // Equal cells that are none of them the same make up the whole.
            ASSERT_LT(glm::distance(centroid, glm::dvec2(1.0 / 3)), 1e-6);
        }
        // From one end of the longest edge to the other.
        const auto whole = pointsample::cell_along(a, b, c, 0, 0);
        const auto place = [&](const glm::vec2& uv) { return a + uv.x * (b - a) + uv.y * (c - a); };
        const float longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        EXPECT_NEAR(glm::distance(place(whole.from), place(whole.to)), longest, 1e-6f);
    }
}

// --- Candidates along it

pointsample::Candidates candidates_of(const Surface& surface, std::size_t count, std::uint64_t seed,
                                      std::size_t batch) {
    const std::vector<std::uint32_t> line = pointsample::order_along_line(surface);
    pointsample::Stratifier stratifier(surface, line, count, seed);
    pointsample::Candidates candidates;
    while (stratifier.left() > 0) stratifier.append(batch, candidates);
    candidates.pad();
    return candidates;
}

std::vector<PosedMesh> half_stretched(const model::Mesh& mesh) {
    std::vector<PosedMesh> poses(2, {mesh.positions, mesh.normals});
    for (glm::vec3& p : poses[1].positions)
        if (p.y > 0) p.y *= 4;
    return poses;
}

TEST(Stratifier, EveryTriangleHasItsShareOfCandidatesToOne) {
    const model::Mesh mesh = tests::make_bumpy();
    const std::vector<PosedMesh> poses = half_stretched(mesh);
    const Surface surface(mesh.indices, poses);
    for (const std::size_t count : {1000u, 5000u, 100000u}) {
        const pointsample::Candidates candidates = candidates_of(surface, count, 1, 777);
        ASSERT_EQ(candidates.count, count);
        std::vector<double> found(mesh.triangle_count());
        for (std::size_t i = 0; i < count; ++i) ++found[candidates.surface[i].triangle];
        for (std::size_t t = 0; t < found.size(); ++t)
            ASSERT_LT(std::abs(found[t] - static_cast<double>(count) * surface.area(t) / surface.total_area()), 2) << t;
    }
}

TEST(Stratifier, CandidatesAreWhereTheirPlaceOnTheSurfaceIs) {
    const model::Mesh mesh = tests::make_bumpy();
    const std::vector<PosedMesh> poses = half_stretched(mesh);
    const Surface surface(mesh.indices, poses);
    const pointsample::Candidates candidates = candidates_of(surface, 5000, 2, 5000);
    for (std::size_t i = 0; i < candidates.count; ++i) {
        const motion::SurfacePoint& point = candidates.surface[i];
        ASSERT_GE(std::min(point.u, point.v), 0.0f);
        ASSERT_LE(point.u + point.v, 1.0f);
        const pointsample::Place expected = pointsample::place_of(point, mesh.indices, poses[0]);
        ASSERT_LT(glm::distance(candidates.place(i).position, surface.scaled(expected.position)), 1e-6f);
        ASSERT_EQ(candidates.place(i).normal, expected.normal);
        ASSERT_EQ(candidates.stretch(i), surface.stretch(point.triangle));
    }
}

TEST(Stratifier, BatchesMakeNoDifferenceAndSeedsDo) {
    const model::Mesh mesh = tests::make_sphere(1, 2);
    const PosedMesh pose{mesh.positions, mesh.normals};
    const Surface surface(mesh.indices, {&pose, 1});
    const auto places = [&](std::uint64_t seed, std::size_t batch) {
        const pointsample::Candidates candidates = candidates_of(surface, 3000, seed, batch);
        std::vector<glm::vec3> positions;
        for (std::size_t i = 0; i < candidates.count; ++i) positions.push_back(candidates.place(i).position);
        return positions;
    };
    EXPECT_EQ(places(1, 3000), places(1, 17));
    const std::vector<glm::vec3> one = places(1, 3000), other = places(2, 3000);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NE(one[i], other[i]);
}

// The mean of a corner's share, of its square, and how often it is below a tenth, are known.
void expect_uniform_in_triangles(int levels, std::size_t candidates, std::uint64_t seeds) {
    const model::Mesh mesh = tests::make_sphere(1, levels);
    const PosedMesh pose{mesh.positions, mesh.normals};
    const Surface surface(mesh.indices, {&pose, 1});
    double near[3]{}, mean[3]{}, mean_square[3]{};
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const pointsample::Candidates all = candidates_of(surface, candidates, seed, candidates);
        const double weight = 1.0 / static_cast<double>(candidates * seeds);
        for (std::size_t i = 0; i < all.count; ++i) {
            const double u = static_cast<double>(all.surface[i].u), v = static_cast<double>(all.surface[i].v);
            const double shares[3] = {1 - u - v, u, v};
            for (int k = 0; k < 3; ++k) {
                near[k] += shares[k] < 0.1 ? weight : 0;
                mean[k] += shares[k] * weight;
                mean_square[k] += shares[k] * shares[k] * weight;
            }
        }
    }
    // Five standard deviations of forty thousand independent points; these are more even.
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(near[k], 1 - 0.9 * 0.9, 0.01) << levels;
        EXPECT_NEAR(mean[k], 1.0 / 3, 0.006) << levels;
        EXPECT_NEAR(mean_square[k], 1.0 / 6, 0.005) << levels;
    }
}

TEST(Stratifier, PlacesInLargeTrianglesAndInTinyOnesAreUniform) {
    expect_uniform_in_triangles(0, 40'000, 1);
    expect_uniform_in_triangles(2, 40'000, 1);
    expect_uniform_in_triangles(5, 700, 57);  // a dozen triangles to a candidate
}

TEST(Stratifier, ThePlaceInATriangleIsIndependentOfWhichItIs) {
    const model::Mesh mesh = tests::make_sphere(1, 0);  // eight equal triangles, of which one is drawn
    const PosedMesh pose{mesh.positions, mesh.normals};
    const Surface surface(mesh.indices, {&pose, 1});
    constexpr double few = 500, five_deviations = 5 * 0.236;  // of a corner's share
    std::vector<glm::dvec3> sums(mesh.triangle_count(), glm::dvec3(0));
    std::vector<double> counts(mesh.triangle_count());
    for (std::uint64_t seed = 1; seed <= 6000; ++seed) {
        const motion::SurfacePoint point = candidates_of(surface, 1, seed, 1).surface[0];
        const double u = static_cast<double>(point.u), v = static_cast<double>(point.v);
        sums[point.triangle] += glm::dvec3(1 - u - v, u, v);
        ++counts[point.triangle];
    }
    int told = 0;
    for (std::size_t t = 0; t < counts.size(); ++t) {
        if (counts[t] < few) continue;  // a candidate stays near the middle of its part of the line
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(sums[t][k] / counts[t], 1.0 / 3, five_deviations / std::sqrt(counts[t]));
        ++told;
    }
    EXPECT_GE(told, 3);
}

}  // namespace
