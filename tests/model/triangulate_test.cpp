// Polygons of every shape as triangles.
#include "model/io/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using Polygon = std::vector<glm::dvec3>;

Polygon flat(const std::vector<glm::dvec2>& corners) {
    Polygon polygon;
    for (const glm::dvec2& corner : corners) polygon.emplace_back(corner, 0.0);
    return polygon;
}

glm::dvec3 twice_area(const Polygon& polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return sum;
}

// The triangles cover the area and nothing twice: each turns as the polygon does, and their areas sum up to its.
void expect_covered(const Polygon& polygon, const std::string& what) {
    model::Triangulator triangulator;
    const auto triangles = triangulator.cut(polygon);
    ASSERT_EQ(triangles.size(), polygon.size() - 2) << what;
    const glm::dvec3 whole = twice_area(polygon);
    const double size = glm::length(whole);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
        const glm::dvec3 normal = glm::cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
        EXPECT_GE(glm::dot(normal, whole), -1e-12 * size * size) << what;
        sum += glm::length(normal);
    }
    EXPECT_NEAR(sum, size, 1e-9 * size) << what;
}

// Begun at each of its corners, seen from both sides, and turned in space.
void expect_covered_however(const Polygon& polygon, const std::string& what) {
    for (std::size_t start = 0; start < polygon.size(); ++start) {
        Polygon turned;
        for (std::size_t i = 0; i < polygon.size(); ++i) turned.push_back(polygon[(start + i) % polygon.size()]);
        const std::string where = what + " from corner " + std::to_string(start);
        expect_covered(turned, where);
        expect_covered({turned.rbegin(), turned.rend()}, where + ", from behind");
        for (glm::dvec3& p : turned) p = {p.z + 0.25 * p.x, p.x, p.y};
        expect_covered(turned, where + ", tilted");
    }
}

TEST(Triangulator, CoversConcavePolygonsAndBridgedHoles) {
    const std::pair<const char*, std::vector<glm::dvec2>> shapes[] = {
        {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
        {"arrow", {{-1, 0}, {0, 0.5}, {1, 0}, {0, 2}}},
        {"L", {{2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}}},
        {"comb",
         {{0, 0},
          {7, 0},
          {7, 3},
          {6, 3},
          {6, 1},
          {5, 1},
          {5, 3},
          {4, 3},
          {4, 1},
          {3, 1},
          {3, 3},
          {2, 3},
          {2, 1},
          {1, 1},
          {1, 3},
          {0, 3}}},
        {"star",
         {{0, 3},
          {-0.7, 0.9},
          {-2.9, 0.9},
          {-1.1, -0.4},
          {-1.8, -2.4},
          {0, -1.2},
          {1.8, -2.4},
          {1.1, -0.4},
          {2.9, 0.9},
          {0.7, 0.9}}},
        {"corners in a row", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {1, 1}, {0.5, 0.5}, {0, 3}}},
        {"one corner twice", {{0, 0}, {3, 0}, {3, 0}, {3, 3}, {1, 1}, {1, 1}, {0, 3}}},
        {"spike", {{0, 0}, {2, 0}, {2, 1}, {5, 1}, {2, 1}, {2, 2}, {0, 2}}},
        {"a hole", {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}},
        {"two holes",
         {{0, 0},
          {9, 0},
          {9, 4},
          {0, 4},
          {0, 0},
          {1, 1},
          {1, 3},
          {3, 3},
          {3, 1},
          {5, 1},
          {5, 3},
          {7, 3},
          {7, 1},
          {5, 1},
          {3, 1},
          {1, 1}}},
        {"two holes, one bridge each",
         {{0, 0},
          {9, 0},
          {9, 4},
          {8, 3},
          {8, 1},
          {6, 1},
          {6, 3},
          {8, 3},
          {9, 4},
          {0, 4},
          {0, 0},
          {1, 1},
          {1, 3},
          {3, 3},
          {3, 1},
          {1, 1}}},
        {"spiral",
         {{0, 0},
          {6, 0},
          {6, 6},
          {0, 6},
          {0, 2},
          {4, 2},
          {4, 4},
          {2, 4},
          {2, 3},
          {3, 3},
          {3, 3.5},
          {3.5, 3.5},
          {3.5, 2.5},
          {1, 2.5},
          {1, 5},
          {5, 5},
          {5, 1},
          {0, 1}}}};
    for (const auto& [name, corners] : shapes) expect_covered_however(flat(corners), name);
}

// Random outlines about a point, cut by random radii: as bad as they get without crossing themselves.
TEST(Triangulator, CoversRandomOutlines) {
    std::mt19937_64 random(9);
    for (int trial = 0; trial < 300; ++trial) {
        const std::size_t count = 5 + random() % 60;
        Polygon polygon;
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(count);
            const double radius = 0.05 + static_cast<double>(random() % 1000) / 1000;
            polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        }
        expect_covered(polygon, "trial " + std::to_string(trial));
    }
}

TEST(Triangulator, AlwaysEnds) {
    std::mt19937_64 random(10);
    model::Triangulator triangulator;
    for (int trial = 0; trial < 300; ++trial) {
        Polygon polygon(3 + random() % 40);
        for (glm::dvec3& corner : polygon)
            corner = {static_cast<double>(random() % 5), static_cast<double>(random() % 5),
                      trial % 3 ? 0.0 : static_cast<double>(random() % 3)};
        if (trial % 7 == 0) polygon[random() % polygon.size()].x = NAN;
        EXPECT_EQ(triangulator.cut(polygon).size(), polygon.size() - 2);
    }
    EXPECT_EQ(triangulator.cut(Polygon(7, glm::dvec3(1.0))).size(), 5u);
    EXPECT_TRUE(triangulator.cut(Polygon(2)).empty());
    EXPECT_TRUE(triangulator.cut({}).empty());
}

// In quadratic time the first would take a minute, and the second, which crosses itself at random, hours.
TEST(Triangulator, TakesHugePolygons) {
    Polygon comb;
    constexpr int teeth = 100'000;
    for (int i = 0; i < teeth; ++i) {
        comb.emplace_back(2 * i, 0, 0);
        comb.emplace_back(2 * i + 1, 5, 0);
    }
    comb.emplace_back(2 * teeth, -1, 0);
    comb.emplace_back(0, -1, 0);
    expect_covered({comb.rbegin(), comb.rend()}, "comb");
    std::mt19937_64 random(11);
    Polygon tangle(30'000);
    for (glm::dvec3& corner : tangle)
        corner = {static_cast<double>(random() % 10'000), static_cast<double>(random() % 10'000), 0};
    model::Triangulator triangulator;
    EXPECT_EQ(triangulator.cut(tangle).size(), tangle.size() - 2);
}

}  // namespace
