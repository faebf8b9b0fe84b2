// The detector of shifts against its definition, sample by sample.
#include "sfsm/shift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sfsm/normal.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr int window = 32;
constexpr double clip = 3, threshold = 4.2;  // standard deviations

// The number of newest samples whose mean is the least likely to be 0, where it is less likely than the threshold.
int most_telling(const std::vector<double>& samples) {
    int shown = 0;
    double most = threshold;
    for (int n = 1; n <= std::min<int>(window, static_cast<int>(samples.size())); ++n) {
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += std::clamp(samples[samples.size() - 1 - i], -clip, clip);
        if (std::abs(sum) / std::sqrt(n) <= most) continue;
        most = std::abs(sum) / std::sqrt(n);
        shown = n;
    }
    return shown;
}

TEST(ShiftDetector, ShowsTheMostTellingOfItsWindow) {
    std::mt19937_64 random(1);
    int shown = 0;
    for (int course = 0; course < 200; ++course) {
        ShiftDetector detector;
        std::vector<double> samples;
        for (int i = 0; i < 150; ++i) {
            const double shift = i >= 90 ? 0.01 * course : 0;  // none to 2 deviations
            samples.push_back(shift + normal(random) * (random() % 20 == 0 ? 5 : 1));
            const int expected = most_telling(samples);
            ASSERT_EQ(detector.add(samples.back()), expected) << "course " << course << " sample " << i;
            shown += expected > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(shown, 1000) << "or nothing was tried";
}

TEST(ShiftDetector, IsDeafToOneOutlierAndHearsTwo) {
    for (const double size : {3.5, 100.0, 1e300}) {
        for (const double sign : {1.0, -1.0}) {
            ShiftDetector detector;
            for (int i = 0; i < 40; ++i) EXPECT_EQ(detector.add(0), 0);
            EXPECT_EQ(detector.add(sign * size), 0);
            EXPECT_EQ(detector.add(sign * size), 2);
            detector.clear();
            EXPECT_EQ(detector.add(sign * size), 0) << "what was cleared is not counted again";
            EXPECT_EQ(detector.add(-sign * size), 0) << "opposite ones are two outliers";
        }
    }
}

TEST(ShiftDetector, GaussianNoiseAloneSeldomShows) {
    std::mt19937_64 random(2);
    ShiftDetector detector;
    int alarms = 0;
    constexpr int samples = 200'000;
    for (int i = 0; i < samples; ++i) {
        if (detector.add(normal(random)) == 0) continue;
        ++alarms;
        detector.clear();
    }
    constexpr int most = 5 * samples / 10'000;  // "one in some 10^4"
    EXPECT_LE(alarms, most);
}

}  // namespace
}  // namespace sfsm
