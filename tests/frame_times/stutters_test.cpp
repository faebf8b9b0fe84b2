// Stutters, against a moving mean computed anew for every frame.
#include "sfsm/frame_times/stutters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sfsm/frame_times/figures.h"
#include "tests/frame_times/runs.h"

namespace sfsm {
namespace {

std::vector<Stutter> slow_stutters(const std::vector<double>& all) {
    std::vector<double> times;
    std::vector<std::int64_t> frames;
    long double total = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (std::isnan(all[i])) continue;
        times.push_back(all[i]);
        frames.push_back(static_cast<std::int64_t>(i));
        total += all[i];
    }
    const double mean = static_cast<double>(total) / static_cast<double>(times.size());
    const std::ptrdiff_t window = static_cast<std::ptrdiff_t>(std::floor(10 * std::sqrt(mean) + 0.5));
    std::vector<Stutter> stutters;
    for (std::ptrdiff_t i = 0; i < std::ssize(times); ++i) {
        long double sum = 0, begins = 0;
        std::ptrdiff_t count = 0;
        for (std::ptrdiff_t j = i; j >= 0 && count < window; --j, ++count) sum += times[j];
        if (frames[static_cast<std::size_t>(i)] < 10) {
            sum = 0;
            for (count = 0; count < window && count < std::ssize(times); ++count) sum += times[count];
        }
        const double around = static_cast<double>(sum) / static_cast<double>(count);
        if (times[i] <= 2.5 * around) continue;
        for (std::ptrdiff_t j = 0; j < i; ++j) begins += times[j];
        stutters.push_back({frames[i], static_cast<double>(begins), times[i], around, Cause::untold});
    }
    return stutters;
}

TEST(Stutters, AreThoseOfTheSlowWay) {
    std::size_t seen = 0;
    for (const auto& [kind, name] : kinds) {
        for (const std::size_t frames : {0, 1, 2, 3, 5, 8, 13, 25, 26, 27, 40, 80, 1000, 4001}) {
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                SCOPED_TRACE(name + ' ' + std::to_string(frames));
                const std::vector<double> times = times_of(kind, frames, seed);
                const std::vector<Stutter> found = stutters_of(run_of(times)), expected = slow_stutters(times);
                ASSERT_EQ(found.size(), expected.size());
                double stutter_ms = 0;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    EXPECT_EQ(found[i].frame, expected[i].frame);
                    EXPECT_EQ(found[i].frame_ms, expected[i].frame_ms);
                    EXPECT_NEAR(found[i].mean_ms, expected[i].mean_ms, 1e-12 * expected[i].mean_ms);
                    EXPECT_NEAR(found[i].begins_ms, expected[i].begins_ms, 1e-12 * expected[i].begins_ms);
                    stutter_ms += found[i].frame_ms;
                }
                seen += found.size();
                const Figures figures = figures_of(run_of(times), 0, {});
                EXPECT_EQ(figures.stutters, std::ssize(found));
                if (figures.timed == 0) continue;
                EXPECT_NEAR(figures.stutter_share, stutter_ms / (1000 * figures.seconds), 1e-12);
            }
        }
    }
    EXPECT_GT(seen, 100u);
}

TEST(Stutters, ARecordersOwnHitchAtItsStartIsSeen) {
    for (const std::size_t place : {0, 1, 5}) {
        std::vector<double> times(200, 10);
        times[place] = 80;
        const std::vector<Stutter> found = stutters_of(run_of(times));
        ASSERT_EQ(found.size(), 1u) << place;
        EXPECT_EQ(found[0].frame, static_cast<std::int64_t>(place));
        EXPECT_EQ(found[0].cause, Cause::recorder);
    }
}

// 41 frames at 60 frames/s.
TEST(Stutters, WindowGrowsWithTheRootOfTheTime) {
    EXPECT_EQ(stutter_window(1000.0 / 60), 41);
    EXPECT_EQ(stutter_window(4), 20);
    EXPECT_EQ(stutter_window(1e-6), 1);
    EXPECT_GE(stutter_window(1e300), 1000000);
}

TEST(Stutters, AFrameCountsIntoItsOwnMean) {
    std::vector<double> times(100, 9);  // a window of 30 frames
    const double just = 2.5 * 29 * 9 / (30 - 2.5);
    times[50] = just * 0.9999;
    EXPECT_TRUE(stutters_of(run_of(times)).empty());
    times[50] = just * 1.01;
    ASSERT_EQ(stutters_of(run_of(times)).size(), 1u);
    EXPECT_EQ(stutters_of(run_of(times))[0].frame, 50);
}

// What left the window must leave no rounding error of its size behind.
TEST(Stutters, AnEnormousFrameLeavesTheMeansBehindItExact) {
    std::vector<double> times(200000, 0.1);
    times[100] = 1e9;
    times[199990] = 1;
    const std::vector<Stutter> stutters = stutters_of(run_of(times));
    ASSERT_EQ(stutters.size(), 2u);
    const double window = static_cast<double>(stutter_window(1e9 / 200000));
    EXPECT_NEAR(stutters[1].mean_ms, 0.1 + 0.9 / window, 1e-12);
}

TEST(Stutters, FramesWithoutATimeTakeNoPlaceInTheWindow) {
    std::vector<double> times, with_gaps;
    for (int i = 0; i < 300; ++i) {
        const double time = i % 70 == 60 ? 60 : 10;
        times.push_back(time);
        with_gaps.push_back(time);
        if (i % 3 == 0) with_gaps.push_back(FrameRecord::untold);
    }
    const std::vector<Stutter> found = stutters_of(run_of(times)), gaps = stutters_of(run_of(with_gaps));
    ASSERT_EQ(found.size(), gaps.size());
    ASSERT_EQ(found.size(), 4u);
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].mean_ms, gaps[i].mean_ms);
        EXPECT_EQ(found[i].begins_ms, gaps[i].begins_ms);
    }
}

// A long frame at `place` of 100, with what the log tells of it.
Cause cause_at(std::size_t place, double cpu_ms, double gpu_ms, float compilations) {
    std::vector<FrameRecord> frames = run_of(std::vector<double>(100, 4));
    frames[place].frame_ms = 100;
    frames[place].cpu_ms = cpu_ms;
    frames[place].gpu_ms = gpu_ms;
    frames[place].compilations = compilations;
    const std::vector<Stutter> stutters = stutters_of(frames);
    EXPECT_EQ(stutters.size(), 1u);
    return stutters.empty() ? Cause::untold : stutters[0].cause;
}

TEST(Stutters, HaveTheFirstCauseThatHolds) {
    constexpr double untold = FrameRecord::untold;
    constexpr float no_count = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(cause_at(recorder_frames - 1, 1, 95, 3), Cause::recorder);
    EXPECT_EQ(cause_at(recorder_frames, 1, 95, 3), Cause::compilation);
    EXPECT_EQ(cause_at(50, 1, 95, 0), Cause::gpu);
    EXPECT_EQ(cause_at(50, 95, 1, no_count), Cause::cpu);
    EXPECT_EQ(cause_at(50, untold, 95, no_count), Cause::gpu);
    EXPECT_EQ(cause_at(50, 4, 4, no_count), Cause::waiting);
    EXPECT_EQ(cause_at(50, untold, 4, no_count), Cause::untold);
    EXPECT_EQ(cause_at(50, untold, untold, no_count), Cause::untold);
}

TEST(Stutters, CausesHaveNamesOfTheirOwn) {
    const std::vector<Cause> causes = {Cause::recorder, Cause::compilation, Cause::gpu,
                                       Cause::cpu,      Cause::waiting,     Cause::untold};
    for (const Cause a : causes) {
        for (const Cause b : causes) EXPECT_EQ(name_of(a) == name_of(b), a == b);
    }
}

}  // namespace
}  // namespace sfsm
