// Every law and rival under hostile calls: what the fuzzer looks for, over a seeded corpus.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fuzz/calls.h"

namespace sfsm::fuzz {
namespace {

std::vector<std::uint8_t> random_bytes(std::uint64_t seed, std::size_t size) {
    std::mt19937_64 random(seed);
    std::vector<std::uint8_t> bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 56);
    return bytes;
}

class Hostile : public testing::TestWithParam<std::string_view> {};

TEST_P(Hostile, CallsLeaveEveryDecisionFiniteAndInRange) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const auto law = make_any(GetParam());
        ASSERT_EQ(call(*law, random_bytes(seed, 4096), Forecasts::none).broken, "") << "seed " << seed;
    }
}

TEST_P(Hostile, ForecastsLeaveEveryDecisionFiniteAndInRange) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const auto law = make_any(GetParam());
        ASSERT_EQ(call(*law, random_bytes(seed, 4096), Forecasts::hostile).broken, "") << "seed " << seed;
    }
}

TEST_P(Hostile, TheSameCallsGiveTheSameBits) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto one = make_any(GetParam()), other = make_any(GetParam());
        const auto bytes = random_bytes(seed, 4096);
        ASSERT_EQ(call(*one, bytes, Forecasts::hostile).hash, call(*other, bytes, Forecasts::hostile).hash)
            << "seed " << seed;
    }
}

TEST_P(Hostile, BadTimesAreCounted) {
    const auto law = make_any(GetParam());
    const Decision first = law->decide({16, 200});
    for (const double ms : {double{NAN}, double{INFINITY}, -double{INFINITY}, 0.0, -1.0})
        law->observe({0, ms, first, {}});
    EXPECT_EQ(law->status().bad_samples, 5);
    EXPECT_EQ(law->decide({16, 200}), first);
}

std::string test_name(const testing::TestParamInfo<std::string_view>& info) {
    std::string name(info.param);
    for (char& c : name) c = c == '-' ? '_' : c;
    return name;
}
INSTANTIATE_TEST_SUITE_P(All, Hostile, testing::ValuesIn(all_names()), test_name);

}  // namespace
}  // namespace sfsm::fuzz
