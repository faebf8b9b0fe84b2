// Noise that remembers is told from noise that doesn't, whatever load or prices do.
#include "sfsm/noise_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/sfsm/normal.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

// After 2000 frames of AR(1) noise of deviation 1, on a level.
NoiseMemory heard(double correlation, const std::function<double(int)>& level, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    NoiseMemory memory;
    double noise = normal(random), before = 0;
    const double of_difference = std::sqrt(std::max(1 - correlation, 0.01));
    for (int i = 0; i < 2000; ++i) {
        noise = correlation * noise + std::sqrt(1 - correlation * correlation) * normal(random);
        const double now = noise + level(i);
        memory.add(now - before, of_difference);
        before = now;
    }
    return memory;
}

double rest(int) {
    return 0;
}

TEST(NoiseMemory, TellsTheCorrelationOfNoiseThatRemembers) {
    for (const double correlation : {0.8, 0.9}) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const NoiseMemory memory = heard(correlation, rest, seed);
            EXPECT_NEAR(memory.correlation(), correlation, 0.25) << seed;
            EXPECT_GT(memory.of_a_frame(), 1.4);
            EXPECT_GT(memory.of_a_mean(), 1.7 * memory.of_a_frame());
        }
    }
}

TEST(NoiseMemory, IsNoneOfNoiseWithoutWhateverTheLevelDoes) {
    const std::function<double(int)> drift = [](int frame) { return 5 * std::sin(frame / 20.0); };
    const std::function<double(int)> jumps = [](int frame) { return frame / 50 % 2 * 10.0; };
    for (const auto& level : {std::function<double(int)>(rest), drift, jumps}) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const NoiseMemory memory = heard(0, level, seed);
            EXPECT_EQ(memory.correlation(), 0) << seed;
            EXPECT_EQ(memory.of_a_frame(), 1);
            EXPECT_EQ(memory.of_a_mean(), 1);
        }
    }
}

TEST(NoiseMemory, IsNeverMoreThanItsBoundNorOfExactTimes) {
    EXPECT_EQ(heard(0.999, rest, 1).correlation(), 0.92);
    NoiseMemory memory;
    for (int i = 0; i < 1000; ++i) memory.add(0, 0.001);
    EXPECT_EQ(memory.correlation(), 0);
    for (int i = 0; i < 50; ++i) memory.add(1, 0.001);
    EXPECT_EQ(memory.correlation(), 0) << "what is off by so little is a price";
}

}  // namespace
}  // namespace sfsm
