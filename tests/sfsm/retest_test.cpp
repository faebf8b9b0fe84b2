// What a law has given up is tested again: how often, and what is believed of it.
#include "sfsm/retest.h"

#include <gtest/gtest.h>

#include <vector>

namespace sfsm {
namespace {

constexpr double noise = 0.03;

// The decisions, counted from 0, that are retests.
std::vector<int> drawn(Retest& retest, int decisions, std::int64_t shifts = 0) {
    std::vector<int> list;
    for (int i = 0; i < decisions; ++i)
        if (retest.step(true, shifts)) list.push_back(i);
    return list;
}

// Says whether it disproved with one of its times.
bool hear(Retest& retest, const std::vector<double>& residuals) {
    bool is_disproved = false;
    for (const double residual : residuals) is_disproved = retest.has_disproved(residual, noise) || is_disproved;
    return is_disproved;
}

TEST(Retest, WaitsDoubleAndStayBelowTheLongest) {
    Retest retest(256);
    const std::vector<int> expected{63, 64, 65, 193, 194, 195, 451, 452, 453, 709, 710, 711};
    EXPECT_EQ(drawn(retest, 900), expected);
}

TEST(Retest, IsDrawnForNoMoreThanItsShareOfALongRun) {
    Retest retest(256);
    EXPECT_LE(drawn(retest, 258'000).size(), 3 * 1002u);
}

TEST(Retest, ANewLoadOrATargetThatIsMetBeginsTheWaitsAnew) {
    Retest retest(256);
    drawn(retest, 600);
    EXPECT_EQ(drawn(retest, 70, 1), (std::vector<int>{63, 64, 65}));
    EXPECT_FALSE(retest.step(false, 1));
    EXPECT_EQ(drawn(retest, 70, 1), (std::vector<int>{63, 64, 65}));
}

TEST(Retest, DisprovesByTheMedianOfItsThreeTimes) {
    for (const auto& [residuals, expected] :
         std::vector<std::pair<std::vector<double>, bool>>{{{-0.3, -0.3, -0.3}, true},
                                                           {{-0.3, 0.9, -0.3}, true},
                                                           {{0.0, 0.0, -0.9}, false},
                                                           {{-0.06, -0.06, -0.06}, false},
                                                           {{-0.08, -0.08, -0.08}, true},
                                                           {{0.5, 0.5, 0.5}, false},
                                                           {{-0.3, -0.3}, false}}) {
        Retest retest(256);
        drawn(retest, 66);
        EXPECT_EQ(hear(retest, residuals), expected) << residuals[0] << " " << residuals[1];
    }
}

TEST(Retest, TimesAfterItsOwnAreNotHeard) {
    Retest retest(256);
    EXPECT_FALSE(hear(retest, {-1, -1, -1})) << "none has been drawn";
    drawn(retest, 66);
    EXPECT_TRUE(hear(retest, {-1, -1, -1}));
    EXPECT_FALSE(hear(retest, {-1, -1, -1, -1}));
}

}  // namespace
}  // namespace sfsm
