// How much of people shows who stand close together, against a raster of all of them.
#include "render/crowding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using render::Crowding;

// Bodies as a crowd's silhouettes have them: 0.3 as wide as high.
constexpr float breadth = 0.3f;

float silhouette(float height) {
    return breadth * height * height;
}

// Rows of a stand, each higher than the one before.
std::vector<glm::vec3> stand(int rows, int seats, float apart, float rise, float scale = 1) {
    std::vector<glm::vec3> middles;
    for (int row = 0; row < rows; ++row)
        for (int seat = 0; seat < seats; ++seat)
            middles.push_back(scale * glm::vec3(apart * static_cast<float>(seat), rise * static_cast<float>(row),
                                                -0.8f * static_cast<float>(row)));
    return middles;
}

// Seen from far away in that direction.
float share_of(const std::vector<glm::vec3>& middles, float height, glm::vec3 direction, glm::vec3 origin = {}) {
    constexpr float far = 1e6f;
    Crowding crowding;
    for (const glm::vec3& middle : middles) crowding.add(middle + origin, height);
    return crowding.visible_share(far * direction, silhouette(height));
}

// Upright rectangles that face the eye, which is infinitely far away, in a raster of a hundredth of a metre: all that
// shows over all that there is.
double drawn_share(const std::vector<glm::vec3>& middles, float height, glm::vec3 direction) {
    constexpr int side = 4096;
    constexpr float cell = 0.01f;  // [m]
    const glm::vec3 ahead = glm::normalize(direction);
    const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0))), up = glm::cross(right, ahead);
    std::vector<bool> full(std::size_t{side} * side);
    const int wide = static_cast<int>(breadth * height / cell), high = static_cast<int>(height / cell);
    double shown = 0;
    for (const glm::vec3& middle : middles) {
        const int x0 = side / 2 + static_cast<int>(std::floor(glm::dot(right, middle) / cell));
        const int y0 = side / 2 + static_cast<int>(std::floor(glm::dot(up, middle) / cell));
        for (int y = y0; y < y0 + high; ++y)
            for (int x = x0; x < x0 + wide; ++x) {
                std::vector<bool>::reference here = full[static_cast<std::size_t>(y) * side + x];
                shown += here ? 0 : 1;
                here = true;
            }
    }
    return shown / (static_cast<double>(wide) * high * static_cast<double>(middles.size()));
}

TEST(Crowding, LonePeopleShowWholly) {
    EXPECT_EQ(share_of({}, 1.7f, {0, 0, 1}), 1);
    EXPECT_EQ(share_of({{3, 4, 5}}, 1.7f, {0, 0, 1}), 1);
    constexpr float far_apart = 200;  // [m]
    for (const glm::vec3 direction : {glm::vec3(0, 0, 1), {0, 1, 0}, {1, 1, 1}})
        EXPECT_GT(share_of({{0, 0, 0}, {far_apart, far_apart, 0}, {0, far_apart, far_apart}, {far_apart, 0, far_apart}},
                           1.7f, direction),
                  0.99f);
}

// Aside, rows that stand behind one another are seen between each other: more shows than of people who are strewn.
TEST(Crowding, OfAStandAsMuchShowsAsARasterSays) {
    constexpr double tolerance = 0.15, aside_tolerance = 0.25;
    constexpr float height = 1.3f;  // [m] of people who sit
    const std::vector<glm::vec3> people = stand(12, 20, 0.5f, 0.4f);
    for (const glm::vec3 direction : {glm::vec3(0, 0, -1), {0, -0.5f, -1}, {0, -1, -1}, {0.5f, -0.3f, -1}}) {
        const double drawn = drawn_share(people, height, direction);
        EXPECT_NEAR(static_cast<double>(share_of(people, height, direction)), drawn,
                    (direction.x == 0 ? tolerance : aside_tolerance) * drawn)
            << direction.x << ' ' << direction.y << ' ' << direction.z;
    }
}

TEST(Crowding, LessShowsOfMoreInTheSamePlace) {
    const float few = share_of(stand(12, 10, 1.0f, 0.4f), 1.3f, {0, -0.3f, -1});
    const float many = share_of(stand(12, 20, 0.5f, 0.4f), 1.3f, {0, -0.3f, -1});
    EXPECT_LT(many, few);
}

// Who is near looks larger, and is before the others.
TEST(Crowding, MoreShowsFromNearby) {
    Crowding crowding;
    for (const glm::vec3& middle : stand(12, 20, 0.5f, 0.4f)) crowding.add(middle, 1.3f);
    float before = 1;
    for (const float distance : {2.0f, 5.0f, 10.0f, 30.0f, 100.0f}) {
        const float share =
            crowding.visible_share(glm::normalize(glm::vec3(0, -0.3f, -1)) * distance, silhouette(1.3f));
        EXPECT_LT(share, before) << distance;
        before = share;
    }
    EXPECT_NEAR(before, share_of(stand(12, 20, 0.5f, 0.4f), 1.3f, {0, -0.3f, -1}), 0.02f);
}

// Rows of which none stands right behind another, so that a picture from nearby differs by the perspective alone.
std::vector<glm::vec3> offset_rows(int rows, int seats, float apart, float rise, float deep) {
    constexpr float golden = 0.618034f;
    std::vector<glm::vec3> middles;
    for (int row = 0; row < rows; ++row)
        for (int seat = 0; seat < seats; ++seat)
            middles.emplace_back(apart * (static_cast<float>(seat) + std::fmod(golden * static_cast<float>(row), 1.0f)),
                                 rise * static_cast<float>(row), -deep * static_cast<float>(row));
    return middles;
}

glm::vec3 mean_of(const std::vector<glm::vec3>& middles) {
    glm::dvec3 sum(0);
    for (const glm::vec3& middle : middles) sum += middle;
    return glm::vec3(sum / static_cast<double>(middles.size()));
}

// As drawn_share, seen in perspective from an eye that looks at their mean.
double share_drawn_from(glm::vec3 eye, const std::vector<glm::vec3>& middles, float height) {
    constexpr int side = 2048;
    const glm::vec3 ahead = glm::normalize(mean_of(middles) - eye);
    const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0))), up = glm::cross(right, ahead);
    const auto on_screen = [&](const glm::vec3& at) {
        return glm::vec2(glm::dot(right, at - eye), glm::dot(up, at - eye)) / glm::dot(ahead, at - eye);
    };
    float widest = 0;
    for (const glm::vec3& middle : middles) {
        const glm::vec2 at = glm::abs(on_screen(middle)) + height / glm::dot(ahead, middle - eye);
        widest = std::max({widest, at.x, at.y});
    }
    const float pixels = 0.5f * side / widest;
    std::vector<bool> full(std::size_t{side} * side);
    double shown = 0, all = 0;
    for (const glm::vec3& middle : middles) {
        const glm::vec2 at = pixels * on_screen(middle) + 0.5f * side;
        const glm::vec2 half = 0.5f * pixels * height / glm::dot(ahead, middle - eye) * glm::vec2(breadth, 1);
        const glm::ivec2 low(at - half), high(at + half);
        all += static_cast<double>(high.x - low.x) * (high.y - low.y);
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x) {
                std::vector<bool>::reference here =
                    full[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
                shown += here ? 0 : 1;
                here = true;
            }
    }
    return shown / all;
}

// From as near as a block is deep, and farther: how much more shows than from far away.
TEST(Crowding, FromNearbyAsMuchMoreShowsAsARasterSays) {
    constexpr double tolerance = 0.06;
    constexpr float height = 1.3f, deep = 0.8f, rows = 30;  // [m], [m], 1
    for (const float rise : {0.0f, 0.1f, 0.2f}) {
        const std::vector<glm::vec3> people = offset_rows(static_cast<int>(rows), 20, 0.5f, rise, deep);
        const glm::vec3 mean = mean_of(people);
        Crowding crowding;
        for (const glm::vec3& middle : people) crowding.add(middle, height);
        for (const float down : {0.3f, 0.6f}) {
            const glm::vec3 ahead = glm::normalize(glm::vec3(0, -down, -1));
            const auto drawn = [&](float distance) {
                return share_drawn_from(mean - distance * ahead, people, height);
            };
            const auto said = [&](float distance) {
                return static_cast<double>(crowding.visible_share(distance * ahead, silhouette(height)));
            };
            constexpr float far = 3000;  // [m]
            const double drawn_far = drawn(far), said_far = said(far);
            for (const float depths : {1.0f, 1.5f, 2.0f}) {
                const float distance = depths * rows * deep;
                const double more = drawn(distance) / drawn_far;
                EXPECT_NEAR(said(distance) / said_far, more, tolerance * more)
                    << "rise " << rise << ", down " << down << ", " << distance << " m";
            }
        }
    }
}

// Upright boxes as wide and as deep, seen from infinitely far away: whether one of them is on the line through a point.
bool is_box_on(const glm::vec3& point, const glm::vec3& ahead, const std::vector<glm::vec3>& middles, float height) {
    const glm::vec3 half = 0.5f * height * glm::vec3(breadth, 1, breadth);
    return std::ranges::any_of(middles, [&](const glm::vec3& middle) {
        float from = -std::numeric_limits<float>::infinity(), to = std::numeric_limits<float>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const float a = (middle[axis] - half[axis] - point[axis]) / ahead[axis];
            const float b = (middle[axis] + half[axis] - point[axis]) / ahead[axis];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return from <= to;
    });
}

// All that shows of such boxes, over a quarter of all their surface.
double box_share(const std::vector<glm::vec3>& middles, float height, glm::vec3 direction) {
    constexpr float cell = 0.04f;  // [m]
    const glm::vec3 ahead = glm::normalize(direction);
    const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0))), up = glm::cross(right, ahead);
    glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& middle : middles) {
        const glm::vec2 at(glm::dot(right, middle), glm::dot(up, middle));
        low = glm::min(low, at - height);
        high = glm::max(high, at + height);
    }
    int full = 0;
    for (float y = low.y; y < high.y; y += cell)
        for (float x = low.x; x < high.x; x += cell) full += is_box_on(x * right + y * up, ahead, middles, height);
    const double surface = static_cast<double>((4 * breadth + 2 * breadth * breadth) * height * height);
    return full * static_cast<double>(cell * cell) / (surface / 4 * static_cast<double>(middles.size()));
}

// What is said of such boxes, in blocks of so many people, against what shows of all of them.
void expect_cover(const std::vector<glm::vec3>& middles, std::size_t people_a_block, glm::vec3 direction,
                  double tolerance) {
    constexpr float height = 1.3f, surface = (4 * breadth + 2 * breadth * breadth) * height * height, far = 1e6f;
    double said = 0;
    for (std::size_t first = 0; first < middles.size(); first += people_a_block) {
        Crowding crowding;
        for (std::size_t i = first; i < first + people_a_block; ++i) crowding.add(middles[i], height);
        const double share = static_cast<double>(crowding.visible_share(far * direction, surface / 4));
        said += share * static_cast<double>(people_a_block) / static_cast<double>(middles.size());
    }
    const double drawn = box_share(middles, height, direction);
    EXPECT_NEAR(said, drawn, tolerance * drawn)
        << "blocks of " << people_a_block << ", " << direction.x << ' ' << direction.y << ' ' << direction.z;
}

// However thin the row, a body has a depth, in which nobody else is.
TEST(Crowding, OfARowAsMuchShowsFromAboveAsBodiesCover) {
    constexpr double tolerance = 0.25;
    for (const glm::vec3 direction : {glm::vec3(0.01f, -1, -0.01f), {1, -1, 0.01f}})
        expect_cover(stand(1, 20, 0.5f, 0), 20, direction, tolerance);
}

// The next block hides as much as one's own rows do.
TEST(Crowding, OfBlocksOfAStandAsMuchShowsAsOfAllOfIt) {
    constexpr double tolerance = 0.1;
    for (const std::size_t rows : {2, 4, 12})
        for (const glm::vec3 direction : {glm::vec3(0.01f, -0.01f, -1), {0.01f, -0.3f, -1}, {0.01f, -1, -1}})
            expect_cover(stand(12, 20, 0.5f, 0.4f), 20 * rows, direction, tolerance);
}

TEST(Crowding, ScaleAndOriginDontMatter) {
    constexpr float tolerance = 1e-3f;  // floats of places a kilometre away
    const glm::vec3 direction(0.3f, -0.4f, -1);
    const float share = share_of(stand(12, 20, 0.5f, 0.4f), 1.3f, direction);
    EXPECT_NEAR(share_of(stand(12, 20, 0.5f, 0.4f, 10), 13.0f, direction), share, tolerance);
    EXPECT_NEAR(share_of(stand(12, 20, 0.5f, 0.4f), 1.3f, direction, {1000, -200, 500}), share, tolerance);
}

}  // namespace
