// The scene's time: one tick a frame, or as many as the seconds it was told make; whatever the seconds were.
#include "apps/scene_clock.h"

#include <gtest/gtest.h>

#include <chrono>

namespace apps {
namespace {

TEST(SceneClock, OfFixedStepsAdvancesATickAFrame) {
    SceneClock clock(true);
    EXPECT_EQ(clock.tick(), 0);
    for (int frame = 1; frame <= 200; ++frame) {
        EXPECT_EQ(clock.advance(), 1.0 / 60);
        EXPECT_EQ(clock.tick(), frame);
        EXPECT_EQ(clock.seconds(), frame / 60.0);
    }
}

TEST(SceneClock, StandsWhileItIsPausedAndGoesOnFromThere) {
    for (const bool is_fixed : {true, false}) {
        SceneClock clock(is_fixed);
        for (int frame = 0; frame < 10; ++frame) clock.advance();
        const std::int64_t tick = clock.tick();
        clock.paused = true;
        for (int frame = 0; frame < 100; ++frame) EXPECT_GE(clock.advance(), 0) << "cameras fly on";
        EXPECT_EQ(clock.tick(), tick);
        clock.paused = false;
        clock.advance();
        EXPECT_LE(clock.tick(), is_fixed ? tick + 1 : tick + 60) << "the pause is not made up for";
    }
}

// However long the frames were: ticks are the whole sixtieths of all seconds so far, so none is lost between frames.
TEST(SceneClock, OfTheWallLosesNoPartOfATick) {
    SceneClock clock(false);
    constexpr double enough = 0.1;              // [s] six ticks, of frames much shorter than one
    constexpr int most_frames = 1'000'000'000;  // if no time is ever told
    double seconds = 0;
    for (int frame = 0; seconds < enough; ++frame) {
        ASSERT_LT(frame, most_frames);
        seconds += clock.advance();
        constexpr double rounding = 1e-6;  // [ticks] of as many additions
        ASSERT_LE(static_cast<double>(clock.tick()), 60 * seconds + rounding);
        ASSERT_GT(static_cast<double>(clock.tick()), 60 * seconds - 1 - rounding);
    }
}

// A pause is told in parts as the frames pass, and no part twice: what is told is never more than has passed.
TEST(SceneClock, TellsTheSecondsOfAPauseOnce) {
    const auto begin = std::chrono::steady_clock::now();
    SceneClock clock(false);
    clock.paused = true;
    double told = 0;
    for (int frame = 0; frame < 20'000; ++frame) told += clock.advance();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    constexpr double rounding = 1e-9;  // [s] of as many additions
    EXPECT_LE(told, passed.count() + rounding);
}

}  // namespace
}  // namespace apps
