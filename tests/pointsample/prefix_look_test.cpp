#include "pointsample/prefix_look.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "pointsample/sample.h"
#include "tests/pointsample/models.h"
#include "tests/pointsample/shapes.h"

namespace {

constexpr model::Slot upper = 1, lower = 3;

// A ball, in one slot above and in another below the equator, white and black in its +x and -x halves.
pointsample::PointModel two_toned_ball() {
    model::Mesh ball = tests::make_sphere(1.0f, 5);
    for (std::size_t v = 0; v < ball.vertex_count(); ++v) {
        ball.slots[v] = ball.positions[v].y > 0 ? upper : lower;
        ball.colors[v] = ball.positions[v].x > 0 ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255);
    }
    pointsample::SampleOptions options;
    options.count = 2000;
    options.visible_only = false;
    const pointsample::PosedMesh rest{ball.positions, ball.normals};
    return pointsample::sample(ball, {&rest, 1}, options);
}

TEST(PrefixLook, OnePointShowsTheMeanOfAll) {
    const auto looks = pointsample::prefix_looks(two_toned_ball(), 1);
    ASSERT_EQ(looks.size(), 1u);
    constexpr double border = 8;  // triangles on the borders go to one side or the other
    EXPECT_NEAR(looks[0].shares[upper - 1], 127.5, border);
    EXPECT_NEAR(looks[0].shares[lower - 1], 127.5, border);
    EXPECT_NEAR(looks[0].color.r, 255 * std::sqrt(0.5), border);  // half the light, not half the code value
}

TEST(PrefixLook, SharesAddUpToTheWhole) {
    const pointsample::PointModel model = two_toned_ball();
    for (const std::size_t count : {1u, 2u, 7u, 32u}) {
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, count)) {
            int sum = 0;
            for (const std::uint8_t share : look.shares) sum += share;
            EXPECT_NEAR(sum, 255, 2) << count;  // rounding, a half for each of four
        }
    }
}

TEST(PrefixLook, WholeModelShowsItself) {
    const pointsample::PointModel model = two_toned_ball();
    const auto looks = pointsample::prefix_looks(model, model.size());
    for (std::size_t i = 0; i < model.size(); ++i) {
        EXPECT_NEAR(looks[i].color.r, model.colors[i].r, 1);
        EXPECT_EQ(looks[i].shares[upper - 1], model.slots[i] == upper ? 255 : 0);
    }
}

TEST(PrefixLook, MeanOfAnyPrefixIsNearTheMeanOfAll) {
    const pointsample::PointModel model = two_toned_ball();
    for (const std::size_t count : {4u, 8u, 16u, 32u}) {
        double upper_share = 0;
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, count))
            upper_share += look.shares[upper - 1] / 255.0;
        EXPECT_NEAR(upper_share / static_cast<double>(count), 0.5, 0.15) << count;  // parts differ in size
    }
}

// Whose part of the surface a point is: the nearest of the prefix, twice as far where it faces the other way.
std::size_t owner_of(const pointsample::PointModel& model, std::size_t point, std::size_t count) {
    std::size_t owner = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        const bool away = glm::dot(glm::dvec3(model.normals[i]), glm::dvec3(model.normals[point])) < 0;
        const double distance =
            glm::distance(glm::dvec3(model.positions[i]), glm::dvec3(model.positions[point])) * (away ? 2 : 1);
        if (distance < least) least = distance, owner = i;
    }
    return owner;
}

TEST(PrefixLook, IsTheMeanLightAndTheSharesOfThePartThatIsNearest) {
    constexpr double half_a_code = 0.51;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        pointsample::PointModel model = tests::random_model(700, seed);
        for (std::size_t i = 0; i < model.size(); ++i) model.normals[i] *= i % 2 ? -1.0f : 1.0f;  // facing anywhere
        for (const std::size_t count : {1u, 2u, 5u, 24u}) {
            std::vector<glm::dvec3> light(count, glm::dvec3(0));
            std::vector<std::array<double, 1 + model::slot_count>> slots(count, {{}});
            std::vector<double> points(count);
            for (std::size_t i = 0; i < model.size(); ++i) {
                const std::size_t owner = i < count ? i : owner_of(model, i, count);
                const glm::dvec3 color = glm::dvec3(glm::u8vec3(model.colors[i])) / 255.0;
                light[owner] += color * color;
                ++slots[owner][model.slots[i]];
                ++points[owner];
            }
            const std::vector<pointsample::PrefixLook> looks = pointsample::prefix_looks(model, count);
            ASSERT_EQ(looks.size(), count);
            for (std::size_t p = 0; p < count; ++p) {
                for (int channel = 0; channel < 3; ++channel)
                    ASSERT_NEAR(looks[p].color[channel], 255 * std::sqrt(light[p][channel] / points[p]), half_a_code);
                EXPECT_EQ(looks[p].color.a, 255);
                for (std::size_t slot = 1; slot < slots[p].size(); ++slot)
                    ASSERT_NEAR(looks[p].shares[slot - 1], 255 * slots[p][slot] / points[p], half_a_code) << slot;
            }
        }
    }
}

}  // namespace
