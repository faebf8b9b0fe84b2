// Differences of two recordings, and whether their intervals say the truth.
#include "sfsm/frame_times/differences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sfsm/frame_times/figures.h"
#include "sfsm/frame_times/stutters.h"
#include "tests/frame_times/runs.h"

namespace sfsm {
namespace {

using Values = std::array<double, 6>;

// A run in blocks, drawn anew frame by frame and looked at as if it had been recorded.
struct SlowBlocks {
    std::vector<std::vector<FrameRecord>> blocks;
    std::vector<double> stutter_ms;  // of each block, in the run as it was

    explicit SlowBlocks(const std::vector<FrameRecord>& frames) {
        const Figures figures = figures_of(frames, 0, {});
        const double parts = std::floor(
            std::min(std::min(std::max(20.0, figures.seconds / 5), 1000.0), static_cast<double>(figures.timed) / 30));
        const std::vector<Stutter> stutters = stutters_of(frames);
        double begins = 0, last_part = -1;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (std::isnan(frames[i].frame_ms)) continue;
            const double part = std::floor(parts * begins / (1000 * figures.seconds));
            if (part != last_part) {
                blocks.emplace_back();
                stutter_ms.push_back(0);
            }
            last_part = part;
            begins += frames[i].frame_ms;
            blocks.back().push_back(frames[i]);
            for (const Stutter& stutter : stutters) {
                if (stutter.frame == static_cast<std::int64_t>(i)) stutter_ms.back() += stutter.frame_ms;
            }
        }
    }

    Values draw(std::uint64_t seed, std::uint64_t number) const {
        std::vector<FrameRecord> drawn;
        double stutter = 0;
        const std::uint32_t count = static_cast<std::uint32_t>(blocks.size());
        for (std::uint64_t i = 0; i + 1 < count; ++i) {
            const std::uint32_t block = below(stream(seed, number * count + i), count);
            drawn.insert(drawn.end(), blocks[block].begin(), blocks[block].end());
            stutter += stutter_ms[block];
        }
        const Figures figures = figures_of(drawn, 0, {});
        return {figures.average_fps, figures.median_fps,     figures.p1_fps,
                figures.p01_fps,     figures.low_1.integral, stutter / (1000 * figures.seconds)};
    }
};

TEST(Differences, AreThoseOfRunsDrawnFrameByFrame) {
    for (const auto& [kind, name] : kinds) {
        SCOPED_TRACE(name);
        const std::vector<FrameRecord> first = run_of(times_of(kind, 400, 1)), second = run_of(times_of(kind, 900, 2));
        const std::vector<Difference> found = differences_of(first, second, 5);
        ASSERT_EQ(found.size(), 6u);
        const SlowBlocks first_blocks(first), second_blocks(second);
        std::array<std::vector<double>, 6> changes;
        for (int i = 0; i < difference_draws; ++i) {
            const Values a = first_blocks.draw(hash(5, 1), i), b = second_blocks.draw(hash(5, 2), i);
            for (std::size_t k = 0; k < 6; ++k) changes[k].push_back(k == 5 ? b[k] - a[k] : b[k] / a[k] - 1);
        }
        for (std::size_t k = 0; k < 6; ++k) {
            std::sort(changes[k].begin(), changes[k].end());
            constexpr double rounding = 1e-12;  // of changes of about 1
            EXPECT_NEAR(found[k].low, changes[k][24], rounding) << found[k].name;
            EXPECT_NEAR(found[k].high, changes[k][975], rounding) << found[k].name;
        }
    }
}

TEST(Differences, AreOfTheFiguresOfBoth) {
    const std::vector<FrameRecord> first = run_of(times_of(Kind::spiky, 500, 1)),
                                   second = run_of(times_of(Kind::bimodal, 700, 2));
    const Figures a = figures_of(first, 0, {}), b = figures_of(second, 0, {});
    const std::vector<Difference> found = differences_of(first, second, 0);
    const Values expected_first = {a.average_fps, a.median_fps, a.p1_fps, a.p01_fps, a.low_1.integral, a.stutter_share};
    const Values expected_second = {b.average_fps, b.median_fps,     b.p1_fps,
                                    b.p01_fps,     b.low_1.integral, b.stutter_share};
    ASSERT_EQ(found.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(found[i].first, expected_first[i]);
        EXPECT_EQ(found[i].second, expected_second[i]);
        EXPECT_EQ(found[i].is_share, i == 5);
        EXPECT_EQ(found[i].unit, i == 5 ? "%" : "fps");
    }
    EXPECT_DOUBLE_EQ(found[0].change, b.average_fps / a.average_fps - 1);
    EXPECT_DOUBLE_EQ(found[5].change, b.stutter_share - a.stutter_share);
    EXPECT_LT(found[5].high, 0) << "only the first has stutters";
    EXPECT_TRUE(found[5].is_clear());
}

// Frames whose logarithms go on from one another by `likeness` (an AR(1) process), 15 % about their mean.
std::vector<double> correlated(std::size_t frames, double likeness, double mean_ms, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> times;
    double level = numbers.normal();
    for (std::size_t i = 0; i < frames; ++i) {
        times.push_back(mean_ms * std::exp(0.15 * level));
        level = likeness * level + std::sqrt(1 - likeness * likeness) * numbers.normal();
    }
    return times;
}

std::vector<double> shuffled(std::vector<double> times, std::uint64_t seed) {
    for (std::size_t i = times.size(); i > 1; --i)
        std::swap(times[i - 1], times[below(stream(seed, i), static_cast<std::uint32_t>(i))]);
    return times;
}

constexpr double likeness = 0.95;         // over some 20 frames
constexpr std::size_t long_run = 6000;    // 100 s of 16.7 ms, so 20 blocks
constexpr double frame_60 = 1000.0 / 60;  // [ms]

// Of 200 intervals that are to hold at 95 %, 190 +- 3.1 do. 176 to 199 allows for three of these sigmas and for 93 %,
// as 20 blocks and the block's ends make the intervals somewhat short.
TEST(Differences, IntervalsHoldWithTheChanceTheyClaimThoughFramesAreAlike) {
    constexpr int pairs = 200;
    std::array<int, 5> held{};
    for (int i = 0; i < pairs; ++i) {
        const std::vector<Difference> found =
            differences_of(run_of(correlated(long_run, likeness, frame_60, 2 * i)),
                           run_of(correlated(long_run, likeness, frame_60, 2 * i + 1)), i);
        for (std::size_t k = 0; k < held.size(); ++k) held[k] += found[k].low <= 0 && found[k].high >= 0;
    }
    for (const std::size_t figure : {0, 1, 2, 4}) {
        EXPECT_GE(held[figure], 176) << figure;
        EXPECT_LE(held[figure], 199) << figure;
    }
    // Six frames of 6000 are too few to say how they spread.
    EXPECT_GE(held[3], 160);
}

double width(const std::vector<double>& first, const std::vector<double>& second) {
    const Difference average = differences_of(run_of(first), run_of(second), 1)[0];
    return average.high - average.low;
}

// The same frames in any order have the same average, but it is worth more where neighbours are not alike: by
// sqrt((1 + likeness) / (1 - likeness)) = 6.2.
TEST(Differences, FramesThatAreAlikeAreWorthLess) {
    const std::vector<double> first = correlated(long_run, likeness, frame_60, 1),
                              second = correlated(long_run, likeness, frame_60, 2);
    const double alike = width(first, second), mixed = width(shuffled(first, 1), shuffled(second, 2));
    EXPECT_GT(alike, 3 * mixed);
    EXPECT_LT(alike, 10 * mixed);
}

TEST(Differences, ThreePercentOverLongRunsAreClear) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const std::vector<Difference> found =
            differences_of(run_of(correlated(40000, likeness, frame_60, 10 + seed)),
                           run_of(correlated(40000, likeness, frame_60 / 1.03, 20 + seed)), seed);
        for (const std::size_t figure : {0, 1}) {
            EXPECT_TRUE(found[figure].is_clear()) << found[figure].name;
            EXPECT_LE(found[figure].low, 0.03 + 0.015);
            EXPECT_GE(found[figure].high, 0.03 - 0.015);
            EXPECT_NEAR(found[figure].change, 0.03, 0.015);
        }
    }
}

TEST(Differences, OfARecordingAndItselfAreNone) {
    for (const auto& [kind, name] : kinds) {
        const std::vector<FrameRecord> run = run_of(times_of(kind, 2000, 3));
        for (const Difference& difference : differences_of(run, run, 9)) {
            EXPECT_EQ(difference.change, 0) << name << ' ' << difference.name;
            EXPECT_LE(difference.low, 0) << name << ' ' << difference.name;
            EXPECT_GE(difference.high, 0) << name << ' ' << difference.name;
            EXPECT_FALSE(difference.is_clear()) << name << ' ' << difference.name;
        }
    }
}

TEST(Differences, AreTheSameForTheSameSeed) {
    const std::vector<FrameRecord> first = run_of(times_of(Kind::spiky, 3000, 1)),
                                   second = run_of(times_of(Kind::spiky, 3000, 2));
    const Difference once = differences_of(first, second, 4)[0], again = differences_of(first, second, 4)[0],
                     other = differences_of(first, second, 5)[0];
    EXPECT_EQ(once.low, again.low);
    EXPECT_EQ(once.high, again.high);
    EXPECT_NE(once.low, other.low);
    EXPECT_NEAR(once.low, other.low, 0.2 * (once.high - once.low));
}

TEST(Differences, OfShortRunsHaveNoInterval) {
    const std::vector<FrameRecord> enough = run_of(times_of(Kind::smooth, 240, 1));
    std::vector<double> one_long = times_of(Kind::smooth, 240, 2);
    one_long[100] = 1e9;
    for (const std::vector<double>& times :
         {std::vector<double>{}, std::vector<double>{10}, std::vector<double>(500, FrameRecord::untold),
          times_of(Kind::smooth, 239, 3), one_long}) {
        for (const Difference& difference : differences_of(enough, run_of(times), 1)) {
            EXPECT_TRUE(std::isnan(difference.low)) << times.size();
            EXPECT_TRUE(std::isnan(difference.high)) << times.size();
            EXPECT_FALSE(difference.is_clear());
        }
    }
    EXPECT_TRUE(std::isnan(differences_of(enough, {}, 1)[0].change));
    for (const Difference& difference : differences_of(enough, run_of(times_of(Kind::smooth, 240, 4)), 1))
        EXPECT_FALSE(std::isnan(difference.low)) << difference.name;
}

}  // namespace
}  // namespace sfsm
