#include "scene/looks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "scene/person.h"
#include "scene/places/stadium_crowd.h"
#include "sfsm/random.h"
#include "tests/scene/statistics.h"

namespace {

using scene::Fans;
using scene::Palette;

constexpr int drawn = 20000;
constexpr Fans nobodys{0, 0};

using Rgb = std::tuple<int, int, int>;
Rgb rgb(glm::u8vec4 color) {
    return {color.x, color.y, color.z};
}

// Rec. 601 luma.
double luma(glm::u8vec4 color) {
    return 0.299 * color.x + 0.587 * color.y + 0.114 * color.z;
}

double distance(glm::u8vec4 a, glm::u8vec4 b) {
    return glm::distance(glm::vec3(a), glm::vec3(b));
}

std::vector<Palette> dressed(Fans fans, std::uint64_t seed = 1) {
    std::vector<Palette> result;
    for (int i = 0; i < drawn; ++i) result.push_back(scene::dress(fans, sfsm::hash(seed, i)));
    return result;
}

std::set<Rgb> shirts_of(const std::vector<Palette>& people) {
    std::set<Rgb> result;
    for (const Palette& palette : people) result.insert(rgb(palette[scene::shirt_slot]));
    return result;
}

double share_in(const std::vector<Palette>& people, const std::set<Rgb>& shirts) {
    const auto worn = [&](const Palette& palette) { return shirts.contains(rgb(palette[scene::shirt_slot])); };
    return static_cast<double>(std::count_if(people.begin(), people.end(), worn)) / static_cast<double>(people.size());
}

std::vector<double> column(const std::vector<Palette>& people, model::Slot slot) {
    std::vector<double> result;
    for (const Palette& palette : people) result.push_back(luma(palette[slot]));
    return result;
}

using scene::hair_slot;
using scene::skin_slot;
constexpr model::Slot slots[] = {skin_slot, hair_slot, scene::shirt_slot, scene::trousers_slot};

TEST(Random, IsSplitmix) {
    // The first two numbers of the published generator from seed 1234567.
    EXPECT_EQ(sfsm::mix(1234567), 6457827717110365317u);
    EXPECT_EQ(sfsm::mix(1234567 + 0x9e3779b97f4a7c15u), 3203168211198807973u);
}

TEST(Random, UnitFillsItsRangeEvenly) {
    std::vector<std::int64_t> counts(64, 0);
    for (std::uint64_t i = 0; i < 64000; ++i) {
        const float value = sfsm::upper_unit(sfsm::mix(i));
        ASSERT_GE(value, 0.0f);
        ASSERT_LT(value, 1.0f);
        ++counts[static_cast<std::size_t>(value * 64)];
    }
    EXPECT_LT(tests::unevenness(counts), tests::chance);
    EXPECT_EQ(sfsm::upper_unit(0), 0.0f);
    EXPECT_LT(sfsm::upper_unit(~std::uint64_t{0}), 1.0f);
    EXPECT_GT(sfsm::upper_unit(~std::uint64_t{0}), 0.9999f);
}

TEST(Random, BelowTakesEveryValueEquallyOften) {
    for (const std::uint32_t n : {1u, 2u, 7u, 240u}) {
        std::vector<std::int64_t> counts(n, 0);
        for (std::uint64_t i = 0; i < 100ull * n; ++i) ++counts.at(sfsm::below(sfsm::mix(i), n));
        if (n > 1) {
            EXPECT_LT(tests::unevenness(counts), tests::chance) << n;
        }
        EXPECT_EQ(sfsm::below(~std::uint64_t{0}, n), n - 1);
    }
}

TEST(Random, HashTellsItsArgumentsApart) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t a = 0; a < 100; ++a)
        for (std::uint64_t b = 0; b < 100; ++b) seen.insert(sfsm::hash(a, b));
    EXPECT_EQ(seen.size(), 10000u);
}

TEST(Looks, WhatIsWornHasNothingToDoWithWhatElseIs) {
    const std::vector<Palette> people = dressed({0.3f, 0.2f});
    for (const model::Slot a : slots) {
        for (const model::Slot b : slots) {
            const bool skin_and_hair =
                (a == skin_slot || a == hair_slot) && (b == skin_slot || b == hair_slot);  // they belong together
            if (skin_and_hair) continue;
            if (a != b) {
                EXPECT_LT(tests::dependence(column(people, a), column(people, b)), tests::chance);
            }
        }
    }
}

TEST(Looks, EveryColourIsWornAndOpaque) {
    const std::vector<Palette> people = dressed(nobodys);
    for (const model::Slot slot : slots) {
        std::set<Rgb> seen;
        for (const Palette& palette : people) {
            seen.insert(rgb(palette[slot]));
            ASSERT_EQ(palette[slot].w, 255);
        }
        EXPECT_GE(seen.size(), 8u);
    }
}

TEST(Looks, ShirtsAndTrousersAreDrawnWithEqualChances) {
    std::map<Rgb, std::int64_t> shirts, trousers;
    for (const Palette& palette : dressed(nobodys)) {
        ++shirts[rgb(palette[scene::shirt_slot])];
        ++trousers[rgb(palette[scene::trousers_slot])];
    }
    for (const auto& worn : {shirts, trousers}) {
        std::vector<std::int64_t> counts;
        for (const auto& [color, count] : worn) counts.push_back(count);
        EXPECT_LT(tests::unevenness(counts), tests::chance);
    }
}

TEST(Looks, TeamsAreToldApartFromEachOtherAndTheRest) {
    const std::set<Rgb> sets[] = {shirts_of(dressed({1, 0})), shirts_of(dressed({0, 1})), shirts_of(dressed(nobodys))};
    for (const auto& a : sets) {
        for (const auto& b : sets) {
            if (&a == &b) continue;
            for (const Rgb& shirt : a) EXPECT_FALSE(b.contains(shirt));
        }
    }
}

TEST(Looks, AsManyWearATeamsColoursAsItHasFans) {
    constexpr double tolerance = 0.02;  // five standard deviations of 20,000 draws
    const std::set<Rgb> home = shirts_of(dressed({1, 0})), away = shirts_of(dressed({0, 1}));
    for (const Fans fans : {Fans{0.78f, 0.01f}, Fans{0.04f, 0.8f}, Fans{0.24f, 0.06f}}) {
        const std::vector<Palette> people = dressed(fans, 2);
        EXPECT_NEAR(share_in(people, home), fans.home, tolerance);
        EXPECT_NEAR(share_in(people, away), fans.away, tolerance);
    }
}

TEST(Looks, HomeIsRedAndAwayIsYellow) {
    glm::dvec3 home(0), away(0);
    for (const Palette& palette : dressed({1, 0})) home += glm::dvec3(palette[scene::shirt_slot]) / double{drawn};
    for (const Palette& palette : dressed({0, 1})) away += glm::dvec3(palette[scene::shirt_slot]) / double{drawn};
    EXPECT_GT(home.x, 1.8 * home.y);
    EXPECT_GT(away.x, 1.8 * away.z);
    EXPECT_GT(away.y, 1.4 * away.z);
}

TEST(Looks, EachEndBelongsToATeamAndTheSidesToBothsGuests) {
    constexpr float beyond = 30.0f, side = 60.0f;  // [m]
    const scene::Oval oval;
    const float end = oval.half_straight + beyond;
    for (const float z : {-30.0f, -1.0f, 1.0f, 30.0f}) {
        const Fans home = scene::fans_at(oval, {end, z});
        EXPECT_GT(home.home, 0.7f);
        EXPECT_LT(home.away, 0.05f);
    }
    const Fans away = scene::fans_at(oval, {-end, -20});
    EXPECT_GT(away.away, 0.7f);
    EXPECT_LT(away.home, 0.1f);
    for (const glm::vec2 xz : {glm::vec2(0, side), {0, -side}, {30, side}, {-30, -side}, {-end, 20}}) {
        const Fans guests = scene::fans_at(oval, xz);
        EXPECT_GT(guests.home, guests.away);
        EXPECT_GT(guests.away, 0.02f);
        EXPECT_LT(guests.home + guests.away, 0.5f);
    }
}

TEST(Looks, NobodySeemsToWearNothing) {
    constexpr double least = 25;  // of 255: a shade apart in a small picture
    for (const Fans fans : {nobodys, Fans{1, 0}, Fans{0, 1}}) {
        for (const Palette& palette : dressed(fans)) {
            ASSERT_GT(distance(palette[scene::shirt_slot], palette[scene::skin_slot]), least);
            ASSERT_GT(distance(palette[scene::trousers_slot], palette[scene::skin_slot]), least);
        }
    }
}

TEST(Looks, SkinsGoFromFairToDarkAndFairOnesAreMoreFrequent) {
    constexpr double middle = 150;  // luma between the fourth and the fifth of eight
    const std::vector<double> skins = column(dressed(nobodys), skin_slot);
    EXPECT_GT(*std::max_element(skins.begin(), skins.end()), 210);
    EXPECT_LT(*std::min_element(skins.begin(), skins.end()), 70);
    const double fair =
        static_cast<double>(std::count_if(skins.begin(), skins.end(), [](double v) { return v > middle; }));
    // Both of two draws are darker a quarter of the time.
    EXPECT_NEAR(fair / drawn, 0.75, 0.02);
}

TEST(Looks, WhoHasDarkSkinHasDarkHairAndTheFairHaveAny) {
    constexpr double middle = 150, lightest_dark_hair = 70;  // luma
    std::set<Rgb> dark, fair;
    for (const Palette& palette : dressed(nobodys)) {
        if (luma(palette[scene::skin_slot]) > middle) {
            fair.insert(rgb(palette[scene::hair_slot]));
        } else {
            dark.insert(rgb(palette[scene::hair_slot]));
            ASSERT_LT(luma(palette[scene::hair_slot]), lightest_dark_hair);
        }
    }
    EXPECT_EQ(fair.size(), 10u);
    EXPECT_EQ(dark.size(), 4u);
    for (const Rgb& hair : dark) EXPECT_TRUE(fair.contains(hair));
}

TEST(Looks, HeightsAreNormalUpToTheirLimits) {
    constexpr double average = 1.70, spread = 0.09;  // [m] of adults
    std::vector<double> heights;
    for (std::uint64_t i = 0; i < drawn; ++i) heights.push_back(scene::draw_height(sfsm::mix(i)));
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    EXPECT_NEAR(*low, 1.50, 0.01);
    EXPECT_NEAR(*high, 2.00, 0.04);
    EXPECT_NEAR(tests::mean(heights), average, 0.003);
    // A normal distribution has 68.3 % within one deviation of the mean and 95.4 % within two, half of them below it.
    const auto share = [&](double from, double to) {
        const auto within = [&](double height) { return height >= from && height < to; };
        return static_cast<double>(std::count_if(heights.begin(), heights.end(), within)) / drawn;
    };
    EXPECT_NEAR(share(average - spread, average + spread), 0.683, 0.025);
    EXPECT_NEAR(share(average - 2 * spread, average + 2 * spread), 0.954, 0.015);
    EXPECT_NEAR(share(0, average), 0.5, 0.02);
}

}  // namespace
