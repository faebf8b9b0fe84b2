// Which times are a floor: those of displays and caps at any rate, and none of work that is followed.
#include "sfsm/floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "sfsm/random.h"

namespace sfsm {
namespace {

constexpr double refreshes_hz[] = {50, 60, 72, 90, 120, 144, 165};

double uniform(std::uint64_t seed, std::int64_t i) {  // [-0.5, 0.5)
    return unit(hash(seed, static_cast<std::uint64_t>(i))) - 0.5;
}

// Between two stamps that are each off by up to half of this share of the period.
double jittered(double period_ms, double jitter, std::uint64_t seed, std::int64_t i) {
    return period_ms * jitter * (uniform(seed, i) - uniform(seed, i - 1));
}

// A law that lowers the detail in vain.
TEST(Floor, IsFoundWhereTimesDoNotFollowTheWork) {
    for (const double hz : refreshes_hz) {
        for (const double jitter : {0.0, 0.01, 0.03}) {
            const double period_ms = 1000 / hz;
            Floor floor;
            for (int i = 0; i < 60; ++i)
                floor.observe(period_ms + jittered(period_ms, jitter, 1, i), i % 4 == 0 ? -0.04 : 0, 0.95 * period_ms);
            ASSERT_TRUE(floor.is_found()) << hz << " Hz, jitter " << jitter;
            EXPECT_TRUE(floor.is_deaf());
            EXPECT_NEAR(floor.ms(), period_ms, 0.005 * period_ms);
            EXPECT_DOUBLE_EQ(floor.due_ms(0.9 * period_ms), floor.ms());
            EXPECT_DOUBLE_EQ(floor.due_ms(1.7 * period_ms), 1.7 * period_ms) << "a cap, as far as known";
        }
    }
}

TEST(Floor, IsNotFoundWhereTimesFollow) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Floor floor;
        double log_work = 0;
        for (int i = 0; i < 400; ++i) {
            const double step = i % 4 == 0 ? 0.03 * uniform(seed, 1000 + i) : 0;
            log_work += step;
            floor.observe(16 * std::exp(log_work + 0.02 * uniform(seed, i)), step, 16);
            ASSERT_FALSE(floor.is_found()) << "seed " << seed << ", time " << i;
        }
    }
}

TEST(Floor, IsFoundBySlowTimesThatWereMultiplesOfIt) {
    for (const double jitter : {0.0, 0.01, 0.03}) {
        Floor floor;
        for (int i = 0; i < 24; ++i) floor.observe((i < 4 ? 2 : 1) * 16 + jittered(16, jitter, 3, i), 0, 16.001);
        ASSERT_TRUE(floor.is_found()) << jitter;
        EXPECT_FALSE(floor.is_deaf());
        EXPECT_NEAR(floor.period_ms(), 16, 0.1);
    }
    Floor floor;
    for (int i = 0; i < 24; ++i) floor.observe(i < 4 ? 1.6 * 16 : 16, 0, 16.001);
    EXPECT_FALSE(floor.is_found()) << "times between";
}

// A load that doubles for a few frames, or stays so.
TEST(Floor, IsNotFoundByLateTimesThatCameLast) {
    Floor floor;
    for (int i = 0; i < 40; ++i) {
        floor.observe(i < 20 ? 16 : 32, 0, 17);
        ASSERT_FALSE(floor.is_found()) << i;
    }
}

// Nothing moves, no frame is ever late: only that each time gives back what the one before took.
TEST(Floor, IsFoundByStampsThatJitter) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Floor stamps, noise;
        for (int i = 0; i < 600; ++i) {
            stamps.observe(7 + jittered(7, 0.02, seed, i), 0, 7);
            noise.observe(7 * (1 + 0.03 * uniform(seed, i)), 0, 7);
            ASSERT_FALSE(noise.is_found()) << "seed " << seed << ", time " << i;
        }
        EXPECT_TRUE(stamps.is_found()) << "seed " << seed;
    }
}

Floor found_at(double ms) {
    Floor floor;
    for (int i = 0; i < 60 && !floor.is_found(); ++i) floor.observe(ms, i % 4 == 0 ? -0.04 : 0, 0.95 * ms);
    return floor;
}

// 144 Hz: no frame was faster than two refreshes.
TEST(Floor, APeriodMayBeAPartOfIt) {
    const double period_ms = 1000.0 / 144;
    Floor floor = found_at(2 * period_ms);
    ASSERT_EQ(floor.period_ms(), 0);
    for (int i = 0; i < 4; ++i) floor.observe(3 * period_ms, 0, 17);
    EXPECT_NEAR(floor.period_ms(), period_ms, 1e-6);
    EXPECT_NEAR(floor.due_ms(17), 2 * period_ms, 1e-6);
    EXPECT_NEAR(floor.due_ms(21), 3 * period_ms, 1e-6);
}

TEST(Floor, TimesBetweenMultiplesAreNoDisplays) {
    Floor floor = found_at(16);
    for (int i = 0; i < 4; ++i) floor.observe(32, 0, 16);
    ASSERT_EQ(floor.period_ms(), 16);
    for (int i = 0; i < 4; ++i) floor.observe(27, 0, 16);
    EXPECT_EQ(floor.period_ms(), 0);
}

TEST(Floor, ATargetJustBelowARefreshIsTheRefresh) {
    for (const double hz : refreshes_hz) {
        const double period_ms = 1000 / hz;
        Floor floor = found_at(period_ms);
        for (int i = 0; i < 4; ++i) floor.observe(2 * period_ms, 0, period_ms);
        EXPECT_NEAR(floor.due_ms(0.96 * period_ms), period_ms, 1e-9);
        EXPECT_NEAR(floor.due_ms(1.02 * period_ms), period_ms, 1e-9);
        EXPECT_NEAR(floor.due_ms(1.9 * period_ms), period_ms, 1e-9) << "not just below the second";
        EXPECT_NEAR(floor.due_ms(1.96 * period_ms), 2 * period_ms, 1e-9);
    }
}

TEST(Floor, TwoTimesBelowEndItAndTheNextWaitsTwiceAsLong) {
    Floor floor;
    int before = 0;
    for (int round = 0; round < 4; ++round) {
        int times = 0;
        for (; times < 1000 && !floor.is_found(); ++times) floor.observe(16, times % 4 == 0 ? -0.04 : 0, 15);
        ASSERT_TRUE(floor.is_found());
        if (round > 1) {
            EXPECT_GT(times, 1.4 * before);
        }
        before = times;
        floor.observe(12, 0, 15);
        ASSERT_TRUE(floor.is_found()) << "one may be an accident";
        floor.observe(12, 0, 15);
        ASSERT_FALSE(floor.is_found());
    }
}

TEST(Floor, IsForgottenWhereNothingWaitsAnyMore) {
    Floor floor = found_at(16);
    for (int i = 0; i < 70; ++i) floor.observe(21.3, 0, 16);
    EXPECT_FALSE(floor.is_found());
}

}  // namespace
}  // namespace sfsm
