#include "sfsm/simulate/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace sfsm::simulate {
namespace {

constexpr std::int64_t samples = 100'000;
// Of a mean of that many independent samples of deviation 1, five sigma.
const double mean_tolerance = 5 / std::sqrt(static_cast<double>(samples));

TEST(Noise, IsAFunctionOfSeedFrameAndStream) {
    EXPECT_EQ(normal_at(3, 7, Stream::noise), normal_at(3, 7, Stream::noise));
    std::set<double> values;
    for (const std::uint64_t seed : {0, 1, 2}) {
        for (const std::int64_t frame : {0, 1, 2}) {
            for (const Stream stream : {Stream::noise, Stream::spike, Stream::spike_size}) {
                values.insert(uniform_at(seed, frame, stream));
            }
        }
    }
    EXPECT_EQ(values.size(), 27u) << "no two of them share a number";
}

TEST(Noise, IsStandardNormal) {
    double sum = 0, squares = 0, within_one = 0, over_two = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame) {
        const double x = normal_at(1, frame, Stream::noise);
        sum += x;
        squares += x * x;
        within_one += std::abs(x) < 1 ? 1 : 0;
        over_two += x > 2 ? 1 : 0;
    }
    EXPECT_NEAR(sum / samples, 0, mean_tolerance);
    EXPECT_NEAR(squares / samples, 1, std::sqrt(2.0) * mean_tolerance);
    EXPECT_NEAR(within_one / samples, std::erf(1 / std::sqrt(2.0)), mean_tolerance);
    EXPECT_NEAR(over_two / samples, std::erfc(2 / std::sqrt(2.0)) / 2, mean_tolerance);
}

TEST(Noise, UniformsFillTheOpenUnitInterval) {
    double sum = 0, squares = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame) {
        const double x = uniform_at(9, frame, Stream::spike);
        ASSERT_GT(x, 0);
        ASSERT_LT(x, 1);
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / samples, 1.0 / 2, mean_tolerance);
    EXPECT_NEAR(squares / samples, 1.0 / 3, mean_tolerance);
}

TEST(Noise, FramesSeedsAndStreamsAreUncorrelated) {
    double frames = 0, seeds = 0, streams = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame) {
        const double x = normal_at(1, frame, Stream::noise);
        frames += x * normal_at(1, frame + 1, Stream::noise);
        seeds += x * normal_at(2, frame, Stream::noise);
        streams += x * normal_at(1, frame, Stream::spike);
    }
    EXPECT_NEAR(frames / samples, 0, mean_tolerance);
    EXPECT_NEAR(seeds / samples, 0, mean_tolerance);
    EXPECT_NEAR(streams / samples, 0, mean_tolerance);
}

// Neighbours share what they remember, so as many samples tell less: the sums' deviations are sqrt(19) times as large.
TEST(Noise, CorrelatedNoiseRemembersAsMuchAsStated) {
    constexpr double correlation = 0.9;
    constexpr std::int64_t some = 20'000;
    const double tolerance = 5 * std::sqrt(19.0 / some);
    double sum = 0, squares = 0, next = 0, tenth = 0;
    for (std::int64_t frame = 0; frame < some; ++frame) {
        const auto at = [](std::int64_t k) { return correlated_normal_at(1, k, Stream::noise, correlation); };
        const double x = at(frame);
        sum += x;
        squares += x * x;
        next += x * at(frame + 1);
        tenth += x * at(frame + 10);
    }
    EXPECT_NEAR(sum / some, 0, tolerance);
    EXPECT_NEAR(squares / some, 1, tolerance);
    EXPECT_NEAR(next / squares, correlation, 0.02);
    EXPECT_NEAR(tenth / squares, std::pow(correlation, 10), 0.1);
}

// Beyond two deviations a normal one is 4.6 % of the time.
TEST(Noise, CorrelatedNoiseIsNearlyNormal) {
    double over = 0;
    for (std::int64_t frame = 0; frame < samples; ++frame)
        over += std::abs(correlated_normal_at(2, frame, Stream::noise, 0.9)) > 2 ? 1 : 0;
    EXPECT_NEAR(over / samples, std::erfc(std::sqrt(2.0)), 0.01);
}

TEST(Noise, WithoutCorrelationItIsTheNormal) {
    EXPECT_EQ(correlated_normal_at(3, 7, Stream::noise, 0), normal_at(3, 7, Stream::noise));
}

// Of Student's t of 3 degrees over its deviation sqrt(3): beyond x are 1 - (2 / pi) (x / (1 + x^2) + atan x).
TEST(Noise, HeavyTailsAreStudentsOfThreeDegrees) {
    const auto beyond = [](double x) { return 1 - 2 / std::numbers::pi * (x / (1 + x * x) + std::atan(x)); };
    for (const double x : {0.5, 1.0, 3.0, 8.0}) {
        double found = 0;
        for (std::int64_t frame = 0; frame < samples; ++frame)
            found += std::abs(heavy_tailed_at(1, frame, Stream::noise)) > x ? 1 : 0;
        const double share = beyond(x);
        EXPECT_NEAR(found / samples, share, 5 * std::sqrt(share / samples)) << x;
    }
}

}  // namespace
}  // namespace sfsm::simulate
