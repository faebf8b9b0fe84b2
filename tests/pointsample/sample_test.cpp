#include "pointsample/sample.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "pointsample/model_key.h"
#include "pointsample/point_model.h"
#include "pointsample/visibility.h"
#include "tests/pointsample/shapes.h"
#include "tests/pointsample/surfaces.h"

namespace {

using pointsample::PointModel;
using pointsample::SampleOptions;

PointModel sample(const model::Mesh& mesh, std::size_t count, bool visible_only = false, std::uint64_t seed = 1) {
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    return pointsample::sample(mesh, {&rest, 1}, {count, seed, pointsample::Order::progressive, visible_only});
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Independent uniform points on the unit sphere.
std::vector<glm::vec3> random_on_sphere(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 2 * unit() - 1, angle = 2 * std::numbers::pi * unit(), radius = std::sqrt(1 - z * z);
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return points;
}

// Mean distance of the first n points to their nearest among them.
double mean_nearest(const std::vector<glm::vec3>& points, std::size_t n) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        float nearest = std::numeric_limits<float>::max();
        for (std::size_t j = 0; j < n; ++j)
            if (j != i) nearest = std::min(nearest, glm::distance(points[i], points[j]));
        sum += nearest;
    }
    return sum / static_cast<double>(n);
}

// Distance to the nearest of the first n points from whichever of `probes` is farthest off.
double covering_radius(const std::vector<glm::vec3>& points, std::size_t n, const std::vector<glm::vec3>& probes) {
    float farthest = 0;
    for (const glm::vec3& probe : probes) {
        float nearest = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < n; ++i) nearest = std::min(nearest, glm::distance(probe, points[i]));
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

// Chi-squared per degree of freedom of the counts in 8 x 16 patches of equal area on the sphere; random points give 1.
double patch_chi_squared(const std::vector<glm::vec3>& points, std::size_t n) {
    constexpr int bands = 8, sectors = 16;
    std::vector<int> counts(bands * sectors);
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec3 p = glm::normalize(points[i]);
        const double turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5;
        const int band = std::min(bands - 1, static_cast<int>((p.z + 1) / 2 * bands));
        counts[static_cast<std::size_t>(band * sectors + std::min(sectors - 1, static_cast<int>(turn * sectors)))]++;
    }
    const double expected = static_cast<double>(n) / (bands * sectors);
    double sum = 0;
    for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum / (bands * sectors - 1);
}

TEST(Sampler, GivesExactlyTheCountAskedFor) {
    const model::Mesh sphere = tests::make_sphere(1, 3);
    for (const std::size_t count : {1u, 2u, 63u, 1024u, 1025u, 16384u, 40001u}) {
        for (const bool visible_only : {false, true}) {
            const PointModel model = sample(sphere, count, visible_only);
            EXPECT_EQ(model.size(), count);
            for (const std::size_t size : {model.surface.size(), model.normals.size(), model.colors.size(),
                                           model.slots.size(), model.joints.size(), model.weights.size()})
                EXPECT_EQ(size, count);
        }
    }
}

TEST(Sampler, AnyCountOfAnySurfaceInAnyOrder) {
    model::Mesh speck = tests::make_triangle({1000, 1000, 1000}, {1000.0001f, 1000, 1000}, {1000, 1000.0001f, 1000});
    model::Mesh twice = tests::make_cube();
    tests::append(twice, tests::make_cube());
    model::Mesh needle = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0.5f, 1e-12f, 0});
    for (const model::Mesh& mesh : {speck, twice, needle, tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}) {
        const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
        for (const auto order :
             {pointsample::Order::progressive, pointsample::Order::even, pointsample::Order::uniform}) {
            for (const std::size_t count : {1u, 2u, 3u, 64u, 3000u}) {
                const PointModel model = pointsample::sample(mesh, {&rest, 1}, {count, 1, order, false});
                ASSERT_EQ(model.size(), count);
                ASSERT_EQ(model.spacing.size(), count);
            }
        }
    }
}

TEST(Sampler, ASeedNamesOneSequenceOnAnyThreadCount) {
    model::Mesh nested = tests::make_sphere(1, 3);
    tests::append(nested, tests::make_sphere(0.5f, 2));
    const auto run = [&](std::size_t threads, std::uint64_t seed) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return sample(nested, 5000, true, seed);
    };
    const PointModel one = run(1, 7), four = run(4, 7), other = run(4, 8);
    EXPECT_TRUE(same_bits(one.positions, four.positions));
    EXPECT_TRUE(same_bits(one.normals, four.normals));
    EXPECT_TRUE(same_bits(one.colors, four.colors));
    EXPECT_EQ(one.hidden_removed, four.hidden_removed);
    EXPECT_FALSE(same_bits(one.positions, other.positions));
}

TEST(Sampler, AFewUniformPointsOfAVisibleSurfaceAreFound) {
    const model::Mesh sphere = tests::make_sphere(1, 4);
    const pointsample::PosedMesh rest{sphere.positions, sphere.normals};
    for (const std::size_t count : {1, 2, 64, 65, 5000})
        EXPECT_EQ(pointsample::sample(sphere, {&rest, 1}, {count, 1, pointsample::Order::uniform, true}).size(), count);
}

// FNV-1a.
template <typename T>
std::uint64_t hash_of(const std::vector<T>& values, std::uint64_t hash = 0xcbf29ce484222325u) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

// One expected value on every machine, compiler and optimisation level.
TEST(Sampler, PointsAreTheSameBitsEverywhere) {
    const model::Mesh sphere = tests::make_sphere(1, 4);
    const pointsample::PosedMesh rest{sphere.positions, sphere.normals};
    const auto hash = [&](pointsample::Order order) {
        const PointModel model = pointsample::sample(sphere, {&rest, 1}, {4096, 1, order, false});
        return hash_of(model.spacing, hash_of(model.positions));
    };
    // Another value is another version, or caches go on with the old points: raise pointsample::sampler_version.
    ASSERT_EQ(pointsample::sampler_version, 2);
    EXPECT_EQ(hash(pointsample::Order::progressive), 2783013530799898365u);
    EXPECT_EQ(hash(pointsample::Order::even), 3771030847086404277u);
    EXPECT_EQ(hash(pointsample::Order::uniform), 1386376832051472163u);
}

// The distance to the nearest point of a triangle (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto to_edge = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 edge = to - from;
        const double along = std::clamp(glm::dot(p - from, edge) / glm::dot(edge, edge), 0.0, 1.0);
        return glm::distance(p, from + along * edge);
    };
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(glm::dot(p - a, normal));
    return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

TEST(Sampler, PointsAreOnTheSurfaceToATenMillionth) {
    const model::Mesh sphere = tests::make_sphere(3, 3);
    const double diagonal = 6 * std::numbers::sqrt3, limit = 1e-7 * diagonal;
    const pointsample::PosedMesh rest{sphere.positions, sphere.normals};
    for (const pointsample::Order order :
         {pointsample::Order::progressive, pointsample::Order::even, pointsample::Order::uniform}) {
        const PointModel model = pointsample::sample(sphere, {&rest, 1}, {20000, 1, order, false});
        for (std::size_t i = 0; i < model.size(); ++i) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(sphere.positions[sphere.indices[3 * model.surface[i].triangle + k]]);
            };
            ASSERT_LE(distance_to_triangle(model.positions[i], corner(0), corner(1), corner(2)), limit);
        }
    }
}

TEST(Sampler, FlatFacesHaveExactNormals) {
    const model::Mesh cube = tests::make_cube();
    const PointModel model = sample(cube, 3000);
    for (std::size_t i = 0; i < model.size(); ++i)
        ASSERT_EQ(model.normals[i], cube.normals[cube.indices[std::size_t{3} * model.surface[i].triangle]]);
}

TEST(Sampler, PointsLieOnTheirTriangles) {
    const model::Mesh sphere = tests::make_sphere(2, 2);
    const PointModel model = sample(sphere, 5000);
    for (std::size_t i = 0; i < model.size(); ++i) {
        const std::uint32_t triangle = model.surface[i].triangle;
        const float u = model.surface[i].u, v = model.surface[i].v;
        ASSERT_LT(triangle, sphere.triangle_count());
        ASSERT_GE(u, 0.0f);
        ASSERT_GE(v, 0.0f);
        ASSERT_LE(u + v, 1.0f);
        const auto corner = [&](std::size_t k) {
            return glm::dvec3(sphere.positions[sphere.indices[3 * triangle + k]]);
        };
        const glm::dvec3 expected =
            corner(0) + (corner(1) - corner(0)) * double(u) + (corner(2) - corner(0)) * double(v);
        ASSERT_LT(glm::distance(glm::dvec3(model.positions[i]), expected), 1e-6);
        ASSERT_GT(glm::dot(model.normals[i], glm::normalize(model.positions[i])), 0.999f);
        ASSERT_NEAR(glm::length(model.normals[i]), 1.0f, 1e-6f);
    }
}

TEST(Sampler, AreaIsTheSurfaces) {
    EXPECT_FLOAT_EQ(sample(tests::make_cube(), 1).area, 6.0f);
    EXPECT_NEAR(sample(tests::make_sphere(2, 6), 1).area, 16 * std::numbers::pi, 0.02);  // the polyhedron's is less
}

TEST(Sampler, EqualAreasGetEqualCounts) {
    constexpr double random_is = 1.0, limit = 0.35;
    const model::Mesh sphere = tests::make_sphere(1, 6);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const PointModel model = sample(sphere, 16384, false, seed);
        for (const std::size_t n : {4096u, 6000u, 16384u}) EXPECT_LT(patch_chi_squared(model.positions, n), limit) << n;
    }
    // The measure itself tells random points from even ones.
    EXPECT_NEAR(patch_chi_squared(random_on_sphere(16384, 1), 16384), random_is, 0.4);
}

TEST(Sampler, FacesOfACubeShareEveryPrefix) {
    const PointModel model = sample(tests::make_cube(), 6000);
    std::vector<int> counts(6);
    for (std::size_t n = 0; n < model.size(); ++n) {
        ++counts[model.surface[n].triangle / 2];
        // An even sample's counts are off by what its rim has, sqrt(n / 6) * 4 points, half of them shared; random
        // points would be off by sqrt(n / 6) = 30 in the end as one standard deviation.
        const double due = static_cast<double>(n + 1) / 6;
        for (const int count : counts) ASSERT_NEAR(count, due, 3 + 0.5 * std::sqrt(due)) << n;
    }
}

TEST(Sampler, OneHugeTriangleAmongTinyOnesGetsItsShare) {
    const model::Mesh mesh = tests::make_huge_among_tiny();
    const PointModel model = sample(mesh, 4000);
    double on_huge = 0;
    for (std::size_t n = 0; n < model.size(); ++n) {
        on_huge += model.surface[n].triangle == mesh.triangle_count() - 1;
        // Points on open edges stand for half their disc, and the triangle has more of them than the square.
        const double due = static_cast<double>(n + 1) / 2;
        ASSERT_NEAR(on_huge, due, 3 + std::sqrt(due)) << n;
    }
}

TEST(Sampler, EveryPrefixIsMoreEvenThanRandom) {
    const PointModel model = sample(tests::make_sphere(1, 6), 2048);
    const std::vector<glm::vec3> probes = random_on_sphere(2000, 99);
    for (const std::size_t n : {64u, 100u, 256u, 500u, 1024u, 2048u}) {
        double random_nearest = 0, random_covering = 0;
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const std::vector<glm::vec3> random = random_on_sphere(n, seed);
            random_nearest += mean_nearest(random, n) / 3;
            random_covering += covering_radius(random, n, probes) / 3;
        }
        EXPECT_GT(mean_nearest(model.positions, n), 1.1 * random_nearest) << n;
        EXPECT_LT(covering_radius(model.positions, n, probes), 0.9 * random_covering) << n;
    }
}

TEST(Sampler, MomentsOfTheSphereAreItsClosedForms) {
    const PointModel model = sample(tests::make_sphere(1, 6), 10000);
    glm::dvec3 mean(0), square(0);
    for (const glm::vec3& p : model.positions) {
        mean += glm::dvec3(p) / 10000.0;
        square += glm::dvec3(p) * glm::dvec3(p) / 10000.0;
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(mean[axis], 0, 0.002);          // random: 0.0058 standard deviation
        EXPECT_NEAR(square[axis], 1.0 / 3, 0.002);  // random: 0.0030
    }
}

TEST(Sampler, MomentsOfTheSquareAreItsClosedForms) {
    model::Mesh square = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0});
    tests::append(square, tests::make_triangle({0, 0, 0}, {1, 1, 0}, {0, 1, 0}));
    constexpr std::size_t count = 10000;
    const PointModel model = sample(square, count);
    glm::dvec2 mean(0), square_mean(0);
    double product = 0;
    for (const glm::vec3& p : model.positions) {
        const glm::dvec2 at(p);
        mean += at / static_cast<double>(count);
        square_mean += at * at / static_cast<double>(count);
        product += at.x * at.y / static_cast<double>(count);
    }
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(mean[axis], 0.5, 0.0015);            // random: 0.0029 standard deviation
        EXPECT_NEAR(square_mean[axis], 1.0 / 3, 0.004);  // random: 0.0030; points on the rim stand for half a disc
    }
    EXPECT_NEAR(product, 0.25, 0.002);
}

TEST(Sampler, EveryCapOfTheSphereHasItsShare) {
    const PointModel model = sample(tests::make_sphere(1, 6), 8192);
    for (const glm::vec3& axis : random_on_sphere(20, 3))
        for (const float height : {-0.5f, 0.0f, 0.3f, 0.8f}) {
            const auto in_cap = [&](const glm::vec3& p) { return glm::dot(p, axis) > height; };
            const double found =
                static_cast<double>(std::count_if(model.positions.begin(), model.positions.end(), in_cap));
            EXPECT_NEAR(found, 8192 * (1 - height) / 2, 45);  // random: 45 is one standard deviation for the half
        }
}

TEST(Sampler, HiddenPointsAreReplaced) {
    model::Mesh nested = tests::make_sphere(1, 4);
    tests::append(nested, tests::make_sphere(0.5f, 3));
    const PointModel all = sample(nested, 5000, false), visible = sample(nested, 5000, true);
    const auto inside = [](const PointModel& model) {
        return std::count_if(model.positions.begin(), model.positions.end(),
                             [](const glm::vec3& p) { return glm::length(p) < 0.75f; });
    };
    EXPECT_NEAR(static_cast<double>(inside(all)), 1000, 20);  // a fifth of the area
    EXPECT_EQ(inside(visible), 0);
    EXPECT_EQ(visible.size(), 5000u);
    EXPECT_NEAR(static_cast<double>(visible.hidden_removed), 1250, 25);  // 5000 of 6250 candidates are visible
    EXPECT_EQ(all.hidden_removed, 0u);
}

TEST(Sampler, RefusesWhatNobodyCanSee) {
    model::Mesh turned = tests::make_sphere(1, 2);  // faces its own inside
    for (glm::vec3& normal : turned.normals) normal = -normal;
    EXPECT_THROW(sample(turned, 100, true), std::runtime_error);
    EXPECT_NO_THROW(sample(turned, 100, false));
    turned.materials[0].double_sided = true;
    EXPECT_NO_THROW(sample(turned, 100, true));
}

TEST(Sampler, TrianglesWithoutAnAreaGetNoPoints) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    model::Mesh mesh = tests::make_triangle({nan, 0, 0}, {1, 0, 0}, {0, 1, 0});
    tests::append(mesh, tests::make_triangle({infinity, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    tests::append(mesh, tests::make_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
    tests::append(mesh, tests::make_triangle({3, 3, 3}, {3, 3, 3}, {3, 3, 3}));
    EXPECT_THROW(sample(mesh, 10), std::runtime_error);
    EXPECT_THROW(sample(model::Mesh{}, 10), std::runtime_error);
    tests::append(mesh, tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    for (const bool visible_only : {false, true}) {
        const PointModel model = sample(mesh, 500, visible_only);
        EXPECT_EQ(model.size(), 500u);
        for (const motion::SurfacePoint& point : model.surface) ASSERT_EQ(point.triangle, 4u);
    }
}

TEST(Sampler, TinyAndHugeSurfacesWorkAlike) {
    for (const float size : {1e-15f, 1e15f}) {
        const model::Mesh sphere = tests::make_sphere(size, 3);
        const PointModel model = sample(sphere, 1000, true);
        EXPECT_EQ(model.hidden_removed, 0u);
        for (const glm::vec3& normal : model.normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-5f);
    }
}

TEST(Sampler, InfluencesAreTheCornersBlended) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.joints = {{1, 2, 0, 0}, {2, 3, 0, 0}, {4, 5, 6, 7}};
    mesh.weights = {{0.75f, 0.25f, 0, 0}, {0.5f, 0.5f, 0, 0}, {0.7f, 0.1f, 0.1f, 0.1f}};
    const PointModel model = sample(mesh, 300);
    for (std::size_t i = 0; i < model.size(); ++i) {
        const float u = model.surface[i].u, v = model.surface[i].v, w = 1 - u - v;
        std::vector<std::pair<float, int>> all{
            {0.75f * w, 1}, {0.25f * w + 0.5f * u, 2}, {0.5f * u, 3}, {0.7f * v, 4}, {0.1f * v, 5}, {0.1f * v, 6},
            {0.1f * v, 7}};
        std::stable_sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.first > b.first; });
        const float sum = all[0].first + all[1].first + all[2].first + all[3].first;
        for (int k = 0; k < 4; ++k)
            ASSERT_NEAR(model.weights[i][k], all[static_cast<std::size_t>(k)].first / sum, 1e-5f);
        ASSERT_EQ(model.joints[i][0], all[0].second);
    }
}

TEST(Sampler, SlotsAreTheNearestCorners) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.slots = {1, 2, 3};
    const PointModel model = sample(mesh, 300);
    for (std::size_t i = 0; i < model.size(); ++i) {
        const float u = model.surface[i].u, v = model.surface[i].v, w = 1 - u - v;
        const model::Slot expected = w > u && w > v ? mesh.slots[0] : u > v ? mesh.slots[1] : mesh.slots[2];
        ASSERT_EQ(model.slots[i], expected);
    }
}

TEST(Sampler, ColorsAreTextureTimesVertexInLinearLight) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.textures.push_back({2, 1, {{0, 10, 255, 255}, {255, 10, 0, 255}}});
    mesh.materials[0].texture = 0;
    const auto color_at = [&](float u) {
        mesh.uvs.assign(3, glm::vec2(u, 0.3f));
        return sample(mesh, 1).colors[0];
    };
    constexpr int half_light = 188;                            // sRGB's code for half of white's light
    EXPECT_EQ(color_at(0.25f), glm::u8vec4(0, 10, 255, 255));  // a texel's centre is the texel
    EXPECT_EQ(color_at(0.75f), glm::u8vec4(255, 10, 0, 255));
    EXPECT_EQ(color_at(0.5f), glm::u8vec4(half_light, 10, half_light, 255));
    EXPECT_EQ(color_at(0.0f), glm::u8vec4(half_light, 10, half_light, 255));  // wraps around
    EXPECT_EQ(color_at(-6.75f), glm::u8vec4(0, 10, 255, 255));
    EXPECT_EQ(color_at(7.75f), glm::u8vec4(255, 10, 0, 255));
    mesh.colors.assign(3, glm::u8vec4(half_light, 255, 255, 255));
    EXPECT_NEAR(color_at(0.75f).r, half_light, 1);
}

TEST(Sampler, TheLargestTextureCoordinatesStayInTheTexture) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.textures.push_back({3, 1, {{0, 10, 255, 255}, {255, 10, 0, 255}, {0, 10, 255, 255}}});
    mesh.materials[0].texture = 0;
    for (const float sign : {1.0f, -1.0f}) {
        mesh.uvs.assign(3, glm::vec2(sign * std::numeric_limits<float>::max()));
        for (const glm::u8vec4& color : sample(mesh, 2000).colors) ASSERT_EQ(color, glm::u8vec4(0, 10, 255, 255));
    }
}

TEST(Sampler, ProgressOnlyRisesAndEndsAtOne) {
    const model::Mesh sphere = tests::make_sphere(1, 2);
    double last = 0;
    const pointsample::PosedMesh rest{sphere.positions, sphere.normals};
    pointsample::sample(sphere, {&rest, 1}, {100000, 1, pointsample::Order::progressive, false}, [&](double fraction) {
        EXPECT_GT(fraction, last);
        last = fraction;
    });
    EXPECT_EQ(last, 1.0);
}

bool sees_outside(const pointsample::Visibility& visibility, const glm::vec3& point, const glm::vec3& normal,
                  bool two_sided) {
    const pointsample::Place place{point, normal};
    return visibility.look({&place, 1}, two_sided)[0] != 0;
}

TEST(Visibility, EndsAtAClosedSurface) {
    const model::Mesh sphere = tests::make_sphere(1, 3);
    const pointsample::Visibility visibility(sphere.positions, sphere.indices);
    for (const glm::vec3& direction : random_on_sphere(200, 5)) {
        EXPECT_FALSE(sees_outside(visibility, 0.9f * direction, direction, false));
        EXPECT_FALSE(sees_outside(visibility, glm::vec3(0), direction, true));
        EXPECT_TRUE(sees_outside(visibility, 1.1f * direction, direction, false));
        EXPECT_TRUE(sees_outside(visibility, 1.1f * direction, -direction, true));
    }
}

TEST(Visibility, FindsAHoleOfFivePercentOfTheSky) {
    model::Mesh cup = tests::make_sphere(1, 4);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < cup.indices.size(); i += 3) {
        const glm::vec3 center =
            (cup.positions[cup.indices[i]] + cup.positions[cup.indices[i + 1]] + cup.positions[cup.indices[i + 2]]) /
            3.0f;
        if (center.z < 0.9f) kept.insert(kept.end(), {cup.indices[i], cup.indices[i + 1], cup.indices[i + 2]});
    }
    const pointsample::Visibility visibility(cup.positions, kept);
    EXPECT_TRUE(sees_outside(visibility, {0, 0, 0}, {0, 0, 1}, false));
    EXPECT_TRUE(sees_outside(visibility, {0, 0, -0.99f}, {0, 0, 1}, false));
    EXPECT_FALSE(sees_outside(visibility, {0, 0, 0}, {0, 0, -1}, false));
    EXPECT_TRUE(sees_outside(visibility, {0, 0, 0}, {0, 0, -1}, true));
}

TEST(Visibility, NothingHidesNothing) {
    const pointsample::Visibility visibility({}, {});
    EXPECT_TRUE(sees_outside(visibility, {0, 0, 0}, {0, 0, 1}, false));
}

// What is hidden is told by the points before, but runs of these are short: ten thousand alike are all told right.
TEST(Visibility, ManyPointsAreToldAsOneByOne) {
    model::Mesh nested = tests::make_sphere(1, 3);
    tests::append(nested, tests::make_sphere(0.5f, 3));
    const pointsample::Visibility visibility(nested.positions, nested.indices);
    std::vector<pointsample::Place> places;
    for (const glm::vec3& direction : random_on_sphere(10000, 9))
        places.push_back({(places.size() % 3 == 0 ? 0.5f : 1.0f) * 1.01f * direction, direction});
    const std::vector<char> seen = visibility.look(places, false);
    for (std::size_t i = 0; i < places.size(); ++i) ASSERT_EQ(seen[i] != 0, i % 3 != 0) << i;
}

}  // namespace
