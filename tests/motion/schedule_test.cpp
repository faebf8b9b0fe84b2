#include "motion/schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Schedule, PeriodNeverFallsWithDepthAndStaysInRange) {
    for (const float theta : {0.05f, motion::default_theta, 0.1f}) {
        for (const float distance : {-10.0f, 0.0f, 30.0f, 150.0f}) {
            int before = 1;
            for (float depth = -50.0f; depth < 900.0f; depth += 0.37f) {
                const int period = motion::update_period(depth, distance, theta);
                ASSERT_GE(period, before) << depth;
                ASSERT_LE(period, motion::max_period);
                if (depth <= distance) {
                    ASSERT_EQ(period, 1);
                }
                before = period;
            }
            ASSERT_EQ(before, motion::max_period);
        }
    }
}

TEST(Schedule, PeriodIsEquationOne) {
    // theta = 1/16 is exact in binary, and so is (d - D) * theta.
    EXPECT_EQ(motion::update_period(100.0f, 100.0f, 0.0625f), 1);
    EXPECT_EQ(motion::update_period(100.5f, 100.0f, 0.0625f), 1);
    EXPECT_EQ(motion::update_period(131.5f, 100.0f, 0.0625f), 1);
    EXPECT_EQ(motion::update_period(132.0f, 100.0f, 0.0625f), 2);
    EXPECT_EQ(motion::update_period(148.0f, 100.0f, 0.0625f), 3);
}

TEST(Schedule, ThetaIsThePapersUnlessSaid) {
    EXPECT_GE(motion::default_theta, 0.05f);  // [1/m] Lyu et al. 2018, equation 1
    EXPECT_LE(motion::default_theta, 0.1f);
    for (float depth = 0; depth < 500; depth += 1.7f)
        ASSERT_EQ(motion::update_period(depth, 40), motion::update_period(depth, 40, motion::default_theta));
}

TEST(Schedule, NobodyWaitsMuchLongerThanHalfASecond) {
    EXPECT_LE(motion::max_period, 0.6 * motion::ticks_per_second);
    EXPECT_EQ(motion::update_period(1e6f, 0), motion::max_period);
    // The last whole period below it is reached as well.
    EXPECT_EQ(motion::update_period(16.0f * (motion::max_period - 1), 0, 0.0625f), motion::max_period - 1);
    EXPECT_EQ(motion::update_period(16.0f * motion::max_period - 0.5f, 0, 0.0625f), motion::max_period - 1);
}

TEST(Schedule, PeriodIsDefinedForWhatIsNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(motion::update_period(nan, 10.0f), 1);
    EXPECT_EQ(motion::update_period(10.0f, nan), 1);
    EXPECT_EQ(motion::update_period(10.0f, infinity), 1);
    EXPECT_EQ(motion::update_period(infinity, infinity), 1);
    EXPECT_EQ(motion::update_period(infinity, 10.0f), motion::max_period);
}

TEST(Schedule, DueTickIsTheLatestOfItsRow) {
    for (int period = 1; period <= motion::max_period; ++period) {
        for (const std::uint32_t stagger : {0u, 1u, 7u, 31u, 0x80000001u, 0xffffffffu}) {
            for (std::int64_t tick = -70; tick < 70; ++tick) {
                const std::int64_t due = motion::due_tick(tick, period, stagger);
                ASSERT_LE(due, tick);
                ASSERT_GT(due, tick - period);
                ASSERT_EQ(motion::due_tick(due, period, stagger), due);  // being due is a fixed point
                ASSERT_EQ(motion::due_tick(due + period - 1, period, stagger), due);
                ASSERT_EQ(motion::due_tick(due + period, period, stagger), due + period);
            }
        }
    }
}

TEST(Schedule, EveryTickMovesAnEvenShareOfThePeople) {
    for (const int period : {1, 2, 5, 16, 31, 32}) {
        const int people = 40 * period;
        for (std::int64_t tick = 1000; tick < 1000 + 2 * period; ++tick) {
            int due = 0;
            for (int person = 0; person < people; ++person)
                due += motion::due_tick(tick, period, static_cast<std::uint32_t>(person)) == tick;
            ASSERT_EQ(due, 40) << "period " << period << " tick " << tick;
        }
    }
}

TEST(Schedule, HashedStaggersSpreadLikeThrowingDice) {
    // Chi-squared of 32 bins: mean 31, standard deviation 7.9; 80 is six of them away.
    constexpr int people = 20'000, period = 32;
    std::map<std::int64_t, int> bins;
    std::uint32_t hash = 1;
    for (int person = 0; person < people; ++person) {
        hash = hash * 1664525u + 1013904223u;
        bins[motion::due_tick(5000, period, (hash >> 16) * 0x9e3779b1u >> 8)]++;
    }
    double chi_squared = 0;
    for (const auto& [tick, count] : bins) chi_squared += std::pow(count - people / 32.0, 2) / (people / 32.0);
    EXPECT_EQ(bins.size(), 32u);
    EXPECT_LT(chi_squared, 80);
}

}  // namespace
