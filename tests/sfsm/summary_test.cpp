#include "sfsm/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sfsm {
namespace {

constexpr double rounding = 1e-12;  // a handful of additions of values near 1

TraceRow row(double ms, double target, State state = State::original) {
    TraceRow row;
    row.target_ms = target;
    row.frame_ms = ms;
    row.decision.state = state;
    return row;
}

TEST(Summary, MatchesFiguresWorkedOutByHand) {
    const std::vector<TraceRow> rows = {row(100, 100), row(104, 100, State::slowed), row(108, 100, State::points),
                                        row(92, 100, State::points), row(250, 100, State::points)};
    const Summary summary = summarize(rows);
    EXPECT_EQ(summary.frames, 5);
    EXPECT_EQ(summary.target_ms, 100);
    EXPECT_NEAR(summary.mean_ms, 654.0 / 5, 1e-9);
    EXPECT_EQ(summary.p50_ms, 104);
    EXPECT_EQ(summary.p99_ms, 250);
    EXPECT_NEAR(summary.control_rate, (1 + 0.96 + 0.92 + 0.92 + 0) / 5, rounding);
    EXPECT_NEAR(summary.within_5pct, 2.0 / 5, rounding);
    EXPECT_NEAR(summary.within_10pct, 4.0 / 5, rounding);
    EXPECT_NEAR(summary.over_5pct, 2.0 / 5, rounding);
    EXPECT_EQ(summary.state_frames, (std::array<std::int64_t, 3>{1, 1, 3}));
}

TEST(Summary, EachFrameIsHeldAgainstItsOwnTarget) {
    const std::vector<TraceRow> rows = {row(1000, 1000), row(300, 300), row(95, 95)};
    const Summary summary = summarize(rows);
    EXPECT_EQ(summary.target_ms, 95);
    EXPECT_EQ(summary.control_rate, 1);
    EXPECT_EQ(summary.within_5pct, 1);
}

TEST(Summary, FivePercentOverIsWithinAndNotOver) {
    for (const double target : {16.6, 33.3, 95.0, 100.0, 300.0}) {
        const std::vector<TraceRow> rows = {row(1.05 * target, target), row(1.2 * target, target)};
        const Summary summary = summarize(rows);
        EXPECT_LE(summary.within_5pct + summary.over_5pct, 1) << "no frame is both";
        EXPECT_EQ(summary.over_5pct + summary.within_5pct, 1) << "and over the target, none is neither";
    }
}

TEST(Summary, UnmeasuredFramesDoNotCount) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<TraceRow> rows = {row(50, 100), row(nan, 200), row(std::numeric_limits<double>::infinity(), 100),
                                        row(50, nan), row(50, 0)};
    const Summary summary = summarize(rows);
    EXPECT_EQ(summary.frames, 1);
    EXPECT_EQ(summary.target_ms, 100);
    EXPECT_EQ(summary.mean_ms, 50);
    EXPECT_EQ(summary.state_frames[0], 1);
}

TEST(Summary, OfNothingIsZeros) {
    const Summary summary = summarize({});
    EXPECT_EQ(summary.frames, 0);
    EXPECT_EQ(summary.p99_ms, 0);
    EXPECT_EQ(summary.control_rate, 0);
}

TEST(Summary, PercentilesAreNearestRankWhateverTheOrder) {
    std::vector<TraceRow> rows;
    for (int i = 0; i < 200; ++i) rows.push_back(row((i * 77) % 200 + 1, 100));  // 77 and 200 share no factor: 1..200
    const Summary summary = summarize(rows);
    EXPECT_EQ(summary.p50_ms, 100);
    EXPECT_EQ(summary.p99_ms, 198);
    EXPECT_EQ(summarize({rows.data(), 1}).p50_ms, rows[0].frame_ms);
}

TEST(Summary, SaysTheLargestErrorAndTheMeanFlipOfFramesThatPromised) {
    std::vector<TraceRow> rows = {row(100, 100), row(120, 100), row(90, 100)};
    rows[0].max_motion_error_px = 2, rows[0].max_splat_error_px = 0.5, rows[0].predicted_flip = 0.02;
    rows[2].max_motion_error_px = 1, rows[2].max_splat_error_px = 3, rows[2].predicted_flip = 0.04;
    rows[1].predicted_ms = 106;
    rows[2].predicted_ms = 104;
    const Summary summary = summarize(rows);
    EXPECT_EQ(summary.max_motion_error_px, 2);
    EXPECT_EQ(summary.max_splat_error_px, 3);
    EXPECT_DOUBLE_EQ(summary.predicted_flip, 0.03);
    EXPECT_EQ(summary.worst_predicted_flip, 0.04);
    EXPECT_EQ(summary.out_of_reach_frames, 1);
    EXPECT_TRUE(std::isnan(summarize({&rows[1], 1}).predicted_flip));
}

TEST(SummaryJson, HasEveryFieldOfTheContract) {
    const std::vector<TraceRow> rows = {row(100, 100), row(120, 100, State::points)};
    const std::string json = summary_json(
        summarize(rows),
        {{"people", "20000"}, {"law", "paper"}, {"seed", "18446744073709551615"}, {"device", "a \"b\" \\ \t"}},
        std::vector<std::string>{"a.glb: \"gone\"", "b"});
    EXPECT_EQ(json,
              "{\n"
              "  \"people\": 20000,\n"
              "  \"frames\": 2,\n"
              "  \"law\": \"paper\",\n"
              "  \"seed\": 18446744073709551615,\n"
              "  \"device\": \"a \\\"b\\\" \\\\ \\u0009\",\n"
              "  \"target_ms\": 100,\n"
              "  \"mean_ms\": 110,\n"
              "  \"p50_ms\": 100,\n"
              "  \"p99_ms\": 120,\n"
              "  \"control_rate\": 0.9,\n"
              "  \"within_5pct\": 0.5,\n"
              "  \"within_10pct\": 0.5,\n"
              "  \"over_5pct\": 0.5,\n"
              "  \"max_motion_error_px\": null,\n"
              "  \"max_splat_error_px\": null,\n"
              "  \"predicted_flip\": null,\n"
              "  \"worst_predicted_flip\": null,\n"
              "  \"state_frames\": [1, 0, 1],\n"
              "  \"out_of_reach_frames\": 0,\n"
              "  \"warnings\": [\"a.glb: \\\"gone\\\"\", \"b\"]\n"
              "}\n");
}

TEST(SummaryJson, WhatIsMissingOrNotFiniteIsNull) {
    Summary summary;
    summary.mean_ms = std::numeric_limits<double>::infinity();
    const std::string json = summary_json(summary, {{"seed", "0x5"}}, {});
    EXPECT_NE(json.find("\"people\": null"), std::string::npos) << json;
    EXPECT_NE(json.find("\"mean_ms\": null"), std::string::npos) << json;
    EXPECT_NE(json.find("\"seed\": \"0x5\""), std::string::npos) << json;
}

}  // namespace
}  // namespace sfsm
