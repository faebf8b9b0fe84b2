#include "pointsample/prefix_look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pointsample/sample.h"
#include "tests/pointsample/shapes.h"

namespace {

// A ball, skin above and shirt below the equator, white and black in its +x and -x halves.
pointsample::PointModel two_toned_ball() {
    motion::Mesh ball = tests::make_sphere(1.0f, 5);
    for (std::size_t v = 0; v < ball.vertex_count(); ++v) {
        ball.tints[v] = ball.positions[v].y > 0 ? motion::Tint::skin : motion::Tint::shirt;
        ball.colors[v] = ball.positions[v].x > 0 ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255);
    }
    pointsample::SampleOptions options;
    options.count = 2000;
    options.visible_only = false;
    const pointsample::PosedMesh rest{ball.positions, ball.normals};
    return pointsample::sample(ball, {&rest, 1}, options);
}

constexpr int skin = 0, shirt = 2;  // places in PrefixLook::tint

TEST(PrefixLook, OnePointShowsTheMeanOfAll) {
    const auto looks = pointsample::prefix_looks(two_toned_ball(), 1);
    ASSERT_EQ(looks.size(), 1u);
    constexpr double border = 8;  // triangles on the borders go to one side or the other
    EXPECT_NEAR(looks[0].tint[skin], 127.5, border);
    EXPECT_NEAR(looks[0].tint[shirt], 127.5, border);
    EXPECT_NEAR(looks[0].color.r, 255 * std::sqrt(0.5), border);  // half the light, not half the code value
}

TEST(PrefixLook, SharesAddUpToTheWhole) {
    const pointsample::PointModel model = two_toned_ball();
    for (const std::size_t count : {1u, 2u, 7u, 32u}) {
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, count)) {
            int sum = 0;
            for (const std::uint8_t share : look.tint) sum += share;
            EXPECT_NEAR(sum, 255, 2) << count;  // rounding, a half for each of four
        }
    }
}

TEST(PrefixLook, WholeModelShowsItself) {
    const pointsample::PointModel model = two_toned_ball();
    const auto looks = pointsample::prefix_looks(model, model.size());
    for (std::size_t i = 0; i < model.size(); ++i) {
        EXPECT_NEAR(looks[i].color.r, model.colors[i].r, 1);
        EXPECT_EQ(looks[i].tint[skin], model.tints[i] == motion::Tint::skin ? 255 : 0);
    }
}

TEST(PrefixLook, MeanOfAnyPrefixIsNearTheMeanOfAll) {
    const pointsample::PointModel model = two_toned_ball();
    for (const std::size_t count : {4u, 8u, 16u, 32u}) {
        double skin_share = 0;
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, count))
            skin_share += look.tint[skin] / 255.0;
        EXPECT_NEAR(skin_share / static_cast<double>(count), 0.5, 0.15) << count;  // parts differ in size
    }
}

}  // namespace
