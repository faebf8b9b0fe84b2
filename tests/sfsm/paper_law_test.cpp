// The closed loop of the paper's law: where it goes, where it stays, and what can never happen to it.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include "sfsm/paper.h"
#include "tests/sfsm/driven.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr int most_delay = 4;  // frames, of timer queries
constexpr PaperConstants constants;

std::vector<TraceRow> run_paper(const Loop& loop) {
    PaperLaw law;
    return run(law, loop);
}

std::int64_t count_state_changes(const std::vector<TraceRow>& rows) {
    std::int64_t changes = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        changes += rows[i].decision.state != rows[i - 1].decision.state ? 1 : 0;
    }
    return changes;
}

// The first frame drawn in that state, or -1.
std::int64_t first_frame_in(const std::vector<TraceRow>& rows, State state) {
    for (const TraceRow& row : rows) {
        if (row.decision.state == state) return row.frame;
    }
    return -1;
}

TEST(PaperLaw, StaysOriginalWhileTheTargetIsMet) {
    for (const TraceRow& row : run_paper({exact({100, 100, 10, 100}), constant(200)})) {
        EXPECT_EQ(row.decision, Decision{});
    }
}

TEST(PaperLaw, BeginsWithTheWholeRangeThenFiveSixthsThenTheSecant) {
    const auto rows = run_paper({exact({100, 100, 10, 100}), constant(175), 4});
    EXPECT_EQ(rows[0].decision, Decision{});
    EXPECT_EQ(rows[1].decision, (Decision{State::slowed, test_range, 0}));
    EXPECT_EQ(rows[2].decision, (Decision{State::slowed, 5.0 / 6 * test_range, 0}));
    EXPECT_EQ(rows[3].decision.state, State::slowed);
    EXPECT_NEAR(rows[3].decision.motion_distance, 150, 1e-9) << "where this plant takes 175 ms";
}

TEST(PaperLaw, SettlesWithinTwoLeastStepsOfTheDistanceSought) {
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Plant plant{uniform(random, 0, 200), uniform(random, 20, 400), 10, 100};
        const double range = uniform(random, 150, 800);
        const double sought = uniform(random, 0.8, 0.95) * range;
        const double target = plant.time({State::slowed, sought, 0}, range);
        const int delay = trial % (most_delay + 1);
        const auto rows = run_paper({exact(plant, range), constant(target), 300, delay, range});
        for (const TraceRow& row : rows) {
            if (row.frame < 12 * (delay + 1)) continue;
            ASSERT_EQ(row.decision.state, State::slowed) << "trial " << trial << " frame " << row.frame;
            ASSERT_NEAR(row.decision.motion_distance, sought, 2 * constants.h)
                << "trial " << trial << " frame " << row.frame;
        }
    }
}

// Law.md's hazard 2, kept on purpose: the printed floor h never lets D rest.
TEST(PaperLaw, NeverSettlesCloserThanTheFloor) {
    const auto rows = run_paper({exact({100, 100, 10, 100}), constant(190), 200});
    std::set<double> distances;
    for (const TraceRow& row : rows) {
        if (row.frame >= 100) distances.insert(row.decision.motion_distance);
    }
    EXPECT_GT(distances.size(), 1u);
    EXPECT_GE(*distances.rbegin() - *distances.begin(), constants.h - 1e-9);
}

TEST(PaperLaw, SplatsEndWithinOneStepOfTheTargetUnderLateTimes) {
    std::mt19937_64 random(2);
    for (int trial = 0; trial < 200; ++trial) {
        const Plant plant{uniform(random, 300, 900), uniform(random, 0, 100), uniform(random, 1, 20),
                          uniform(random, 50, 250)};
        const double target = plant.time({State::points, 1, uniform(random, 2, 25)}, test_range);
        const int delay = trial % (most_delay + 1);
        const auto rows = run_paper({exact(plant), constant(target), 400, delay});
        for (const TraceRow& row : rows) {
            if (row.frame < 25 * (delay + 1)) continue;
            const double splat = row.decision.splat_size;
            ASSERT_EQ(row.decision.state, State::points) << "trial " << trial << " frame " << row.frame;
            const double finer = splat - constants.tau, coarser = splat + constants.tau;
            ASSERT_TRUE(finer <= 0 || plant.time({State::points, 1, finer}, test_range) >= target) << "trial " << trial;
            ASSERT_LE(plant.time({State::points, 1, coarser}, test_range), target) << "trial " << trial;
        }
    }
}

TEST(PaperLaw, AnUnreachableTargetEndsAtTheLargestSplatAndStays) {
    const auto rows = run_paper({exact({300, 100, 50, 100}), constant(10), 200, 2});
    for (const TraceRow& row : rows) {
        if (row.frame < 100) continue;
        EXPECT_EQ(row.decision.splat_size, max_splat_size) << row.frame;
    }
}

TEST(PaperLaw, LeavesTrianglesInFewTimesWhenMotionIsNotTheBottleneck) {
    constexpr int most_times = 3;  // state 0, D_0 and D_1
    for (int delay = 0; delay <= most_delay; ++delay) {
        const auto rows = run_paper({exact({900, 0, 35, 100}), constant(60), 100, delay});
        const std::int64_t first = first_frame_in(rows, State::points);
        EXPECT_GT(first, 0);
        EXPECT_LE(first, most_times * (delay + 1)) << "delay " << delay;
    }
}

TEST(PaperLaw, NearlyFlatTimesAlsoLeadToPoints) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const double noise = uniform(random, 0, 0.03), target = uniform(random, 60, 800);
        const Plant plant{900, 0, 35, 30};
        const Time time = [&](std::int64_t, const Decision& d) {
            return plant.time(d, test_range) * (1 + noise * uniform(random, -1, 1));
        };
        const std::int64_t first = first_frame_in(run_paper({time, constant(target)}), State::points);
        EXPECT_TRUE(first > 0 && first <= 8) << "trial " << trial << ": first points at frame " << first;
    }
}

// Triangles too slow, the smallest splats too fast: there is nothing between, and no bouncing at every frame either.
TEST(PaperLaw, DoesNotBounceAcrossTheGapBetweenTrianglesAndPoints) {
    for (int delay = 0; delay <= most_delay; ++delay) {
        const auto rows = run_paper({exact({900, 0, 20, 15}), constant(300), 1000, delay});
        const std::int64_t changes = count_state_changes(rows);
        EXPECT_GT(changes, 6) << "it must keep trying: triangles may be affordable again";
        EXPECT_LT(changes, 40) << "delay " << delay;
        std::int64_t slow_frames = 0;
        for (const TraceRow& row : rows) slow_frames += row.frame >= 500 && row.frame_ms > 300 ? 1 : 0;
        EXPECT_LE(slow_frames, 4 * (delay + 2)) << "delay " << delay;
    }
}

TEST(PaperLaw, GivesEverythingBackWhenTheLoadGoes) {
    const Plant heavy{900, 100, 35, 100}, light{20, 10, 5, 5};
    for (int delay = 0; delay <= most_delay; ++delay) {
        const Time time = [&](std::int64_t frame, const Decision& d) {
            return (frame < 100 ? heavy : light).time(d, test_range);
        };
        const auto rows = run_paper({time, constant(60), 300, delay});
        EXPECT_EQ(rows[99].decision.state, State::points);
        EXPECT_EQ(rows[299].decision, Decision{}) << "delay " << delay;
    }
}

// The printed eq. 5 turns back down after a rise that was not enough, and never gets there.
TEST(PaperLaw, RisesToTheWholeRangeWhereThePrintedStepWouldSwing) {
    double newer = 5.0 / 6 * test_range, older = test_range;
    for (int i = 0; i < 1000; ++i) {
        const double next = newer + floored_step(over_learning_step(newer - older), constants.h);
        older = newer;
        newer = next;
        EXPECT_LT(newer, 0.95 * test_range) << "printed, although every frame was fast";
    }
    const Plant heavy{100, 100, 10, 100};
    const Time time = [&](std::int64_t frame, const Decision& d) {
        return frame < 4 ? heavy.time(d, test_range) : 20.0;
    };
    const auto rows = run_paper({time, constant(175), 40});
    EXPECT_EQ(rows[4].decision.state, State::slowed);
    EXPECT_LT(rows[4].decision.motion_distance, test_range);
    EXPECT_EQ(rows[39].decision, Decision{});
}

TEST(PaperLaw, ANewTargetIsJudgedInTheSameFrameByTheNewestTime) {
    PaperLaw law;
    const Plant plant{600, 300, 35, 393};
    const auto rows = run(law, {exact(plant), constant(1000), 30});
    EXPECT_EQ(rows.back().decision.state, State::original);
    EXPECT_EQ(law.decide({300, test_range}).state, State::slowed) << "no sample between the two decisions";
}

TEST(PaperLaw, LearnedPairsOutliveAChangeOfTarget) {
    const Plant plant{100, 100, 10, 100};
    PaperLaw law;
    run(law, {exact(plant), constant(199), 2});  // D = L has been drawn
    law.observe({1, 200, {State::slowed, test_range, 0}, {}});
    law.decide({199, test_range});  // 5/6 L
    law.observe({2, 183.3, {State::slowed, 5.0 / 6 * test_range, 0}, {}});
    const Decision decision = law.decide({170, test_range});  // another target in the frame the time arrives
    EXPECT_EQ(decision.state, State::slowed);
    EXPECT_NEAR(decision.motion_distance, 140, 1) << "the secant through both pairs, for the new target";
}

TEST(PaperLaw, OneTimeIsNeverSteppedOnTwiceHoweverLate) {
    PaperLaw law;
    const Decision first = law.decide({100, test_range});
    law.observe({0, 200, first, {}});
    const Decision second = law.decide({100, test_range});
    ASSERT_EQ(second.state, State::slowed);
    for (int late = 1; late <= most_delay; ++late) {
        law.observe({late, 200, first, {}});  // drawn before the decision that answers it
        EXPECT_EQ(law.decide({100, test_range}), second) << late << " frames late";
    }
    law.observe({most_delay + 1, 200, second, {}});
    EXPECT_NE(law.decide({100, test_range}), second);
}

TEST(PaperLaw, LateTimesAreRecognisedWhileTheRangeMoves) {
    std::mt19937_64 random(4);
    const Plant plant{900, 100, 35, 100};
    PaperLaw law;
    std::vector<TraceRow> rows;
    constexpr int delay = 3;
    for (std::int64_t frame = 0; frame < 100; ++frame) {
        if (frame > delay) {
            const TraceRow& arrived = rows[static_cast<std::size_t>(frame - 1 - delay)];
            law.observe({arrived.frame, arrived.frame_ms, arrived.decision, {}});
        }
        TraceRow row;
        row.frame = frame;
        row.range = uniform(random, 30, 300);
        row.decision = law.decide({60, row.range});
        row.frame_ms = plant.time(row.decision, row.range);
        rows.push_back(row);
    }
    EXPECT_EQ(rows.back().decision.state, State::points);
    EXPECT_NEAR(rows.back().frame_ms, 60, 30);
}

using Drive = Driven<PaperLaw>;

// State 2 at the smallest splats, after returns to triangles that failed.
Drive after_failed_returns(double target_ms) {
    constexpr int most_times = 2000;  // the waits double: 48 is reached within some hundred
    Drive run(target_ms);
    const Plant gap{900, 0, 20, 15};
    const auto is_there = [&] { return run.law.memory().patience >= 48 && run.law.memory().fast_times >= 10; };
    for (int i = 0; !is_there() && i < most_times; ++i) run.answer(gap.time(run.decision, test_range));
    EXPECT_TRUE(is_there()) << "returns that fail must lengthen the patience";
    return run;
}

TEST(PaperLaw, PointsBeginBelowTwoThirdsOfTheRange) {
    const Plant plant{100, 100, 10, 400};  // 160 ms at D = 0.6 L
    const auto rows = run_paper({exact(plant), constant(160), 50});
    for (const TraceRow& row : rows) {
        if (row.decision.state != State::slowed) continue;
        EXPECT_GE(row.decision.motion_distance, 2.0 / 3 * test_range);
    }
    EXPECT_GT(first_frame_in(rows, State::points), 0);
}

TEST(PaperLaw, AnotherTimeAtTheSameDistanceKeepsTheSlope) {
    Drive run(100);
    run.answer(130);  // state 0
    run.answer(130);  // D = L
    const Decision held = run.decision;
    EXPECT_EQ(run.answer(100), held) << "exactly at the target";
    const double slope = (130.0 - 110) / (test_range - held.motion_distance);
    EXPECT_NEAR(run.answer(110).motion_distance, held.motion_distance - 10 / slope, 1e-9);
}

TEST(PaperLaw, EqualTimesHaveNoSlopeToFollow) {
    Drive run(100);
    run.answer(130);                                       // state 0
    run.answer(130);                                       // D = L
    const double rising = run.answer(94).motion_distance;  // 5/6 L
    EXPECT_GT(rising, 5.0 / 6 * test_range);
    run.law.observe({0, 94, run.decision, {}});
    run.retarget(90);  // slow by less than the far margin, at two distances of one time
    EXPECT_EQ(run.decision, (Decision{State::slowed, rising - constants.h, 0}));
}

TEST(PaperLaw, TheWholeRangeStaysWholeWhileItMoves) {
    Drive run(100);
    run.answer(101);
    for (const double range : {200.0, 350.0, 40.0, 90.0}) {
        EXPECT_EQ(run.reach(range), (Decision{State::slowed, range, 0}));
    }
    for (int i = 0; i < 10; ++i) run.answer(101 - 4 * (i > 0));  // down once, then fast but inside the return margin
    for (const double range : {90.0, 350.0, 40.0}) {
        EXPECT_EQ(run.reach(range), (Decision{State::slowed, range, 0}));
    }
}

TEST(PaperLaw, LessThanTheReturnMarginOpensNoWayBack) {
    const Plant points{900, 0, 90, 1e-6};  // 90 ms whatever S
    for (const double target : {90 / 0.97, 90 / 0.93}) {
        const auto rows = run_paper({exact(points), constant(target), 60});
        const std::int64_t first = first_frame_in(rows, State::points);
        std::int64_t back = 0;
        for (const TraceRow& row : rows) back += row.frame > first && row.decision.state == State::slowed ? 1 : 0;
        EXPECT_EQ(back > 0, target == 90 / 0.93) << target;
    }
}

TEST(PaperLaw, AReturnToTrianglesSurvivesASmallMiss) {
    Drive run(300);
    for (const double ms : {900, 900, 900}) run.answer(ms);
    ASSERT_EQ(run.decision.state, State::points);
    run.leave_state(30);
    EXPECT_EQ(run.decision, (Decision{State::slowed, 2.0 / 3 * test_range + constants.h, 0}));
    EXPECT_EQ(run.answer(305).state, State::slowed);
}

TEST(PaperLaw, ANewTargetForgetsFailedReturns) {
    Drive run = after_failed_returns(300);
    run.retarget(310);
    EXPECT_EQ(run.leave_state(30), constants.first_patience);
}

TEST(PaperLaw, ALowerTargetIsNotMistakenForLongPatience) {
    Drive run = after_failed_returns(300);
    EXPECT_EQ(run.retarget(20), (Decision{State::points, run.decision.motion_distance, 2 * constants.tau}));
}

TEST(PaperLaw, BadTimesAreCountedAndChangeNothing) {
    PaperLaw law;
    const Decision first = law.decide({100, test_range});
    for (const double ms :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0, -1.0}) {
        law.observe({0, ms, first, {}});
    }
    EXPECT_EQ(law.status().bad_samples, 4);
    EXPECT_EQ(law.status().last_ms, 0);
    EXPECT_EQ(law.decide({100, test_range}), first);
}

TEST(PaperLaw, UnusableArgumentsLeaveTheLastOnesInForce) {
    PaperLaw law;
    EXPECT_EQ(law.decide({NAN, -1}), Decision{});
    const Decision first = law.decide({100, test_range});
    law.observe({0, 200, first, {}});
    const Decision second = law.decide({-5, std::numeric_limits<double>::infinity()});
    EXPECT_EQ(second, (Decision{State::slowed, test_range, 0}));
    EXPECT_EQ(law.status().target_ms, 100);
}

double hostile(std::mt19937_64& random, double usual) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::array values = {std::numeric_limits<double>::quiet_NaN(),
                                   infinity,
                                   -infinity,
                                   0.0,
                                   -0.0,
                                   -1.0,
                                   1e30,
                                   std::numeric_limits<double>::denorm_min(),
                                   std::numeric_limits<double>::max(),
                                   std::numeric_limits<double>::min(),
                                   1e-300,
                                   5000.0};
    const std::uint64_t pick = random() % 40;
    if (pick < values.size()) return values[pick];
    return pick < 30 ? usual : uniform(random, 0.5, 2) * usual;  // equal times are hostile too
}

void expect_in_range(const Decision& d, double range, const std::string& where) {
    if (d.state == State::original) {
        ASSERT_EQ(d, Decision{}) << where;
        return;
    }
    ASSERT_TRUE(d.state == State::slowed || d.state == State::points) << where;
    ASSERT_GT(d.motion_distance, 0) << where;
    ASSERT_LE(d.motion_distance, range) << where;
    ASSERT_GE(d.splat_size, 0) << where;
    ASSERT_LE(d.splat_size, max_splat_size) << where;
    ASSERT_EQ(d.splat_size > 0, d.state == State::points) << where;
}

TEST(PaperLaw, NeverLeavesTheVisibleRange) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        std::mt19937_64 random(seed);
        PaperLaw law;
        double range = 0;  // the last usable one
        Decision drawn;
        for (int frame = 0; frame < 2000; ++frame) {
            FrameSample sample{frame, hostile(random, 100), drawn, {}};
            if (random() % 20 == 0) sample.decision.motion_distance = hostile(random, 100);
            if (random() % 4 != 0) law.observe(sample);
            const double next_range = hostile(random, test_range);
            if (std::isfinite(next_range) && next_range > 0) range = next_range;
            drawn = law.decide({random() % 8 == 0 ? hostile(random, 80) : 80, next_range});
            ASSERT_NO_FATAL_FAILURE(
                expect_in_range(drawn, range, "seed " + std::to_string(seed) + " frame " + std::to_string(frame)));
            ASSERT_EQ(drawn, law.status().decision);
        }
    }
}

// The bits of a decision, folded (FNV-1a by words).
std::uint64_t fold(std::uint64_t hash, const Decision& decision) {
    for (const double value : {static_cast<double>(decision.state), decision.motion_distance, decision.splat_size}) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
    }
    return hash;
}

// One number for every compiler, optimisation level and platform with IEEE doubles.
TEST(PaperLaw, DecisionsAreTheSameBitsEverywhere) {
    std::mt19937_64 random(7);
    const Plant plant{60, 90, 10, 100};
    const Time time = [&](std::int64_t frame, const Decision& d) {
        const double load = frame % 400 < 200 ? 1 : 2.5;
        return load * plant.time(d, test_range) * (1 + 0.05 * uniform(random, -1, 1));
    };
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const TraceRow& row : run_paper({time, constant(110), 4000, 2})) hash = fold(hash, row.decision);
    EXPECT_EQ(hash, 9934952662477673016u);
}

TEST(PaperTable, EveryStateEndsWithARowThatAlwaysHolds) {
    for (const State state : {State::original, State::slowed, State::points}) {
        const PaperTransition* last = nullptr;
        for (const PaperTransition& row : paper_transitions()) {
            if (row.from == state) last = &row;
        }
        ASSERT_NE(last, nullptr);
        EXPECT_EQ(last->to, state);
        EXPECT_TRUE(last->holds(PaperMemory{}, constants));
    }
}

TEST(PaperTable, TheDocumentShowsTheSameRows) {
    std::ifstream document(GRANDSTAND_DOCS "/controller.md");
    ASSERT_TRUE(document) << GRANDSTAND_DOCS "/controller.md";
    std::vector<std::string> shown;
    bool inside = false;
    for (std::string line; std::getline(document, line);) {
        if (inside && line.empty()) break;
        if (inside && !line.starts_with("|---")) shown.push_back(line);
        inside = inside || line == "| edge | from | to | when | then |";
    }
    std::vector<std::string> rows;
    for (const PaperTransition& row : paper_transitions()) {
        const std::string from = std::to_string(static_cast<int>(row.from)),
                          to = std::to_string(static_cast<int>(row.to));
        rows.push_back("| " + std::string(row.edge) + " | " + from + " | " + to + " | " + row.when + " | " + row.then +
                       " |");
    }
    EXPECT_EQ(shown, rows);
}

// Every row is reached by some run: none is dead.
TEST(PaperTable, EveryRowIsTaken) {
    std::set<std::string> reasons;
    std::mt19937_64 random(11);
    for (int trial = 0; trial < 300; ++trial) {
        const Plant plant{uniform(random, 20, 200), uniform(random, 0, 200), uniform(random, 1, 30),
                          uniform(random, 1, 100)};
        double target = 0, ms = 0;
        PaperLaw law;
        Decision drawn;
        for (int frame = 0; frame < 200; ++frame) {
            if (frame % 50 == 0) target = uniform(random, 5, 300);
            if (frame > 0) law.observe({frame - 1, ms, drawn, {}});
            drawn = law.decide({target, test_range});
            // Now and then a frame meets its target exactly, which no continuous plant does.
            ms = random() % 8 == 0 ? target : plant.time(drawn, test_range);
            reasons.insert(law.status().reason);
        }
    }
    for (const PaperTransition& row : paper_transitions()) EXPECT_TRUE(reasons.contains(row.reason)) << row.reason;
}

}  // namespace
}  // namespace sfsm
