#include "sfsm/replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sfsm/paper.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

// A run through all states with noise, as stadium would record it.
std::vector<TraceRow> recorded(int delay) {
    auto random = std::make_shared<std::mt19937_64>(9);
    const Plant plant{600, 300, 35, 393};
    const Time time = [=](std::int64_t, const Decision& d) {
        return plant.time(d, test_range) * (1 + 0.03 * uniform(*random, -1, 1));
    };
    const Target target = [](std::int64_t frame) { return frame < 30 ? 1000.0 : frame < 100 ? 300.0 : 95.0; };
    PaperLaw law;
    return run(law, {time, target, 300, delay});
}

TEST(Replay, ReproducesARecordedRunToTheBitAtItsOwnDelayOnly) {
    for (int delay = 0; delay <= 4; ++delay) {
        const auto rows = recorded(delay);
        PaperLaw law;
        EXPECT_FALSE(first_difference(rows, replay(law, rows, delay))) << "delay " << delay;
        PaperLaw other;
        EXPECT_TRUE(first_difference(rows, replay(other, rows, delay + 1))) << "delay " << delay;
    }
}

TEST(Replay, NamesTheFirstFrameAndFieldThatDiffer) {
    const auto rows = recorded(1);
    for (const std::size_t frame : {std::size_t{120}, rows.size() - 1}) {
        auto changed = rows;
        changed[frame].decision.splat_size = std::nextafter(changed[frame].decision.splat_size, 0.0);
        PaperLaw law;
        const auto difference = first_difference(changed, replay(law, changed, 1));
        ASSERT_TRUE(difference);
        EXPECT_EQ(difference->frame, rows[frame].frame);
        EXPECT_EQ(difference->field, "splat_px");
        EXPECT_EQ(difference->recorded, changed[frame].decision.splat_size);
        EXPECT_EQ(difference->decided, rows[frame].decision.splat_size);
    }
}

TEST(Replay, ADifferentTimeIsFoundOut) {
    auto rows = recorded(0);
    rows[40].frame_ms = rows[40].target_ms / 4;
    PaperLaw law;
    const auto difference = first_difference(rows, replay(law, rows, 0));
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->frame, 41);
}

TEST(Replay, FramesWithoutATimeAreNotObserved) {
    auto rows = recorded(0);
    for (TraceRow& row : rows) row.frame_ms = std::numeric_limits<double>::quiet_NaN();
    PaperLaw law;
    for (const Replayed& frame : replay(law, rows, 0)) EXPECT_EQ(frame.decision, Decision{});
    EXPECT_EQ(law.status().bad_samples, 0);
}

// As of recordings that keep no rows: one row for all, made anew.
TEST(Replay, RowsMayBeMadeAsTheyAreAskedFor) {
    const auto rows = recorded(2);
    const RunRows made{rows.size(), [&rows, row = TraceRow()](std::size_t i) mutable -> const TraceRow& {
                           row = rows[i];
                           return row;
                       }};
    PaperLaw law;
    EXPECT_FALSE(first_difference(rows, replay(law, made, 2)));
}

TEST(Replay, OpenLoopTheLawStillMoves) {
    auto rows = recorded(2);
    for (TraceRow& row : rows) row.decision = {};  // as if everything had been forced to state 0
    PaperLaw law;
    EXPECT_EQ(replay(law, rows, 2).back().decision.state, State::points);
}

TEST(Replay, DelayIsASmallWholeNumberOrAbsent) {
    EXPECT_EQ(trace_delay({}), 0);
    EXPECT_EQ(trace_delay({{{"delay", "3"}}, {}}), 3);
    for (const char* text : {"", "-1", "17", "1.5", "two"}) {
        EXPECT_THROW(trace_delay({{{"delay", text}}, {}}), std::runtime_error) << text;
    }
}

TEST(Replay, DrawingIsOneThatThereIsOrOpenGL) {
    EXPECT_EQ(trace_drawing({}), Drawing::opengl);
    EXPECT_EQ(trace_drawing({{{"draw", "gl"}}, {}}), Drawing::opengl);
    EXPECT_EQ(trace_drawing({{{"draw", "native"}}, {}}), Drawing::native);
    for (const char* text : {"", "opengl", "Native", "vulkan"})
        EXPECT_THROW(trace_drawing({{{"draw", text}}, {}}), std::runtime_error) << text;
}

}  // namespace
}  // namespace sfsm
