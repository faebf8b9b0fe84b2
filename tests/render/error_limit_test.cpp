// What is off in space, held against what that is on the screen.
#include "render/error_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "sfsm/random.h"

namespace {

using render::ErrorLimit;
using render::View;

constexpr double infinite = std::numeric_limits<double>::infinity();

View view_of(double fov, int width, int height) {
    return render::make_view({{0, 0, 0}, {0, 0, -1}, fov}, width, height);
}

// Numbers by chance, in [-1, 1].
struct Draws {
    std::uint64_t drawn = 0;
    double next() { return 2 * sfsm::unit(sfsm::stream(11, drawn++)) - 1; }
    glm::dvec3 direction() { return glm::normalize(glm::dvec3(next(), next(), next())); }
};

// Somebody who reaches so far from their middle at a depth, and is drawn so far off [m].
struct Case {
    float off, reach, depth;
};

// [px] The farthest that is found of spots in the picture, at the near side of somebody: from where they are drawn.
double farthest(const View& view, const Case& of) {
    constexpr int tries = 100'000;
    const double pixels = static_cast<double>(view.pixels_per_metre(1)), near = static_cast<double>(render::near_plane);
    const double depth = static_cast<double>(of.depth - of.reach);
    Draws draws;
    double most = 0;
    for (int i = 0; i < tries; ++i) {
        const glm::dvec2 corner(view.tan_half_x, view.tan_half_y);
        const glm::dvec2 at = i % 2 == 0 ? corner : glm::dvec2(draws.next(), draws.next()) * corner;
        const glm::dvec3 is(depth * at, depth), drawn = is + static_cast<double>(of.off) * draws.direction();
        if (depth >= near && drawn.z >= near)
            most = std::max(most, pixels * glm::distance(at, glm::dvec2(drawn) / drawn.z));
    }
    return most;
}

TEST(ErrorLimit, NothingInThePictureIsFartherOffThanItSays) {
    const Case cases[] = {{0.01f, 0, 10},  {0.01f, 1, 2}, {0.01f, 9, 10},   {0.5f, 1, 2},
                          {0.8f, 0.9f, 2}, {1, 1.5f, 30}, {0.05f, 0, 0.2f}, {5, 0, 6}};
    for (const View& view : {view_of(0.1, 640, 360), view_of(1, 640, 360), view_of(2.2, 300, 900), view_of(1, 4, 4)})
        for (const Case& of : cases) {
            const double says = ErrorLimit(view, infinite).pixels(of.off, of.reach, of.depth);
            const double found = farthest(view, of);
            constexpr double rounding = 1e-4;
            EXPECT_LE(found, says * (1 + rounding)) << of.off << " m, reach " << of.reach << ", depth " << of.depth;
            const bool is_small = of.off < 0.02f * (of.depth - of.reach);
            if (is_small) {
                EXPECT_GT(found, 0.95 * says) << of.off << " m, reach " << of.reach << ", depth " << of.depth;
            }
        }
}

TEST(ErrorLimit, LeavesWhatItAllowsAndNoMore) {
    for (const double most : {1e-3, 0.2, 5.0, 300.0})
        for (const float reach : {0.0f, 1.0f, 3.0f})
            for (const float depth : {0.1f, 0.9f, 3.05f, 4.0f, 50.0f, 2000.0f}) {
                const ErrorLimit limit(view_of(1, 640, 360), most);
                const double used = limit.pixels(limit.off(reach, depth), reach, depth);
                EXPECT_LE(used, most) << "reach " << reach << ", depth " << depth;
                EXPECT_GT(used, 0.99 * most) << "reach " << reach << ", depth " << depth;
            }
}

// Who may be at the near plane is left nothing, and hardly anything in metres.
TEST(ErrorLimit, LeavesAsMuchInOtherUnits) {
    const View view = view_of(1, 640, 360);
    const ErrorLimit limit(view, 2);
    for (const float unit : {0.01f, 1.0f, 20.0f})  // [m]
        for (const float depth : {0.3f, 1.2f, 40.0f}) {
            constexpr float reach = 1;  // [m]
            const auto scale = static_cast<double>(unit * view.pixels_per_metre(depth));
            const float metres = limit.off(reach, depth);
            const float found = unit * limit.off_of(reach / unit, scale);
            EXPECT_NEAR(found, depth > reach ? metres : 0, 1e-4f * metres) << unit << " m, depth " << depth;
        }
}

TEST(ErrorLimit, OfNoneIsEverything) {
    const ErrorLimit limit(view_of(1, 640, 360), infinite);
    EXPECT_FALSE(limit.is_set());
    EXPECT_EQ(limit.off(1, 10), std::numeric_limits<float>::infinity());
    EXPECT_TRUE(ErrorLimit(view_of(1, 640, 360), 1).is_set());
}

}  // namespace
