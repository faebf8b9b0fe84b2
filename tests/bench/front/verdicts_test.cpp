#include "tests/bench/front/verdicts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sfsm/controller.h"
#include "tests/bench/front/before_rates.h"
#include "tests/bench/front/made_up.h"
#include "tests/bench/front/tables.h"

namespace {

using namespace bench::front;

const std::string rates = "native rates";

Row row(const std::string& family, double ms, double flip) {
    Row one;
    one.people = 20'000;
    one.view = "still";
    one.is_preset = true;
    one.family = family;
    one.setting = "at " + std::to_string(ms);
    one.wall_ms = ms;
    one.frame.flip = flip;
    return one;
}

Row choice(double target_ms, double ms, double flip, std::string_view law = sfsm::law_names().front()) {
    Row one = row(rates, ms, flip);
    one.law = law;
    one.target_ms = target_ms;
    return one;
}

Verdicts verdicts(const std::vector<Row>& rows) {
    return verdicts_of(scenes_of({{}, rows}));
}

TEST(FrontVerdicts, BetweenSettingsTheFrontIsStraightInTheTimesLogarithm) {
    const std::vector<Row> rows{row(rates, 40, 0.01), row(rates, 10, 0.03), row("other", 5, 0.001),
                                row(rates, 20, 0.5),  // beaten: no part of the front
                                choice(20, 15, 0)};   // nor is what a law chose
    EXPECT_FALSE(least_flip(rows, {rates}, 9.99));
    EXPECT_DOUBLE_EQ(*least_flip(rows, {rates}, 10), 0.03);
    EXPECT_DOUBLE_EQ(*least_flip(rows, {rates}, 20), 0.02);
    EXPECT_NEAR(*least_flip(rows, {rates}, 14.142135623730951), 0.025, 1e-12);
    EXPECT_DOUBLE_EQ(*least_flip(rows, {rates}, 40), 0.01);
    EXPECT_DOUBLE_EQ(*least_flip(rows, {rates}, 1000), 0.01);
    EXPECT_DOUBLE_EQ(*least_flip(rows, {rates, "other"}, 7), 0.001);
    EXPECT_FALSE(least_flip(rows, {"none"}, 1000));
}

TEST(FrontVerdicts, AChoiceIsHeldAgainstRatesRivalsAndWhatItWasBefore) {
    const auto found = verdicts({row(rates, 10, 0.03), row(rates, 40, 0.01), row("rival: by size", 10, 0.05),
                                 row("rival: by size", 30, 0.02), row("native points", 16, 0.025),
                                 row("native mixture", 12, 0.04), choice(16.6, 20, 0.022),
                                 choice(16.6, 17, 0.044, law_before_rates), choice(8, 9, 0.001, law_before_rates)});
    ASSERT_EQ(found.rivals.size(), 2u);
    EXPECT_EQ(found.rivals[1].name, "by size");
    ASSERT_EQ(found.cases.size(), 1u);
    const Case& one = found.cases[0];
    EXPECT_EQ(one.name(), "20,000 people, still, 16.6 ms");
    EXPECT_NEAR(*one.over_rates, 0.022 / 0.02, 1e-12);
    const double in_17_ms = 0.03 - 0.02 * std::log(1.7) / std::log(4);  // what rates have there, where it was
    EXPECT_NEAR(*one.over_before, 0.5 * in_17_ms / 0.02, 1e-12);
    EXPECT_TRUE(one.finest_fits);  // what was chosen before rates at 8 ms is as fast as 16.6 ms
    EXPECT_FALSE(one.over_rivals[0]);
}

TEST(FrontVerdicts, WhereTheFinestDoesNotFitRivalsAreAskedForWhatTheyLeaveBeyondIt) {
    const auto found =
        verdicts({row("native triangles", 50, 0.01), row("rival: by size", 10, 0.05), row("rival: by size", 40, 0.03),
                  row("rival: slow", 25, 0.02), row("native points", 16, 0.01), choice(12, 20, 0.02)});
    const Case& one = found.cases.at(0);
    EXPECT_FALSE(one.finest_fits);
    ASSERT_EQ(one.over_rivals.size(), 3u);
    EXPECT_EQ(*one.over_rivals[0], std::numeric_limits<double>::infinity());  // as fine as the finest
    EXPECT_NEAR(*one.over_rivals[1], 0.01 / 0.03, 1e-12);
    EXPECT_FALSE(one.over_rivals[2]);  // not as fast
    EXPECT_FALSE(one.over_rates);
    EXPECT_FALSE(one.over_before);
    EXPECT_TRUE(verdicts({row("native points", 16, 0.01), choice(17, 20, 0.02)}).cases.at(0).finest_fits);
}

TEST(FrontVerdicts, AsFineAsTheFinestBothIsAsGood) {
    const auto found = verdicts({row("native points", 16, 0.01), choice(12, 20, 0.01)});
    EXPECT_EQ(*found.cases.at(0).over_rivals.at(0), 1);
}

TEST(FrontVerdicts, WhatFlickersAlongThePathIsSummedOverPairs) {
    const auto along = [](std::string_view law, double target_ms, double change) {
        Row one = choice(target_ms, target_ms, 0.02, law);
        one.view = "roam-4s";
        one.is_preset = false;
        one.change = change;
        return one;
    };
    const auto found = verdicts({along("predictive", 33, 1), along("predictive", 16.6, 2), along("predictive", 8, 100),
                                 along(law_by_knobs, 33, 3), along(law_by_knobs, 16.6, 5)});
    EXPECT_EQ(found.flicker.pairs, 2);
    EXPECT_EQ(found.flicker.by_rates, 3);
    EXPECT_EQ(found.flicker.by_knobs, 8);
    EXPECT_TRUE(found.cases.empty());  // presets alone are judged by what was chosen there
}

TEST(FrontVerdicts, SummariesNameTheWorstAndCountWhatCouldNotBeCompared) {
    const auto found =
        verdicts({row(rates, 10, 0.02), row("native triangles", 200, 0.01), choice(4, 5, 0.1), choice(8, 10, 0.03),
                  choice(16.6, 16, 0.05), choice(33, 30, 0.02), choice(300, 30, 0.02)});
    const std::vector<Summary> all = summaries(found);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].of, 5u);
    EXPECT_EQ(all[0].cases, 4u);
    EXPECT_NEAR(all[0].median, 1.5, 1e-12);  // of 1, 1, 1.5 and 2.5, the upper of the two in the middle
    EXPECT_NEAR(all[0].worst, 2.5, 1e-12);
    EXPECT_EQ(all[0].worst_of, "20,000 people, still, 16.6 ms");
    EXPECT_EQ(all[1].of, 4u);  // the finest fits in 300 ms
    EXPECT_EQ(all[1].cases, 0u);
    EXPECT_EQ(all[2].cases, 0u);
}

// By the closed form for ranks without ties, of values in any order.
TEST(FrontVerdicts, RanksCorrelateAsSpearmanSays) {
    std::mt19937 bits(7);
    constexpr std::size_t count = 40;
    std::vector<double> a, b;
    for (std::size_t i = 0; i < count; ++i) {
        a.push_back(static_cast<double>(bits()));
        b.push_back(a.back() * 0.5 + static_cast<double>(bits()));
    }
    const auto rank = [](const std::vector<double>& of, double value) {
        return static_cast<double>(std::ranges::count_if(of, [&](double other) { return other < value; }));
    };
    double squares = 0;
    for (std::size_t i = 0; i < count; ++i) squares += std::pow(rank(a, a[i]) - rank(b, b[i]), 2);
    constexpr double n = count;
    EXPECT_NEAR(rank_correlation(a, b), 1 - 6 * squares / (n * (n * n - 1)), 1e-12);
    EXPECT_NEAR(rank_correlation({1, 2, 3}, {8, 70, 900}), 1, 1e-12);
    EXPECT_NEAR(rank_correlation({1, 2, 3}, {3, 2, 1}), -1, 1e-12);
    EXPECT_NEAR(rank_correlation({1, 1, 2}, {1, 2, 3}), std::sqrt(0.75), 1e-12);  // ranks 0.5, 0.5, 2
    EXPECT_EQ(rank_correlation({1, 2, 3}, {5, 5, 5}), 0);
    EXPECT_EQ(rank_correlation({}, {}), 0);
}

TEST(FrontVerdicts, ExpectationsAreOfRatesAndChoicesThatHaveOne) {
    std::vector<Row> rows{row(rates, 10, 0.02), row(rates, 20, 0.04), row("native points", 5, 0.01),
                          choice(8, 9, 0.05, "paper"), choice(4, 9, 0.06, "paper")};
    rows[0].expected_flip = 0.025;
    rows[1].expected_flip = 0.02;  // half
    rows[2].expected_flip = 9;     // not asked
    rows[3].expected_flip = 0.051;
    const Expectation found = verdicts(rows).expectation;
    EXPECT_EQ(found.rows, 3u);
    EXPECT_NEAR(found.worst, 0.5, 1e-12);
    EXPECT_NE(found.worst_of.find("20,000 people, still, native rates"), std::string::npos);
    EXPECT_NEAR(found.rank_correlation, 0.5, 1e-12);  // 1, 0, 2 against 0, 1, 2
}

TEST(FrontVerdicts, AreTextAndTables) {
    const Verdicts found = verdicts_of(scenes_of(made_up_front()));
    const std::string text = verdicts_text(found), tables = verdict_tables(found);
    EXPECT_EQ(std::ranges::count(text, '\n'), static_cast<std::ptrdiff_t>(summaries(found).size()) + 1);
    for (const Summary& summary : summaries(found)) {
        EXPECT_GT(summary.cases, 0u) << summary.what;
        EXPECT_NE(text.find(summary.what + ": "), std::string::npos);
        EXPECT_NE(tables.find(summary.worst_of), std::string::npos);
    }
    for (const Case& one : found.cases) EXPECT_NE(tables.find(one.name()), std::string::npos);
    EXPECT_EQ(verdict_tables(verdicts({row(rates, 1, 0.1)})).find("<table"), std::string::npos);
}

TEST(FrontVerdicts, RowsThatAreNoNumbersTakeNoPart) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto found = verdicts(
        {row(rates, 10, nan), row(rates, nan, 0.01), choice(8, nan, 0.02), choice(16, 5, nan), choice(33, 20, 0.02)});
    ASSERT_EQ(found.cases.size(), 1u);
    EXPECT_FALSE(found.cases[0].over_rates);
}

}  // namespace
