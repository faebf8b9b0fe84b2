#include "sfsm/detail.h"

#include <gtest/gtest.h>

namespace sfsm {
namespace {

constexpr double range = 200;  // [m]

TEST(Detail, ComesBackFromItsDecision) {
    for (double detail = 0; detail <= 1; detail += 1.0 / 4096)
        EXPECT_NEAR(detail_of(decision_at(detail, range), range), detail, 1e-12);
}

TEST(Detail, MoreOfItNeverLosesMore) {
    Decision coarser = decision_at(0, range);
    EXPECT_EQ(coarser.splat_size, max_splat_size);
    for (double detail = 0; detail <= 1; detail += 1.0 / 4096) {
        const Decision decision = decision_at(detail, range);
        EXPECT_LE(decision.state, coarser.state);
        EXPECT_GE(decision.motion_distance, coarser.motion_distance);
        EXPECT_LE(decision.splat_size, coarser.splat_size);
        coarser = decision;
    }
    EXPECT_EQ(coarser, Decision{});
}

TEST(Detail, BelongsToTheStateOfItsDecision) {
    EXPECT_EQ(decision_at(detail_of({State::slowed, 1e9, 0}, range), range).state, State::slowed);
    EXPECT_EQ(decision_at(detail_of({State::slowed, 1, 0}, range), range).state, State::slowed);
    EXPECT_EQ(decision_at(detail_of({State::points, 50, 0.01}, range), range).state, State::points);
}

}  // namespace
}  // namespace sfsm
