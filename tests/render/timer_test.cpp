#include "render/gl/timer.h"

#include <cmath>
#include <vector>

#include "tests/render/gl_test.h"

namespace {

using Timer = tests::GlTest;

render::gl::Device device_that_is(bool software) {
    render::gl::Device device;
    device.software = software;
    return device;
}

std::optional<render::FrameTime> draw_frame(render::gl::FrameTimer& timer, std::int64_t frame) {
    timer.begin(frame);
    timer.submit();
    return timer.end();
}

TEST_F(Timer, ClockGivesEachFramesTimeAtItsEnd) {
    render::gl::FrameTimer timer(device_that_is(true));
    EXPECT_EQ(timer.delay(), 0);
    for (std::int64_t frame = 0; frame < 5; ++frame) {
        const auto time = draw_frame(timer, frame);
        ASSERT_TRUE(time.has_value());
        EXPECT_EQ(time->frame, frame);
        EXPECT_GE(time->frame_ms, time->cpu_ms);
        EXPECT_TRUE(std::isnan(time->gpu_ms));
    }
    EXPECT_FALSE(timer.drain().has_value());
}

TEST_F(Timer, QueriesArriveExactlyTheirDelayLateAndInOrder) {
    render::gl::FrameTimer timer(device_that_is(false));
    ASSERT_GT(timer.delay(), 0);
    std::vector<std::int64_t> arrived;
    for (std::int64_t frame = 0; frame < 10; ++frame) {
        const auto time = draw_frame(timer, frame);
        EXPECT_EQ(time.has_value(), frame >= timer.delay());
        if (!time) continue;
        EXPECT_EQ(time->frame, frame - timer.delay());
        EXPECT_GE(time->frame_ms, time->cpu_ms);
        EXPECT_GE(time->frame_ms, time->gpu_ms);
        arrived.push_back(time->frame);
    }
    while (const auto time = timer.drain()) arrived.push_back(time->frame);
    for (std::int64_t frame = 0; frame < 10; ++frame) EXPECT_EQ(arrived.at(static_cast<std::size_t>(frame)), frame);
}

TEST_F(Timer, NothingIsLeftOfARunOfNoFrames) {
    render::gl::FrameTimer timer(device_that_is(false));
    EXPECT_FALSE(timer.drain().has_value());
}

}  // namespace
