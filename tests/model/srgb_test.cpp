#include "model/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

TEST(Srgb, EveryByteSurvivesTheRoundTrip) {
    float before = -1;
    for (int byte = 0; byte < 256; ++byte) {
        const float linear = model::linear_of_srgb(static_cast<std::uint8_t>(byte));
        EXPECT_GT(linear, before);
        before = linear;
        EXPECT_EQ(model::srgb_of_linear(linear), byte);
    }
    EXPECT_EQ(model::linear_of_srgb(0), 0.0f);
    EXPECT_EQ(model::linear_of_srgb(255), 1.0f);
}

TEST(Srgb, EncodesAsTheStandardsFormula) {
    for (double linear = 0; linear <= 1; linear += 1.0 / 4096) {
        const double code = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        EXPECT_NEAR(model::srgb_of_linear(static_cast<float>(linear)), code * 255, 0.501) << linear;
    }
}

TEST(Srgb, IsDefinedOutsideTheRange) {
    EXPECT_EQ(model::srgb_of_linear(-1), 0);
    EXPECT_EQ(model::srgb_of_linear(7), 255);
    EXPECT_EQ(model::srgb_of_linear(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(model::srgb_of_linear(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
