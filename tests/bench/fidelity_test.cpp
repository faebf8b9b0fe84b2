#include "tests/bench/fidelity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

render::Image grey(int width, int height, const std::vector<int>& codes) {
    render::Image image{width, height, {}};
    for (const int code : codes)
        for (int channel = 0; channel < 3; ++channel) image.pixels.push_back(static_cast<std::uint8_t>(code));
    return image;
}

render::Image even(int width, int height, int code) {
    return grey(width, height, std::vector<int>(static_cast<std::size_t>(width) * height, code));
}

// Columns of two codes in turn.
render::Image stripes(int width, int height, int first, int second) {
    std::vector<int> codes;
    for (int i = 0; i < width * height; ++i) codes.push_back(i % width % 2 == 0 ? first : second);
    return grey(width, height, codes);
}

TEST(Fidelity, EqualPicturesAreEqual) {
    const render::Image image = stripes(13, 9, 40, 200);
    EXPECT_EQ(bench::psnr(image, image), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(bench::ssim(image, image), 1, 1e-12);
}

TEST(Fidelity, PsnrOfAnOffsetIsItsShareOfWhite) {
    EXPECT_NEAR(bench::psnr(even(7, 5, 100), even(7, 5, 110)), 20 * std::log10(255.0 / 10), 1e-9);
    // One of two channels' worth of pixels off: half the mean square.
    EXPECT_NEAR(bench::psnr(grey(2, 1, {50, 60}), grey(2, 1, {50, 65})), 10 * std::log10(255.0 * 255 / 12.5), 1e-9);
}

// Without any structure what is left is how alike the means are.
TEST(Fidelity, SsimOfAnOffsetIsThatOfTheMeans) {
    constexpr double c1 = 2.55 * 2.55, a = 100, b = 130;
    EXPECT_NEAR(bench::ssim(even(20, 20, 100), even(20, 20, 130)), (2 * a * b + c1) / (a * a + b * b + c1), 1e-9);
}

// Two pixels: the window's weights at the middle and beside it are 1 and w = exp(-1/4.5), to their sum. A shift by one
// swaps the pixels, so that at either of them the means are a mix and its mirror image, and the covariance is minus the
// variance.
TEST(Fidelity, SsimOfAShiftedPairIsAsByHand) {
    constexpr double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65, low = 40, high = 200;
    const double w = std::exp(-0.5 / (1.5 * 1.5)), near = 1 / (1 + w), far = w / (1 + w);
    const double mean = near * low + far * high, shifted = near * high + far * low;
    const double variance = near * far * (high - low) * (high - low);
    const double expected = (2 * mean * shifted + c1) * (-2 * variance + c2) /
                            ((mean * mean + shifted * shifted + c1) * (2 * variance + c2));
    EXPECT_NEAR(bench::ssim(grey(2, 1, {40, 200}), grey(2, 1, {200, 40})), expected, 1e-9);
}

TEST(Fidelity, SsimOfStripesShiftedByOneIsNearlyMinusOne) {
    const double ssim = bench::ssim(stripes(40, 20, 40, 200), stripes(40, 20, 200, 40));
    EXPECT_LT(ssim, -0.95);
    EXPECT_GE(ssim, -1);
}

TEST(Fidelity, LightIsTheSquareOfCodes) {
    const glm::dvec3 light = bench::mean_light(render::Image{2, 1, {255, 0, 51, 0, 0, 51}});
    EXPECT_NEAR(light.r, 0.5, 1e-12);
    EXPECT_NEAR(light.g, 0.0, 1e-12);
    EXPECT_NEAR(light.b, 0.04, 1e-12);
}

TEST(Fidelity, ABoxKeepsTheLightOfEachOfItsSquares) {
    const render::Image image = grey(4, 2, {255, 0, 100, 100, 0, 0, 100, 100});
    const render::Image half = bench::box_filtered(image, 2);
    ASSERT_EQ(half.width, 2);
    ASSERT_EQ(half.height, 1);
    EXPECT_EQ(half.pixels, (std::vector<std::uint8_t>{128, 128, 128, 100, 100, 100}));  // 255 sqrt(1/4), rounded
}

}  // namespace
