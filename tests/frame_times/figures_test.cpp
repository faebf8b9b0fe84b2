// The figures of a recording, against the same figures computed the slow way.
#include "sfsm/frame_times/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sfsm/frame_times/stutters.h"
#include "tests/frame_times/runs.h"

namespace sfsm {
namespace {

constexpr double rounding = 1e-12;  // relative: a few thousand additions of doubles

void expect_alike(double found, long double expected, const std::string& what) {
    EXPECT_NEAR(found, static_cast<double>(expected), rounding * std::abs(static_cast<double>(expected))) << what;
}

// Hyndman and Fan's definition 8, of values sorted upwards.
long double quantile(std::vector<long double> values, long double share) {
    std::sort(values.begin(), values.end());
    const long double n = static_cast<long double>(values.size());
    const long double place = (n + 1.0L / 3) * share + 1.0L / 3;
    if (place <= 1) return values.front();
    if (place >= n) return values.back();
    const std::size_t below = static_cast<std::size_t>(place) - 1;
    const long double weight = place - std::floor(place);
    return (1 - weight) * values[below] + weight * values[below + 1];
}

// Everything by its definition, in O(n^2) where that is simplest.
struct SlowFigures {
    std::vector<long double> times, rates;
    long double total = 0;

    explicit SlowFigures(const std::vector<double>& all) {
        for (const double time : all) {
            if (std::isnan(time)) continue;
            times.push_back(time);
            rates.push_back(1000.0L / time);
            total += time;
        }
    }
    long double low_mean(long double share) const {
        std::vector<long double> sorted = times;
        std::sort(sorted.begin(), sorted.end());
        const long double all = static_cast<long double>(sorted.size());
        const long double count = std::max(1.0L, share * all);
        // Each frame counts as far as it is among the last `count` places.
        long double sum = 0;
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            const long double place = all - static_cast<long double>(i);  // from the slowest, 1
            sum += sorted[i] * std::clamp(count - (place - 1), 0.0L, 1.0L);
        }
        return 1000 * count / sum;
    }
    // The longest time such that the frames no shorter come to one in `one_in` of all time.
    long double low_integral(int one_in) const {
        long double longest = 0;
        for (const long double time : times) {
            long double taken = 0;
            for (const long double other : times) taken += other >= time ? other : 0;
            if (taken * one_in >= total) longest = std::max(longest, time);
        }
        return 1000 / longest;
    }
    long double share_over(long double limit) const {
        return static_cast<long double>(
                   std::count_if(times.begin(), times.end(), [&](long double time) { return time > limit; })) /
               static_cast<long double>(times.size());
    }
    long double mean_step(const std::vector<double>& all) const {
        long double sum = 0, count = 0;
        for (std::size_t i = 0; i + 1 < all.size(); ++i) {
            const long double step = std::abs(static_cast<long double>(all[i + 1]) - all[i]);
            if (std::isnan(step)) continue;
            sum += step;
            count += 1;
        }
        return sum / count;
    }
};

void expect_figures(const std::vector<double>& all, const std::string& what) {
    SCOPED_TRACE(what);
    const Figures found = figures_of(run_of(all), 0, usual_limits_ms);
    const SlowFigures slow(all);
    const long double n = static_cast<long double>(slow.times.size());
    EXPECT_EQ(found.frames, std::ssize(all));
    EXPECT_EQ(found.timed, std::ssize(slow.times));
    if (slow.times.empty()) return;
    expect_alike(found.seconds, slow.total / 1000, "seconds");
    expect_alike(found.average_fps, 1000 * n / slow.total, "average");
    expect_alike(found.mean_ms, slow.total / n, "mean");
    expect_alike(found.median_fps, quantile(slow.rates, 0.5L), "median");
    expect_alike(found.median_ms, quantile(slow.times, 0.5L), "median");
    expect_alike(found.p1_fps, quantile(slow.rates, 0.01L), "P1");
    expect_alike(found.p99_ms, quantile(slow.times, 0.99L), "P1");
    expect_alike(found.p01_fps, quantile(slow.rates, 0.001L), "P0.1");
    expect_alike(found.p999_ms, quantile(slow.times, 0.999L), "P0.1");
    expect_alike(found.least_fps, quantile(slow.rates, 0), "least");
    expect_alike(found.most_fps, quantile(slow.rates, 1), "most");
    expect_alike(found.least_ms, quantile(slow.times, 0), "least");
    expect_alike(found.most_ms, quantile(slow.times, 1), "most");
    EXPECT_EQ(found.low_1.percentile, found.p1_fps);
    EXPECT_EQ(found.low_01.percentile, found.p01_fps);
    expect_alike(found.low_1.mean, slow.low_mean(0.01L), "1 % low");
    expect_alike(found.low_01.mean, slow.low_mean(0.001L), "0.1 % low");
    expect_alike(found.low_1.integral, slow.low_integral(100), "1 % low");
    expect_alike(found.low_01.integral, slow.low_integral(1000), "0.1 % low");
    ASSERT_EQ(found.over.size(), usual_limits_ms.size());
    for (std::size_t i = 0; i < usual_limits_ms.size(); ++i) {
        EXPECT_EQ(found.over[i].limit_ms, usual_limits_ms[i]);
        expect_alike(found.over[i].share, slow.share_over(usual_limits_ms[i]), "over");
        expect_alike(static_cast<double>(found.over[i].frames), n * slow.share_over(usual_limits_ms[i]), "over");
    }
    const long double step = slow.mean_step(all);
    if (std::isnan(step)) {
        EXPECT_TRUE(std::isnan(found.mean_step_ms));
    } else {
        expect_alike(found.mean_step_ms, step, "step");
    }
}

TEST(Figures, AreThoseOfTheSlowWayOfShortRuns) {
    for (const auto& [kind, name] : kinds) {
        for (std::size_t frames = 0; frames <= 40; ++frames) {
            for (std::uint64_t seed = 0; seed < 5; ++seed)
                expect_figures(times_of(kind, frames, seed), name + ' ' + std::to_string(frames));
        }
    }
}

TEST(Figures, AreThoseOfTheSlowWayOfLongRuns) {
    for (const auto& [kind, name] : kinds) {
        for (const std::size_t frames : {99, 100, 101, 149, 150, 1000, 3001}) {
            for (std::uint64_t seed = 0; seed < 3; ++seed)
                expect_figures(times_of(kind, frames, seed), name + ' ' + std::to_string(frames));
        }
    }
}

// Of frames that are nearly all alike the slowest are still the slowest.
TEST(Figures, TiesDontHideTheSlowest) {
    std::vector<double> times(995, 16);
    times.insert(times.end(), 5, 100);
    EXPECT_NEAR(figures_of(run_of(times), 0, {}).low_1.mean, 1000.0 / 58, 1e-9);
}

// By hand: 200 frames of 10 ms but for one of 100 ms and one of 50 ms. P1 stands at place 200.33 / 100 + 1 / 3 = 2.337.
TEST(Figures, OfAFewLongFramesAreWhatTheyAreByHand) {
    std::vector<double> times(200, 10);
    times[70] = 100;
    times[150] = 50;
    const Figures figures = figures_of(run_of(times), 7, std::vector<double>{10, 50});
    constexpr double place = (200 + 1.0 / 3) / 100 + 1.0 / 3;
    EXPECT_NEAR(figures.p1_fps, 20 + (place - 2) * (100 - 20), 1e-9);
    EXPECT_NEAR(figures.p99_ms, 50 - (place - 2) * 40, 1e-9);
    EXPECT_NEAR(figures.low_1.mean, 1000.0 / 75, 1e-9);
    EXPECT_NEAR(figures.low_1.integral, 10, 1e-9);  // 1 % of 2130 ms is in the first
    EXPECT_EQ(figures.p01_fps, 10);
    EXPECT_EQ(figures.median_fps, 100);
    EXPECT_EQ(figures.generated, 7);
    EXPECT_EQ(figures.over[0].frames, 2);
    EXPECT_EQ(figures.over[1].frames, 1);
    EXPECT_EQ(figures.over[1].share, 1.0 / 200);
}

TEST(Figures, IntegralIsOfTheFrameThatReachesItsShareOfTheTime) {
    std::vector<double> times(198, 10);
    times.push_back(20);  // 1 % of 2000 ms
    EXPECT_EQ(figures_of(run_of(times), 0, {}).low_1.integral, 50);
    times.back() = 19;
    EXPECT_EQ(figures_of(run_of(times), 0, {}).low_1.integral, 100);
}

TEST(Figures, OfNothingAreNone) {
    for (const std::vector<double>& times : {std::vector<double>{}, std::vector<double>(3, FrameRecord::untold)}) {
        const Figures figures = figures_of(run_of(times), 0, usual_limits_ms);
        EXPECT_EQ(figures.frames, std::ssize(times));
        EXPECT_EQ(figures.timed, 0);
        EXPECT_EQ(figures.seconds, 0);
        EXPECT_EQ(figures.stutters, 0);
        EXPECT_EQ(figures.stutter_window, 0);
        for (const double figure : {figures.average_fps,      figures.median_fps,     figures.p1_fps,
                                    figures.p01_fps,          figures.least_fps,      figures.most_fps,
                                    figures.mean_ms,          figures.median_ms,      figures.p99_ms,
                                    figures.p999_ms,          figures.least_ms,       figures.most_ms,
                                    figures.mean_step_ms,     figures.stutter_share,  figures.mean_animation_error_ms,
                                    figures.low_1.percentile, figures.low_1.mean,     figures.low_1.integral,
                                    figures.low_01.integral,  figures.bottleneck.gpu, figures.over[0].share})
            EXPECT_TRUE(std::isnan(figure));
    }
}

TEST(Figures, OfOneFrameAndOfFramesAlikeAreThatFrames) {
    for (const std::size_t frames : {1, 2, 250}) {
        const Figures figures = figures_of(run_of(std::vector<double>(frames, 12.5)), 0, usual_limits_ms);
        for (const double rate : {figures.average_fps, figures.median_fps, figures.p1_fps, figures.p01_fps,
                                  figures.least_fps, figures.most_fps, figures.low_1.mean, figures.low_1.integral})
            EXPECT_EQ(rate, 80);
        EXPECT_EQ(figures.stutters, 0);
        EXPECT_EQ(figures.stutter_share, 0);
        EXPECT_EQ(figures.over[0].frames, static_cast<std::int64_t>(frames));
        EXPECT_EQ(figures.over[1].frames, 0);
    }
}

TEST(Figures, OneFrameThatTakesAllTheTimeIsTheLowOfAll) {
    std::vector<double> times(5000, 10);
    times[2000] = 1e9;
    const Figures figures = figures_of(run_of(times), 0, usual_limits_ms);
    EXPECT_EQ(figures.low_1.integral, 1000 / 1e9);
    EXPECT_EQ(figures.least_fps, 1000 / 1e9);
    EXPECT_EQ(figures.p1_fps, 100);
    EXPECT_EQ(figures.stutters, 1);
    EXPECT_NEAR(figures.stutter_share, 1, 1e-4);
}

TEST(Figures, CountWhatIsToldOfAFrameAlsoWithoutATime) {
    std::vector<FrameRecord> frames = run_of({10, FrameRecord::untold, 10, 10});
    frames[0].fate = frames[1].fate = FrameRecord::Fate::dropped;
    frames[2].fate = FrameRecord::Fate::shown;
    frames[1].display_ms = frames[2].display_ms = 20;
    frames[2].animation_error_ms = -3;
    frames[3].animation_error_ms = 1;
    const Figures figures = figures_of(frames, 0, {});
    EXPECT_EQ(figures.dropped, 2);
    EXPECT_EQ(figures.displayed, 2);
    EXPECT_EQ(figures.mean_animation_error_ms, 2);
    EXPECT_EQ(figures.mean_step_ms, 0);
}

FrameRecord frame_with(double cpu_ms, double gpu_ms, double frame_ms = 10) {
    FrameRecord frame;
    frame.frame_ms = frame_ms;
    frame.cpu_ms = cpu_ms;
    frame.gpu_ms = gpu_ms;
    return frame;
}

TEST(HeldUpBy, IsWhoWasBusyForMostOfTheFrame) {
    constexpr double untold = FrameRecord::untold;
    EXPECT_EQ(held_up_by(frame_with(5, 9.5)), HeldUpBy::gpu);
    EXPECT_EQ(held_up_by(frame_with(9.5, 5)), HeldUpBy::cpu);
    EXPECT_EQ(held_up_by(frame_with(9, 8.9)), HeldUpBy::cpu);
    EXPECT_EQ(held_up_by(frame_with(9.5, 9.5)), HeldUpBy::gpu);
    EXPECT_EQ(held_up_by(frame_with(9.8, 9.5)), HeldUpBy::cpu);
    EXPECT_EQ(held_up_by(frame_with(8, 8)), HeldUpBy::neither);
    EXPECT_EQ(held_up_by(frame_with(untold, 9.5)), HeldUpBy::gpu);
    EXPECT_EQ(held_up_by(frame_with(9.5, untold)), HeldUpBy::cpu);
    EXPECT_EQ(held_up_by(frame_with(untold, 8)), HeldUpBy::untold);
    EXPECT_EQ(held_up_by(frame_with(9, 9, untold)), HeldUpBy::untold);
}

TEST(Figures, BottleneckIsASharedOutTimeOfFramesThatTellBoth) {
    const std::vector<FrameRecord> frames = {frame_with(1, 10, 10), frame_with(30, 1, 30), frame_with(2, 2, 60),
                                             frame_with(FrameRecord::untold, 10, 10)};
    const Bottleneck bottleneck = figures_of(frames, 0, {}).bottleneck;
    EXPECT_EQ(bottleneck.frames, 3);
    EXPECT_DOUBLE_EQ(bottleneck.gpu, 0.1);
    EXPECT_DOUBLE_EQ(bottleneck.cpu, 0.3);
    EXPECT_DOUBLE_EQ(bottleneck.neither, 0.6);
}

}  // namespace
}  // namespace sfsm
