// Errors of pictures against closed forms and against a plain computation.
#include "tests/bench/front/judge.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sfsm/random.h"
#include "tests/bench/front/csv.h"

namespace {

using bench::front::Judge;
using bench::front::Reference;
using bench::front::Row;

constexpr double infinity = std::numeric_limits<double>::infinity();

render::Image noise(int width, int height, std::uint64_t seed, int lowest, int span) {
    render::Image image{width, height, {}};
    for (std::uint64_t i = 0; i < std::uint64_t{3} * width * height; ++i)
        image.pixels.push_back(
            static_cast<std::uint8_t>(lowest + sfsm::below(sfsm::hash(seed, i), static_cast<std::uint32_t>(span))));
    return image;
}

render::Image even(int width, int height, int code) {
    return {width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, static_cast<std::uint8_t>(code))};
}

// A wave along the rows, moved to the right by some pixels.
render::Image wave(double moved) {
    constexpr int width = 320, height = 4;
    constexpr double amplitude = 100, period = 32;
    render::Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                image.pixels.push_back(static_cast<std::uint8_t>(
                    std::lround(127 + amplitude * std::sin(2 * std::numbers::pi * (x - moved) / period))));
    return image;
}

// With the whole window around each pixel, as the paper has it: one sum over it for each moment, about its own mean.
double plain_ssim(const render::Image& a, const render::Image& b) {
    constexpr int reach = 5;
    constexpr double deviation = 1.5, c1 = 2.55 * 2.55, c2 = 7.65 * 7.65;
    const auto luma = [](const render::Image& image, int x, int y) {
        const std::uint8_t* code = &image.pixels[std::size_t{3} * (static_cast<std::size_t>(y) * image.width + x)];
        return 0.299 * code[0] + 0.587 * code[1] + 0.114 * code[2];
    };
    double total = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const auto over_window = [&](auto value) {
                double sum = 0, weights = 0;
                for (int v = std::max(0, y - reach); v <= std::min(a.height - 1, y + reach); ++v)
                    for (int u = std::max(0, x - reach); u <= std::min(a.width - 1, x + reach); ++u) {
                        const double square = (u - x) * (u - x) + (v - y) * (v - y);
                        const double weight = std::exp(-0.5 * square / (deviation * deviation));
                        sum += weight * value(luma(a, u, v), luma(b, u, v));
                        weights += weight;
                    }
                return sum / weights;
            };
            const double ma = over_window([](double p, double) { return p; });
            const double mb = over_window([](double, double q) { return q; });
            const double va = over_window([&](double p, double) { return (p - ma) * (p - ma); });
            const double vb = over_window([&](double, double q) { return (q - mb) * (q - mb); });
            const double vab = over_window([&](double p, double q) { return (p - ma) * (q - mb); });
            total += (2 * ma * mb + c1) * (2 * vab + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
        }
    return total / (static_cast<double>(a.width) * a.height);
}

double plain_psnr(const render::Image& a, const render::Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(double(a.pixels[i]) - double(b.pixels[i]), 2);
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.pixels.size()) / sum);
}

Row judged(const Reference& reference, const render::Image& before, const render::Image& now) {
    Row row;
    Judge(reference).judge(before, now, row);
    return row;
}

TEST(FrontJudge, SsimAndPsnrAreThoseOfAPlainComputation) {
    constexpr double tolerance = 1e-4;
    const render::Image a = noise(37, 23, 1, 40, 120), b = noise(37, 23, 2, 60, 120);
    const Row row = judged({a, a, even(37, 23, 0)}, b, b);
    EXPECT_NEAR(row.frame.ssim, plain_ssim(a, b), tolerance);
    EXPECT_NEAR(row.frame.psnr, plain_psnr(a, b), tolerance);
    EXPECT_NEAR(row.frame.flip, bench::mean_flip_error(a, b), 1e-12);
}

TEST(FrontJudge, TheReferenceItselfHasNoError) {
    const render::Image image = noise(40, 20, 3, 0, 256);
    const Row row = judged({image, image, even(40, 20, 7)}, image, image);
    EXPECT_EQ(row.frame.flip, 0);
    EXPECT_EQ(row.frame.psnr, infinity);
    EXPECT_NEAR(row.frame.ssim, 1, 1e-12);
    EXPECT_EQ(row.frame.brightness, 0);
    EXPECT_EQ(row.change, 0);
}

// Codes are square roots of light: one twice as large is four times as much.
TEST(FrontJudge, BrightnessIsLinearLightByChannel) {
    render::Image bright = even(8, 8, 50);
    for (std::size_t i = 0; i < bright.pixels.size(); i += 3) bright.pixels[i] = 100;
    const Row row = judged({even(8, 8, 50), even(8, 8, 50), even(8, 8, 0)}, bright, bright);
    EXPECT_NEAR(row.frame.red, 3, 1e-12);
    EXPECT_NEAR(row.frame.green, 0, 1e-12);
    EXPECT_NEAR(row.frame.blue, 0, 1e-12);
    EXPECT_NEAR(row.frame.brightness, 1, 1e-12);
}

// The crowd: the upper half. Only what is wrong there counts for it.
TEST(FrontJudge, TheCrowdIsWhereItsReferencesDiffer) {
    constexpr int width = 20, height = 10;
    const render::Image everybody = even(width, height, 100);
    render::Image nobody = everybody;
    for (std::size_t i = 0; i < nobody.pixels.size() / 2; i += 3) ++nobody.pixels[i + i % 9 / 3];
    render::Image low = everybody, high = everybody;
    for (std::size_t i = 0; i < low.pixels.size() / 2; ++i) {
        low.pixels[low.pixels.size() / 2 + i] = 110;
        high.pixels[i] = 110;
    }
    const Judge judge({everybody, everybody, nobody});
    Row row;
    judge.judge(low, low, row);
    EXPECT_EQ(row.crowd_share, 0.5);
    EXPECT_EQ(row.crowd.psnr, infinity);
    EXPECT_EQ(row.crowd.brightness, 0);
    judge.judge(high, high, row);
    EXPECT_NEAR(row.crowd.psnr, 20 * std::log10(255.0 / 10), 1e-9);
    EXPECT_NEAR(row.frame.psnr, 20 * std::log10(255.0 / 10) + 10 * std::log10(2.0), 1e-9);
    EXPECT_NEAR(row.crowd.brightness, 0.21, 1e-9);
}

// FLIP and SSIM of a pixel come from those around it, but count where it lies: the frame's are the mean of its halves'.
TEST(FrontJudge, ErrorsOfTheFrameAreTheMeanOfThoseOfItsHalves) {
    constexpr int width = 24, height = 16;
    const render::Image reference = noise(width, height, 10, 40, 100);
    render::Image drawn = reference;
    for (std::size_t i = 0; i < drawn.pixels.size() / 3; ++i) drawn.pixels[i] ^= 31;
    const auto judged_in = [&](std::size_t first_half) {
        render::Image nobody = reference;
        const std::size_t half = nobody.pixels.size() / 2;
        for (std::size_t i = 0; i < half; ++i) ++nobody.pixels[first_half * half + i];
        return judged({reference, reference, nobody}, drawn, drawn);
    };
    const Row upper = judged_in(0), lower = judged_in(1);
    EXPECT_GT(upper.crowd.flip, 2 * lower.crowd.flip);
    EXPECT_LT(upper.crowd.ssim, lower.crowd.ssim - 0.1);
    EXPECT_NEAR(upper.frame.flip, (upper.crowd.flip + lower.crowd.flip) / 2, 1e-9);
    EXPECT_NEAR(upper.frame.ssim, (upper.crowd.ssim + lower.crowd.ssim) / 2, 1e-9);
}

TEST(FrontJudge, WithoutACrowdThereIsNoErrorOfIt) {
    const render::Image image = even(9, 9, 90), other = even(9, 9, 95);
    const Row row = judged({image, image, image}, other, other);
    EXPECT_EQ(row.crowd_share, 0);
    EXPECT_EQ(row.crowd.flip, 0);
    EXPECT_EQ(row.crowd.psnr, infinity);
}

TEST(FrontJudge, ChangeOfAStillPictureIsNothing) {
    const render::Image reference = noise(30, 30, 5, 0, 256), drawn = noise(30, 30, 6, 0, 256);
    EXPECT_EQ(judged({reference, reference, reference}, drawn, drawn).change, 0);
}

// sin(a) - sin(a - d) = 2 sin(d / 2) cos(a - d / 2), and the mean of |cos| is 2 / pi.
TEST(FrontJudge, ChangeOfAShiftByAPixelIsAsInClosedForm) {
    const double expected = 100 * 2 * std::sin(std::numbers::pi / 32) * 2 / std::numbers::pi;
    EXPECT_NEAR(judged({wave(0), wave(0), wave(0)}, wave(0), wave(1)).change, expected, 0.01 * expected);
    EXPECT_NEAR(judged({wave(0), wave(1), wave(0)}, wave(0), wave(0)).change, expected, 0.01 * expected);
    EXPECT_EQ(judged({wave(0), wave(1), wave(0)}, wave(0), wave(1)).change, 0);
}

TEST(FrontJudge, TheNumbersDoNotDependOnThreads) {
    const render::Image a = noise(200, 120, 7, 0, 256), b = noise(200, 120, 8, 0, 256), c = noise(200, 120, 9, 0, 256);
    const auto line = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return bench::front::line_of(judged({a, b, c}, b, a)) + std::to_string(bench::ssim(a, b));
    };
    EXPECT_EQ(line(1), line(2));
}

}  // namespace
