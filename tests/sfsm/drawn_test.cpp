#include "sfsm/drawn.h"

#include <gtest/gtest.h>

namespace sfsm {
namespace {

TEST(DrawnDecisions, AreTakenForTheSameOnlyIfEveryNumberIs) {
    const Decision decision{State::points, 100, 2, 1e-6};
    DrawnDecisions drawn;
    drawn.add(decision);
    EXPECT_TRUE(drawn.contains(decision));
    EXPECT_FALSE(drawn.contains({State::slowed, 100, 2, 1e-6}));
    EXPECT_FALSE(drawn.contains({State::points, 99, 2, 1e-6}));
    EXPECT_FALSE(drawn.contains({State::points, 100, 3, 1e-6}));
    EXPECT_FALSE(drawn.contains({State::points, 100, 2, 2e-6}));
    drawn.clear();
    EXPECT_FALSE(drawn.contains(decision));
}

}  // namespace
}  // namespace sfsm
