// Each erratum of the paper: the printed form fails, the corrected one holds. And the equations it has right.
#include <gtest/gtest.h>

#include <cmath>

#include "sfsm/paper.h"
#include "sfsm/target.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr double L = 200;          // [m]
constexpr double rounding = 1e-9;  // relative: a few operations in double

// Printed forms.
bool printed_misses_expected_rate(double ms, double target_ms) {
    return ms < target_ms;
}

double printed_eq2(const Learned& newer, const Learned& older, double t) {
    const double chord = newer.ms - older.ms;
    return (t - newer.ms) / chord * newer.distance - (t - older.ms) / chord * older.distance;
}

double printed_text_distance(int i) {
    return i <= 1 ? L : 5.0 / 6 * L;
}  // "D_1 size is L", "D_2 is 5/6 L"

// A linear renderer [ms].
double linear_time(double distance) {
    return 40 + 0.8 * distance;
}

Learned learned_at(double distance) {
    return {distance, linear_time(distance)};
}

TEST(PaperErrata, E1SlowMeansOverTheTarget) {
    EXPECT_TRUE(is_slow(200, 100));
    EXPECT_FALSE(is_slow(50, 100));
    EXPECT_FALSE(is_slow(100, 100));
    EXPECT_FALSE(printed_misses_expected_rate(200, 100)) << "printed: 200 ms against 100 ms would be fast enough";
    EXPECT_TRUE(printed_misses_expected_rate(50, 100)) << "printed: 50 ms against 100 ms would be too slow";
}

TEST(PaperErrata, E2WeightsSumToOneAndNotToMinusOne) {
    const Learned newer{123, 80}, older{123, 110};  // equal distances: only the weights' sum counts
    EXPECT_NEAR(secant_distance(newer, older, 95), 123, 123 * rounding);
    EXPECT_NEAR(printed_eq2(newer, older, 95), -123, 123 * rounding);
}

TEST(PaperErrata, E2SecantSolvesALinearRendererAndThePrintedFormDoesNot) {
    const double target = 150;
    const Learned newer = learned_at(5.0 / 6 * L), older = learned_at(L);
    EXPECT_NEAR(linear_time(secant_distance(newer, older, target)), target, target * rounding);
    EXPECT_GT(std::abs(linear_time(printed_eq2(newer, older, target)) - target), 0.5 * target);
}

TEST(PaperErrata, E3CountingFromZeroGivesTheSecantAChord) {
    const double d0 = first_distance(0, L, 5.0 / 6), d1 = first_distance(1, L, 5.0 / 6);
    EXPECT_EQ(d0, L);
    EXPECT_EQ(d1, 5.0 / 6 * L);
    EXPECT_TRUE(std::isfinite(secant_step(learned_at(d1), learned_at(d0), 150)));
    // Frames that count from 0 and take D_1 from the text draw D = L twice.
    EXPECT_FALSE(
        std::isfinite(secant_step(learned_at(printed_text_distance(1)), learned_at(printed_text_distance(0)), 150)));
}

// Figure 6: targets 1000, 300 from frame 30, 95 from frame 100. The text says that the time "remains between 300 ms
// and 310 ms after the 100th frame"; it can only mean the target's 95 +- 10 ms.
TEST(PaperErrata, E4AfterFrame100TheTimeIsNear95) {
    constexpr std::int64_t settled = 120;
    constexpr double band = 10;            // [ms], the paper's
    const Plant plant{600, 300, 35, 393};  // 900 ms as it is; splats of 7.5 and 6 px lie on either side of 95 ms
    const TargetSchedule targets = TargetSchedule::parse("1000,300@30,95@100");
    PaperLaw law;
    const auto rows = run(law, {exact(plant), [&](std::int64_t frame) { return targets.at(frame); }, 400});
    for (const TraceRow& row : rows) {
        if (row.frame < settled) continue;
        EXPECT_NEAR(row.frame_ms, 95, band) << "frame " << row.frame;
        EXPECT_FALSE(row.frame_ms >= 300 && row.frame_ms <= 310) << "the printed interval, frame " << row.frame;
    }
}

TEST(PaperEquations, Eq4IsEq3AddedToTheLastDistance) {
    const Learned newer{160, 130}, older{200, 180};
    EXPECT_EQ(secant_step(newer, older, 100), (160.0 - 200) * (100 - 130) / (130.0 - 180));
    EXPECT_EQ(secant_distance(newer, older, 100), newer.distance + secant_step(newer, older, 100));
}

TEST(PaperEquations, Eq6IsTheMiddleOfTheLastTwoAndElevenTwelfthsAtI2) {
    EXPECT_NEAR(over_learning_distance(120, 180), 150, 150 * rounding);
    EXPECT_NEAR(over_learning_distance(5.0 / 6 * L, L), 11.0 / 12 * L, L * rounding);
    EXPECT_EQ(over_learning_step(-20), 10);
}

TEST(PaperEquations, StepsAreNeverShorterThanHAndKeepTheirSign) {
    EXPECT_EQ(floored_step(-3, 15), -15);
    EXPECT_EQ(floored_step(3, 15), 15);
    EXPECT_EQ(floored_step(-40, 15), -40);
    EXPECT_EQ(floored_step(40, 15), 40);
}

TEST(PaperEquations, Eq7IsARelay) {
    EXPECT_EQ(next_splat_size(3, 101, 100, 1.5), 4.5);
    EXPECT_EQ(next_splat_size(3, 99, 100, 1.5), 1.5);
    EXPECT_EQ(next_splat_size(3, 100, 100, 1.5), 3);
}

TEST(PaperConstants, BrokenRulesAreNamed) {
    const auto message = [](auto change) -> std::string {
        PaperConstants constants;
        change(constants);
        try {
            constants.validate();
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "no rule broken";
    };
    EXPECT_EQ(message([](PaperConstants&) {}), "no rule broken");
    EXPECT_NE(message([](PaperConstants& c) { c.h = 9; }).find("h in [10, 20]"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.tau = 2; }).find("tau in (1, 2)"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.tau = NAN; }).find("tau in (1, 2)"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.first_share = 0.5; }).find("first_share"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.nearest_share = 0.7; }).find("nearest_share"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.return_margin = 1; }).find("return_margin"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.far_margin = -1; }).find("far_margin"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.first_patience = 0; }).find("first_patience"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.max_patience = 2; }).find("max_patience"), std::string::npos);
    EXPECT_NE(message([](PaperConstants& c) { c.trial = 0; }).find("trial"), std::string::npos);
    PaperConstants broken;
    broken.h = 0;
    EXPECT_THROW(PaperLaw{broken}, std::invalid_argument);
}

}  // namespace
}  // namespace sfsm
