// What is learned of the slowest frames, from residuals of known distributions.
#include "sfsm/tail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/sfsm/normal.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr double noise = 0.03;  // 1 sigma
constexpr int seeds = 40;

using Residual = std::function<double(std::mt19937_64&)>;

double gaussian(std::mt19937_64& random) {
    return noise * normal(random);
}

// In 6 % of the frames something else comes first, for 5 to 20 % of the frame.
double heavy(std::mt19937_64& random) {
    const double on_top = uniform(random) < 0.06 ? uniform(random, 0.05, 0.2) : 0;
    return std::log(std::exp(gaussian(random)) + on_top);
}

double true_percentile(const Residual& residual) {
    constexpr std::size_t count = 200'000;
    std::mt19937_64 random(99);
    std::vector<double> all(count);
    for (double& each : all) each = residual(random);
    std::sort(all.begin(), all.end());
    return all[static_cast<std::size_t>(Tail::percentile * count)];
}

Tail after(int frames, const Residual& residual, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Tail tail;
    for (int i = 0; i < frames; ++i) tail.add(residual(random), noise);
    return tail;
}

double mean_excess(int frames, const Residual& residual) {
    double sum = 0;
    for (int seed = 1; seed <= seeds; ++seed) sum += after(frames, residual, seed).excess();
    return sum / seeds;
}

TEST(Tail, OfNormalNoiseIsThatPercentileOfIt) {
    EXPECT_NEAR(true_percentile(gaussian), Tail::normal * noise, 0.02 * noise);
    EXPECT_NEAR(mean_excess(100, gaussian), Tail::normal * noise, 0.25 * noise);
    EXPECT_NEAR(mean_excess(1000, gaussian), Tail::normal * noise, 0.15 * noise);
}

// A heavy tail is thin where its percentile is, so what counts is the share of frames beyond.
TEST(Tail, OfAHeavyTailIsFoundFromBelow) {
    const double sought = true_percentile(heavy);
    EXPECT_GT(sought, 2 * Tail::normal * noise);
    EXPECT_GT(mean_excess(100, heavy), 0.65 * sought);
    EXPECT_NEAR(mean_excess(3000, heavy), sought, 0.1 * sought);
    double beyond = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const double excess = after(3000, heavy, seed).excess();
        std::mt19937_64 random(1000 + seed);
        for (int i = 0; i < 1000; ++i) beyond += heavy(random) > excess ? 1.0 / (1000 * seeds) : 0;
    }
    EXPECT_NEAR(beyond, 1 - Tail::percentile, 0.007);
}

// Frames that follow each other are alike: an autoregression of 0.35, whose single frames have the same spread.
TEST(Tail, OfFramesThatAreAlikeIsTheSame) {
    constexpr double likeness = 0.35;
    double last = 0;
    const auto alike = [&](std::mt19937_64& random) {
        return last = likeness * last + std::sqrt(1 - likeness * likeness) * gaussian(random);
    };
    EXPECT_NEAR(mean_excess(1000, alike), Tail::normal * noise, 0.2 * noise);
}

TEST(Tail, ASlowFrameMovesItNoFurtherThanOneJustBeyondIt) {
    for (int frames : {0, 10, 60, 1000}) {
        const Tail before = after(frames, gaussian, 5);
        Tail just_beyond = before, far_beyond = before;
        for (int i = 0; i < 3; ++i) {
            just_beyond.add(before.excess() + 3 * noise, noise);
            far_beyond.add(0.29, noise);
        }
        EXPECT_EQ(just_beyond.excess(), far_beyond.excess()) << frames;
        EXPECT_LT(far_beyond.excess() - before.excess(), 2 * noise) << frames;
    }
}

TEST(Tail, HitchesAndOtherLoadsTeachNothing) {
    Tail tail = after(200, gaussian, 6);
    const double before = tail.excess();
    for (int i = 0; i < 100; ++i) tail.add(i % 2 == 0 ? 0.5 : 5, noise);
    EXPECT_EQ(tail.excess(), before);
}

TEST(Tail, StaysMostOfTheTime) {
    for (int seed = 1; seed <= seeds; ++seed) {
        std::mt19937_64 random(seed);
        Tail tail = after(500, gaussian, seed);
        int moves = 0;
        for (int i = 0; i < 1000; ++i) {
            const double before = tail.excess();
            tail.add(gaussian(random), noise);
            moves += tail.excess() != before ? 1 : 0;
        }
        EXPECT_LE(moves, 10) << seed;
    }
}

TEST(Tail, IsForgottenOnceFramesAreQuiet) {
    Tail tail = after(1000, heavy, 7);
    std::mt19937_64 random(8);
    constexpr double quiet = 0.1;  // of the noise before
    for (int i = 0; i < 3000; ++i) tail.add(quiet * gaussian(random), quiet * noise);
    EXPECT_LT(tail.excess(), 3 * quiet * noise);
}

}  // namespace
}  // namespace sfsm
