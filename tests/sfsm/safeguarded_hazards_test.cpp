// The eight ways in which the printed law breaks: each shown on the paper's law, and held by the safeguarded one.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sfsm/paper.h"
#include "sfsm/safeguarded.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr PaperConstants paper;
const Plant slowed_plant{100, 100, 10, 100};  // 175 ms at D = 3/4 L
constexpr double slowed_target = 175;         // [ms]

template <class Law>
std::vector<TraceRow> run_law(const Loop& loop) {
    Law law;
    return run(law, loop);
}

// Near normal, of deviation 1.
double normal(std::mt19937_64& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform(random);
    return sum;
}

Time noisy(const Plant& plant, double noise, std::uint64_t seed) {
    return [=, random = std::mt19937_64(seed)](std::int64_t, const Decision& d) mutable {
        return plant.time(d, test_range) * std::exp(noise * normal(random));
    };
}

int count_changes(const std::vector<TraceRow>& rows, std::size_t from) {
    int changes = 0;
    for (std::size_t i = std::max<std::size_t>(from, 1); i < rows.size(); ++i) {
        changes += rows[i].decision != rows[i - 1].decision ? 1 : 0;
    }
    return changes;
}

int count_state_changes(const std::vector<TraceRow>& rows, std::size_t from) {
    int changes = 0;
    for (std::size_t i = from; i < rows.size(); ++i) {
        changes += rows[i].decision.state != rows[i - 1].decision.state ? 1 : 0;
    }
    return changes;
}

// Frames from `from` on until all of the rest is within 5 % of the target; -1: never.
std::int64_t settled_after(const std::vector<TraceRow>& rows, std::int64_t from) {
    std::int64_t last_miss = from - 1;
    for (const TraceRow& row : rows) {
        if (row.frame >= from && std::abs(row.frame_ms / row.target_ms - 1) > 0.05) last_miss = row.frame;
    }
    return last_miss + 1 == static_cast<std::int64_t>(rows.size()) ? -1 : last_miss + 1 - from;
}

TEST(Hazard1, EqualTimesAndNoiseMakeNoStep) {
    EXPECT_FALSE(std::isfinite(secant_step({150, 100}, {160, 100}, 90)));
    EXPECT_GT(std::abs(secant_step({150, 100}, {160, 100.001}, 90)), 100 * test_range) << "1 us apart";

    const Loop loop{noisy(slowed_plant, 0.01, 1), constant(slowed_target), 1000, 2};
    EXPECT_GT(count_changes(run_law<PaperLaw>(loop), 200), 100);
    EXPECT_LE(count_changes(run_law<SafeguardedLaw>(loop), 200), 2);
}

TEST(Hazard2, BothKnobsComeToRest) {
    const Plant by_splats{600, 100, 10, 100};
    for (const Loop& loop :
         {Loop{exact(slowed_plant), constant(190), 600, 0}, Loop{exact(by_splats), constant(25), 600, 0}}) {
        EXPECT_GT(count_changes(run_law<PaperLaw>(loop), 100), 100);
        const auto rows = run_law<SafeguardedLaw>(loop);
        EXPECT_EQ(count_changes(rows, 100), 0);
        EXPECT_NEAR(rows.back().frame_ms / loop.target(0), 1, 0.01);
    }
}

// The pairs of the scene before the cut make a secant that points the wrong way.
TEST(Hazard3, AViewChangeIsAnsweredByTheNewScene) {
    constexpr std::int64_t cut = 100;
    const Plant far{100, 100, 10, 100}, near{0, 260, 10, 100};
    const Time time = [&](std::int64_t frame, const Decision& d) { return (frame < cut ? far : near).time(d, 200); };
    const Loop loop{time, constant(slowed_target), 400, 0};
    EXPECT_EQ(settled_after(run_law<PaperLaw>(loop), cut), -1);
    const std::int64_t frames = settled_after(run_law<SafeguardedLaw>(loop), cut);
    EXPECT_TRUE(frames >= 0 && frames <= 20) << frames;

    // What misleads the paper's: at one D, the time of before and the time of after.
    EXPECT_GT(secant_distance({150, 181}, {152, 176}, slowed_target), 150) << "slow, and it lengthens D";
}

TEST(Hazard4, AHitchMovesNothing) {
    for (const std::int64_t hitch : {1, 2, 5, 50, 333}) {
        const Time time = [&](std::int64_t frame, const Decision& d) {
            return frame == hitch ? 4000 : slowed_plant.time(d, test_range);
        };
        const Loop loop{time, constant(201), 600, 2};  // met with everybody moving
        EXPECT_GT(count_changes(run_law<PaperLaw>(loop), 0), 0);
        EXPECT_EQ(count_changes(run_law<SafeguardedLaw>(loop), 0), 0) << hitch;
    }
}

// Eq. 4 on times that arrive late, paired with the newest distances as the printed law does.
double printed_distance_after(int frames, int delay) {
    std::vector<double> distances = {test_range, 5.0 / 6 * test_range};
    const auto time_of = [&](std::size_t i) { return slowed_plant.time({State::slowed, distances[i], 0}, test_range); };
    for (int i = 0; i < frames; ++i) {
        const std::size_t newest = distances.size() - 1;
        const std::size_t late = static_cast<std::size_t>(delay);
        const double newer_ms = time_of(newest > late ? newest - late : 0);
        const double older_ms = time_of(newest > late + 1 ? newest - late - 1 : 0);
        distances.push_back(
            secant_distance({distances[newest], newer_ms}, {distances[newest - 1], older_ms}, slowed_target));
    }
    return distances.back();
}

TEST(Hazard5, LateTimesBelongToTheirOwnDecision) {
    EXPECT_NEAR(printed_distance_after(1, 0), 0.75 * test_range, 1e-6) << "in time, this plant is solved in one step";
    for (int delay = 0; delay <= 8; ++delay) {
        if (delay > 0) {
            const double printed = printed_distance_after(50, delay);
            EXPECT_FALSE(std::abs(printed - 0.75 * test_range) < 0.05 * test_range) << printed;
        }
        const auto rows = run_law<SafeguardedLaw>({exact(slowed_plant), constant(slowed_target), 400, delay});
        const std::int64_t frames = settled_after(rows, 0);
        EXPECT_TRUE(frames >= 0 && frames <= 10 * (delay + 2)) << "delay " << delay << ": " << frames;
    }
}

TEST(Hazard6, MovingRangesKeepTheShareAndTheLimits) {
    EXPECT_LT(next_splat_size(0.5, 10, 20, paper.tau), 0);
    EXPECT_GT(secant_distance({190, 190}, {200, 195}, 175), 100) << "in metres, wherever L is by now";

    SafeguardedLaw law;
    const auto rows = run(law, {exact(slowed_plant), constant(slowed_target), 300, 1});
    const double share = rows.back().decision.motion_distance / test_range;
    for (const double range : {100.0, 1e-3, 5000.0, 20.0, test_range}) {
        const Decision decision = law.decide({slowed_target, range});
        EXPECT_NEAR(decision.motion_distance, share * range, 1e-9 * range);
    }

    std::mt19937_64 random(6);
    SafeguardedLaw moving;
    Decision drawn;
    double ms = 0;
    for (int frame = 0; frame < 2000; ++frame) {
        const double range = uniform(random, 20, 600);
        if (frame > 0) moving.observe({frame - 1, ms, drawn, {}});
        drawn = moving.decide({slowed_target, range});
        ASSERT_TRUE(drawn.state == State::original || drawn.motion_distance <= range);
        ms = slowed_plant.time(drawn, range);
    }
    EXPECT_NEAR(ms / slowed_target, 1, 0.02) << "times depend on D / L here, and D keeps its share";
}

TEST(Hazard7, WithoutAuthorityDetailIsGivenUpOnlyWhereItHelps) {
    for (int delay = 0; delay <= 4; ++delay) {
        const Plant only_points{900, 0, 10, 100};
        const auto rows = run_law<SafeguardedLaw>({exact(only_points), constant(60), 400, delay});
        EXPECT_EQ(rows.back().decision.state, State::points);
        EXPECT_NEAR(rows.back().frame_ms / 60, 1, 0.02) << "delay " << delay;

        // Bound elsewhere: 30 ms whatever is drawn.
        const Loop loop{[](std::int64_t, const Decision&) { return 30.0; }, constant(20), 400, delay};
        EXPECT_EQ(run_law<PaperLaw>(loop).back().decision.splat_size, max_splat_size);
        EXPECT_EQ(run_law<SafeguardedLaw>(loop).back().decision, Decision{}) << "delay " << delay;
    }
}

// State 1 a little slow, the finest points far too fast.
TEST(Hazard8, TheBoundaryBetweenStatesDoesNotChatter) {
    const Plant gap{900, 0, 20, 15};
    for (int delay = 0; delay <= 4; ++delay) {
        const Loop loop{noisy(gap, 0.03, 8), constant(300), 4000, delay};
        const int paper_changes = count_state_changes(run_law<PaperLaw>(loop), 300);
        const int changes = count_state_changes(run_law<SafeguardedLaw>(loop), 300);
        EXPECT_GT(paper_changes, 10);
        EXPECT_LE(changes, 8) << "delay " << delay;
    }
}

}  // namespace
}  // namespace sfsm
