#include "sfsm/simulate/scorecard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sfsm/detail.h"
#include "sfsm/paper.h"
#include "sfsm/rivals/rivals.h"
#include "sfsm/simulate/oracle.h"
#include "sfsm/simulate/scorecard_text.h"

namespace sfsm::simulate {
namespace {

using Made = std::unique_ptr<Controller>;

// The toy's closed form: knows curve and load, and holds the target it is given whatever happens.
class Constant final : public Controller {
public:
    void observe(const FrameSample&) override {}
    Decision decide(const FrameRequest& request) override {
        constexpr double nominal_ms = 1000.0 / 60;
        status_.decision = decision_at((request.target_ms / nominal_ms - 0.3) / 1.2, request.range);
        return status_.decision;
    }
    void reset() override {}
    const Status& status() const override { return status_; }

private:
    Status status_;
};

const Contestant oracle{"oracle", [](const Course& course) -> Made { return std::make_unique<Oracle>(course); }, false};
const Contestant constant{"constant", [](const Course&) -> Made { return std::make_unique<Constant>(); }};
const Contestant paper{"paper", [](const Course&) -> Made { return std::make_unique<PaperLaw>(); }};
const Contestant filament{"filament", [](const Course&) -> Made { return make_rival("filament"); }};

// Constant load and the toy's noise, so that misses are the closed form's.
Scenario noisy() {
    Scenario scenario = make_scenario("quiet-noisy");
    scenario.noise = 0.03;
    return scenario;
}

ScorecardOptions small_card() {
    ScorecardOptions options;
    options.scenarios = {make_scenario("toy"), make_scenario("hitch")};
    options.laws = {oracle, constant, paper, filament};
    options.reference = filament;
    options.seeds = 3;
    return options;
}

TEST(Scorecard, HasARowForEachScenarioLawAndTuningInOrder) {
    const std::vector<Row> rows = scorecard(small_card());
    ASSERT_EQ(rows.size(), 2u * (1 + 3 * 2)) << "the oracle is not retuned";
    const char* laws[] = {"oracle", "constant", "constant", "paper", "paper", "filament", "filament"};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].scenario, i < 7 ? "toy" : "hitch");
        EXPECT_EQ(rows[i].law, laws[i % 7]);
        EXPECT_EQ(rows[i].tuning, i % 7 > 0 && i % 7 % 2 == 0 ? Tuning::equal_miss : Tuning::own);
    }
}

TEST(Scorecard, IsTheSameInEveryRun) {
    const ScorecardOptions options = small_card();
    std::ostringstream first, second;
    write_scorecard_json(first, options, scorecard(options));
    write_scorecard_json(second, options, scorecard(options));
    EXPECT_EQ(first.str(), second.str());
}

TEST(Scorecard, EqualMissTurnsTheTargetUntilTheMissesAreTheReferences) {
    ScorecardOptions options;
    options.scenarios = {noisy()};
    options.laws = {constant};
    options.reference = {"aims lower", [](const Course&) -> Made {
                             class Lower final : public Controller {
                             public:
                                 void observe(const FrameSample&) override {}
                                 Decision decide(const FrameRequest& request) override {
                                     return constant_.decide({0.97 * request.target_ms, request.range, nullptr});
                                 }
                                 void reset() override {}
                                 const Status& status() const override { return constant_.status(); }

                             private:
                                 Constant constant_;
                             };
                             return std::make_unique<Lower>();
                         }};
    options.seeds = 15;
    const std::vector<Row> rows = scorecard(options);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].target_factor, 1);
    EXPECT_NEAR(rows[1].target_factor, 0.97, 0.002);
    EXPECT_LT(rows[1].median.over_5pct, rows[0].median.over_5pct / 2);
}

TEST(Scorecard, MediansAreOfTheFiguresOfAllSeeds) {
    ScorecardOptions options;
    options.scenarios = {noisy()};
    options.laws = {oracle};
    options.reference = constant;
    options.seeds = 4;
    const Row row = scorecard(options).front();
    const Course course = make_course(noisy());
    std::vector<double> over;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Oracle law(course);
        std::vector<Outcome> outcomes;
        run(course, law, {.seed = seed, .target_factor = 1, .now_us = {}}, outcomes);
        over.push_back(measure(course, outcomes).over_5pct);
    }
    std::sort(over.begin(), over.end());
    EXPECT_DOUBLE_EQ(row.median.over_5pct, (over[1] + over[2]) / 2);
    EXPECT_DOUBLE_EQ(row.worst.over_5pct, over[3]);
    EXPECT_DOUBLE_EQ(row.oracle_over_5pct, row.median.over_5pct);
}

TEST(Scorecard, WhatMostSeedsNeverReachIsNeverReached) {
    ScorecardOptions options = small_card();
    options.laws = {constant};
    const std::vector<Row> rows = scorecard(options);
    EXPECT_FALSE(rows.front().median.settle_down) << "it knows nothing of the load";
    EXPECT_TRUE(rows.front().has_step_down);
}

TEST(Scorecard, ReportsProgressUpToTheEnd) {
    ScorecardOptions options = small_card();
    double last = 0;
    options.progress = [&](double share) {
        EXPECT_GT(share, last);
        last = share;
    };
    scorecard(options);
    EXPECT_EQ(last, 1);
}

TEST(ScorecardJson, ParsesAndHoldsTheFields) {
    const ScorecardOptions options = small_card();
    std::ostringstream text;
    const std::vector<Row> rows = scorecard(options);
    write_scorecard_json(text, options, rows);
    const nlohmann::json json = nlohmann::json::parse(text.str());
    ASSERT_EQ(json.at("rows").size(), rows.size());
    EXPECT_EQ(json.at("seeds"), 3);
    EXPECT_EQ(json.at("reference"), "filament");
    for (const nlohmann::json& row : json.at("rows")) {
        for (const char* share : {"over_5pct", "oracle_over_5pct", "within_5pct", "within_10pct", "control_rate"}) {
            EXPECT_GE(row.at(share).get<double>(), 0) << share;
            EXPECT_LE(row.at(share).get<double>(), 1) << share;
        }
        for (const char* number : {"quality", "overshoot_pct", "reversals_per_1000", "us_per_frame"}) {
            EXPECT_TRUE(row.at(number).is_number()) << number;
        }
        for (const char* frames : {"settle_down", "settle_up"}) {
            EXPECT_TRUE(row.at(frames).is_number() || row.at(frames).is_null()) << frames;
        }
        EXPECT_TRUE(row.at("tuning") == "own" || row.at("tuning") == "equal-miss");
    }
    EXPECT_EQ(json["rows"][0]["law"], "oracle");
    EXPECT_EQ(json["rows"][0]["quality"], 1);
    EXPECT_TRUE(json["rows"][1]["settle_down"].is_null());
}

TEST(ScorecardTable, LinesOfATableAreEquallyLong) {
    const ScorecardOptions options = small_card();
    std::ostringstream text;
    write_scorecard_table(text, options, scorecard(options));
    std::istringstream lines(text.str());
    std::size_t width = 0, tables = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("toy: ") || line.starts_with("hitch: ") || line.empty()) {
            tables += line.empty() ? 1 : 0;
            continue;
        }
        if (width == 0) width = line.size();
        EXPECT_EQ(line.size(), width) << line;
    }
    EXPECT_EQ(tables, 2u);
}

TEST(Scorecard, TheWorstSeedIsOfEachFigureByItself) {
    ScorecardOptions options;
    Scenario scenario = make_scenario("toy");
    scenario.regained = {{1800, 2700}};
    options.scenarios = {scenario};
    options.laws = {filament};
    options.reference = filament;
    options.seeds = 5;
    const Row row = scorecard(options).front();
    const Course course = make_course(scenario);
    double quality = 2, turns = 0;
    std::optional<double> regain = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        std::vector<Outcome> outcomes;
        run(course, *make_rival("filament"), {.seed = seed, .target_factor = 1, .now_us = {}}, outcomes);
        const Metrics m = measure(course, outcomes);
        quality = std::min(quality, m.quality);
        turns = std::max(turns, m.reversals_per_1000);
        regain = regain && m.regain ? std::max(regain, m.regain) : std::nullopt;
    }
    EXPECT_DOUBLE_EQ(row.worst.quality, quality);
    EXPECT_DOUBLE_EQ(row.worst.reversals_per_1000, turns);
    EXPECT_EQ(row.worst.regain, regain);
    EXPECT_LT(row.worst.quality, row.median.quality);
}

TEST(Scorecard, MissesThatNoFactorGivesAreMarked) {
    ScorecardOptions options;
    options.scenarios = {noisy()};
    // Draws everything, whatever it is asked for.
    const Contestant deaf{"deaf", [](const Course&) -> Made {
                              class Deaf final : public Controller {
                              public:
                                  void observe(const FrameSample&) override {}
                                  Decision decide(const FrameRequest&) override { return {}; }
                                  void reset() override {}
                                  const Status& status() const override { return status_; }

                              private:
                                  Status status_;
                              };
                              return std::make_unique<Deaf>();
                          }};
    options.laws = {deaf, constant};
    options.reference = oracle;
    options.seeds = 3;
    const std::vector<Row> rows = scorecard(options);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_TRUE(rows[0].is_equal) << "at its own tuning nothing was asked";
    EXPECT_FALSE(rows[1].is_equal);
    EXPECT_TRUE(rows[3].is_equal);
    std::ostringstream text;
    write_scorecard_table(text, options, rows);
    EXPECT_NE(text.str().find("not equal"), std::string::npos);
}

}  // namespace
}  // namespace sfsm::simulate
