#include "scene/places/oval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

using scene::Oval;

constexpr float offsets[] = {-30.0f, -5.0f, 0.0f, 0.3f, 9.76f, 60.0f, 400.0f};  // [m]

// Where to look along an oval: both straights, both bends and the four places where they meet.
constexpr int samples = 997;

float arc_at(const Oval& oval, int i, float offset) {
    return oval.length(offset) * static_cast<float>(i) / samples;
}

TEST(Oval, MeasuresFourHundredMetresWhereTracksAreMeasured) {
    constexpr float measured_offset = 0.3f;  // [m] World Athletics: 30 cm from the kerb
    EXPECT_NEAR(Oval{}.length(measured_offset), 400.0f, 0.01f);
}

TEST(Oval, LengthIsTheIntegralOfItsPositions) {
    constexpr int steps = 20000;
    constexpr double tolerance = 1e-4;  // of the length: float positions, chords instead of arcs
    const Oval oval;
    for (const float offset : offsets) {
        double sum = 0;
        const float length = oval.length(offset);
        glm::vec2 previous = oval.position(0, offset);
        for (int i = 1; i <= steps; ++i) {
            const glm::vec2 next = oval.position(length * static_cast<float>(i) / steps, offset);
            sum += glm::distance(previous, next);
            previous = next;
        }
        EXPECT_NEAR(sum / length, 1.0, tolerance) << "at offset " << offset;
    }
}

TEST(Oval, OffsetOfInvertsPosition) {
    constexpr float tolerance = 1e-4f;  // [m] rounding of floats of some hundred metres
    const Oval oval;
    for (const float offset : offsets) {
        for (int i = 0; i < samples; ++i) {
            EXPECT_NEAR(oval.offset_of(oval.position(arc_at(oval, i, offset), offset)), offset, tolerance);
        }
    }
}

TEST(Oval, OutwardAndTangentAreUnitAndPerpendicular) {
    const Oval oval;
    for (int i = 0; i < samples; ++i) {
        const float arc = arc_at(oval, i, 5.0f);
        const glm::vec2 outward = oval.outward(arc, 5.0f), tangent = oval.tangent(arc, 5.0f);
        EXPECT_NEAR(glm::length(outward), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::length(tangent), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::dot(outward, tangent), 0.0f, 1e-6f);
    }
}

TEST(Oval, TangentPointsWhereArcGrows) {
    constexpr float step = 0.05f;  // [m]
    const Oval oval;
    for (int i = 0; i < samples; ++i) {
        const float arc = arc_at(oval, i, 5.0f) + step;
        const glm::vec2 moved = oval.position(arc + step, 5.0f) - oval.position(arc - step, 5.0f);
        EXPECT_GT(glm::dot(glm::normalize(moved), oval.tangent(arc, 5.0f)), 0.9999f);
    }
}

TEST(Oval, OutwardLeadsToTheParallel) {
    const Oval oval;
    for (int i = 0; i < samples; ++i) {
        const float arc = arc_at(oval, i, 0.0f);
        const glm::vec2 moved = oval.position(arc, 0.0f) + 12.0f * oval.outward(arc, 0.0f);
        EXPECT_NEAR(oval.offset_of(moved), 12.0f, 1e-4f);
    }
}

TEST(Oval, RunsCounterClockwiseSeenFromAbove) {
    // Seen from above with x to the right, z points down: the shoelace formula in (x, -z).
    const Oval oval;
    double area = 0;
    for (int i = 0; i < samples; ++i) {
        const glm::vec2 a = oval.position(arc_at(oval, i, 0), 0), b = oval.position(arc_at(oval, i + 1, 0), 0);
        area += 0.5 * (static_cast<double>(a.x) * -b.y + static_cast<double>(a.y) * b.x);
    }
    EXPECT_NEAR(area, 2.0 * 84.39 * 36.5 + M_PI * 36.5 * 36.5, 1.0);
}

TEST(Oval, BeginsWithTheStraightAtPositiveZ) {
    constexpr float tolerance = 1e-3f;  // [m]
    const Oval oval;
    for (const float offset : offsets) {
        const float side = oval.radius + offset, straight = 2 * oval.half_straight;
        const float half_lap = oval.length(offset) / 2, bend = half_lap - straight;
        const std::pair<float, glm::vec2> stations[] = {{0, {-oval.half_straight, side}},
                                                        {oval.half_straight, {0, side}},
                                                        {straight, {oval.half_straight, side}},
                                                        {straight + bend / 2, {oval.half_straight + side, 0}},
                                                        {half_lap, {oval.half_straight, -side}},
                                                        {half_lap + oval.half_straight, {0, -side}},
                                                        {half_lap + straight, {-oval.half_straight, -side}},
                                                        {2 * half_lap - bend / 2, {-oval.half_straight - side, 0}}};
        for (const auto& [arc, at] : stations) {
            EXPECT_LT(glm::distance(oval.position(arc, offset), at), tolerance) << arc << " at offset " << offset;
        }
    }
}

TEST(Oval, EveryMetreOfArcIsAMetreOfWay) {
    constexpr float step = 0.25f, tolerance = 2e-3f;  // [m] chords, and floats of a kilometre
    const Oval oval;
    for (const float offset : offsets) {
        for (int i = 0; i < samples; ++i) {
            const float arc = arc_at(oval, i, offset);
            const glm::vec2 before = oval.position(arc - step, offset), after = oval.position(arc + step, offset);
            EXPECT_NEAR(glm::distance(before, after), 2 * step, tolerance) << arc << " at offset " << offset;
        }
    }
}

// The line itself, as points a few centimetres apart.
float distance_by_brute_force(const Oval& oval, glm::vec2 from) {
    constexpr int points = 16000;
    float least = 1e9f;
    for (int i = 0; i < points; ++i) {
        const double turn = 2 * M_PI * i / points;
        // The nearest point is on the half circle or straight of its own side.
        const glm::vec2 on_circle(oval.radius * std::cos(turn), oval.radius * std::sin(turn));
        const glm::vec2 bend = on_circle + glm::vec2(on_circle.x > 0 ? oval.half_straight : -oval.half_straight, 0);
        const float along = oval.half_straight * (2 * static_cast<float>(i) / points - 1);
        least = std::min({least, glm::distance(from, bend), glm::distance(from, glm::vec2(along, oval.radius)),
                          glm::distance(from, glm::vec2(along, -oval.radius))});
    }
    return least;
}

TEST(Oval, OffsetIsTheSignedDistanceFromTheInnerLine) {
    constexpr float tolerance = 1e-3f;  // [m] between two points of the line
    const Oval oval;
    for (float x = -95; x <= 95; x += 19) {
        for (float z = -55; z <= 55; z += 11) {
            const float offset = oval.offset_of({x, z}), distance = distance_by_brute_force(oval, {x, z});
            EXPECT_NEAR(std::abs(offset), distance, tolerance) << x << ' ' << z;
            const float beyond = std::max(std::abs(x) - oval.half_straight, 0.0f);
            EXPECT_EQ(offset > 0, beyond * beyond + z * z > oval.radius * oval.radius) << x << ' ' << z;
        }
    }
}

TEST(Oval, ArcWrapsBothWays) {
    constexpr float tolerance = 1e-3f;  // [m] rounding of an arc of two laps
    const Oval oval;
    const float length = oval.length(3.0f);
    for (int i = 0; i < samples; ++i) {
        const float arc = arc_at(oval, i, 3.0f);
        const glm::vec2 here = oval.position(arc, 3.0f);
        EXPECT_LT(glm::distance(oval.position(arc + length, 3.0f), here), tolerance);
        EXPECT_LT(glm::distance(oval.position(arc - length, 3.0f), here), tolerance);
    }
}

}  // namespace
