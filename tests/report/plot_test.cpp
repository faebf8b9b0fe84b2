// Where numbers lie in a picture, and how they are written.
#include "sfsm/report/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sfsm/report/markup.h"

namespace sfsm::report {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double rounding = 1e-9;  // relative, of a few operations on lengths far from 0

TEST(Axis, IsStraightBetweenItsEndsAndEndsThere) {
    const Axis up{-2, 8, 300, 100};  // pictures' y grows downwards
    EXPECT_EQ(up(-2), 300);
    EXPECT_EQ(up(8), 100);
    EXPECT_DOUBLE_EQ(up(3), 200);
    EXPECT_DOUBLE_EQ(up(0.5), 250);
    for (const double beyond : {8.001, 1e30, std::numeric_limits<double>::infinity()}) EXPECT_EQ(up(beyond), 100);
    for (const double beyond : {-2.001, -1e30, -std::numeric_limits<double>::infinity()}) EXPECT_EQ(up(beyond), 300);
    EXPECT_TRUE(std::isnan(up(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Ticks, AreRoundEvenAndAllThereAreInsideTheAxis) {
    for (double low : {0.0, -3.0, 17.0}) {
        for (double length = 1e-3; length < 1e6; length *= 1.37) {
            for (const int most : {3, 5, 10}) {
                const Axis axis{low, low + length};
                const std::vector<double> values = ticks(axis, most);
                ASSERT_GE(values.size(), 1u) << low << " + " << length;
                ASSERT_LE(values.size(), most + 1u);
                for (const double value : values) ASSERT_TRUE(value >= axis.low && value <= axis.high);
                if (values.size() < 2) continue;
                const double step = values[1] - values[0];
                const double leading = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-9))));
                const bool is_round =
                    std::abs(leading - 1) < 1e-6 || std::abs(leading - 2) < 1e-6 || std::abs(leading - 5) < 1e-6;
                ASSERT_TRUE(is_round) << step;
                for (const double value : values) {
                    ASSERT_NEAR(value / step, std::round(value / step), 1e-6) << "multiples of the step";
                }
                ASSERT_LT(values.front() - step, axis.low) << "none is left out";
                ASSERT_GT(values.back() + step, axis.high - rounding * length);
                ASSERT_GE(step * most, length * (1 - rounding)) << "and none would fit between";
                ASSERT_LT(step * most, 2.5 * length * (1 + rounding));
            }
        }
    }
}

TEST(Ticks, AreWrittenShort) {
    EXPECT_EQ(tick_text(0), "0");
    EXPECT_EQ(tick_text(-0.0), "0");
    EXPECT_EQ(tick_text(0.1 + 0.2), "0.3");
    EXPECT_EQ(tick_text(12.5), "12.5");
    EXPECT_EQ(tick_text(250'000), "250000");
    EXPECT_EQ(tick_text(-3), "-3");
}

TEST(Thin, HasABucketAFrameWhereTheyFit) {
    const std::vector<float> values = {3, 1, nan, 2};
    const std::vector<Bucket> buckets = thin(values, 2);
    ASSERT_EQ(buckets.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(buckets[i].begin, static_cast<std::int64_t>(i));
        EXPECT_EQ(buckets[i].end, static_cast<std::int64_t>(i) + 1);
        EXPECT_EQ(buckets[i].is_empty(), i == 2);
        if (i == 2) continue;
        EXPECT_EQ(buckets[i].low, values[i]);
        EXPECT_EQ(buckets[i].high, values[i]);
    }
    EXPECT_EQ(thin(std::vector<float>(5, 1), 2).size(), 2u) << "one frame more, and they share";
    EXPECT_TRUE(thin({}, 10).empty());
}

TEST(Thin, CoversEveryFrameOnceWithItsExtremes) {
    for (const int frames : {41, 100, 1000, 9999}) {
        std::vector<float> values;
        for (int i = 0; i < frames; ++i) values.push_back(static_cast<float>((i * 7919) % 1000) - 500);
        const std::vector<Bucket> buckets = thin(values, 20);
        ASSERT_EQ(buckets.size(), 20u);
        std::int64_t next = 0;
        for (const Bucket& bucket : buckets) {
            ASSERT_EQ(bucket.begin, next);
            ASSERT_GT(bucket.end, bucket.begin);
            next = bucket.end;
            const auto begin = values.begin() + bucket.begin, end = values.begin() + bucket.end;
            ASSERT_EQ(bucket.low, *std::min_element(begin, end));
            ASSERT_EQ(bucket.high, *std::max_element(begin, end));
            ASSERT_LE(bucket.end - bucket.begin, frames / 20 + 1) << "evenly";
        }
        ASSERT_EQ(next, frames);
    }
}

// --- The top of the axis, case by case of what plot.h says.

std::vector<float> of(float usual, int usuals, float rare, int rares) {
    std::vector<float> values(static_cast<std::size_t>(usuals), usual);
    values.insert(values.end(), static_cast<std::size_t>(rares), rare);
    return values;
}

constexpr double float_rounding = 1e-6;  // relative

TEST(FittedTop, IsAQuarterOverWhatNineteenInTwentyDoNotExceed) {
    const std::vector<float> target = {10};
    const double top = fitted_top(of(10, 90, 20, 10), target);
    EXPECT_NEAR(top, 1.05 * 20, 21 * float_rounding) << "but not over the highest time";
    EXPECT_NEAR(fitted_top(of(16, 96, 500, 4), target), 1.25 * 16, 20 * float_rounding) << "whatever a few of them are";
    EXPECT_NEAR(fitted_top(of(10, 60, 100, 40), target), 4 * 10, 40 * float_rounding) << "nor four times the median";
    EXPECT_NEAR(fitted_top(of(2, 96, 500, 4), target), 1.5 * 10, 15 * float_rounding) << "nor under the target's share";
    EXPECT_NEAR(fitted_top({}, target), 15, 15 * float_rounding);
    EXPECT_EQ(fitted_top({}, {}), 1);
    EXPECT_EQ(fitted_top(std::vector<float>{nan, nan}, std::vector<float>{nan}), 1);
}

TEST(FittedTop, IsOfTheHighestTargetThereIs) {
    const std::vector<float> targets = {10, 40, nan, 20};
    EXPECT_NEAR(fitted_top(of(5, 96, 900, 4), targets), 60, 60 * float_rounding);
    EXPECT_NEAR(fitted_top(of(5, 96, nan, 40), targets), 44, 44 * float_rounding) << "the target itself is seen";
}

// --- Markup.

TEST(Markup, PixelsAreShortAndTheNearestHundredth) {
    EXPECT_EQ(pixels(64), "64");
    EXPECT_EQ(pixels(64.5), "64.5");
    EXPECT_EQ(pixels(0.126), "0.13");
    EXPECT_EQ(pixels(-3.25), "-3.25");
    EXPECT_EQ(pixels(100), "100");
    EXPECT_EQ(pixels(-0.001), "0");
}

TEST(Markup, FiguresSayWhatTheyCannotSay) {
    EXPECT_EQ(figure(1.25, 1), "1.2");  // to even, as printf
    EXPECT_EQ(figure(2, 2), "2.00");
    EXPECT_EQ(figure(9'999'999, 0), "9999999");
    EXPECT_EQ(figure(1e7, 0), "1.00e+07");
    EXPECT_EQ(figure(-0.001, 2), "0.00");
    EXPECT_EQ(figure(std::nan(""), 2), "\u2013");
    EXPECT_EQ(figure(std::numeric_limits<double>::infinity(), 2), "\u221E");
    EXPECT_EQ(figure(-std::numeric_limits<double>::infinity(), 2), "\u2212\u221E");
}

// RFC 4648's examples.
TEST(Markup, Base64IsThatOfTheStandard) {
    const std::pair<std::string, std::string> examples[] = {{"", ""},
                                                            {"f", "Zg=="},
                                                            {"fo", "Zm8="},
                                                            {"foo", "Zm9v"},
                                                            {"foob", "Zm9vYg=="},
                                                            {"fooba", "Zm9vYmE="},
                                                            {"foobar", "Zm9vYmFy"},
                                                            {"\xFF\xFE\xFD", "//79"}};
    for (const auto& [bytes, text] : examples) EXPECT_EQ(base64(bytes), text);
}

TEST(Markup, CharactersThatAreNoneAreReplaced) {
    const std::string mark = "\xEF\xBF\xBD";
    EXPECT_EQ(escaped("a\tb\nc"), "a\tb\nc");
    EXPECT_EQ(escaped("<&>\"'"), "&lt;&amp;&gt;&quot;&#39;");
    for (const char* whole : {"\u00e9", "\u20ac", "\U0001F600", "\xF4\x8F\xBF\xBF", "\xED\x9F\xBF"})
        EXPECT_EQ(escaped(whole), whole);
    // Cut short; a bare continuation; too long; a surrogate; beyond Unicode; not for XML; a control character.
    EXPECT_EQ(escaped("\xE2\x82"), mark + mark);
    EXPECT_EQ(escaped("\x80"), mark);
    EXPECT_EQ(escaped("\xC0\x80"), mark + mark);
    EXPECT_EQ(escaped("\xE0\x9F\xBF"), mark + mark + mark);
    EXPECT_EQ(escaped("\xED\xA0\x80"), mark + mark + mark);
    EXPECT_EQ(escaped("\xF4\x90\x80\x80"), mark + mark + mark + mark);
    EXPECT_EQ(escaped("\xEF\xBF\xBE"), mark + mark + mark);
    EXPECT_EQ(escaped("\x01"), mark);
    EXPECT_EQ(json_string("a\"\\\n<"), "\"a\\u0022\\u005c\\u000a\\u003c\"");
}

TEST(Markup, ShortenedTextCountsCharactersAndKeepsThemWhole) {
    EXPECT_EQ(shortened("abc", 3), "abc");
    EXPECT_EQ(shortened("abcd", 3), "abc\u2026");
    EXPECT_EQ(shortened("\u20ac\u20ac\u20ac\u20ac", 2), "\u20ac\u20ac\u2026");
}

}  // namespace
}  // namespace sfsm::report
