// The exchange's tables, held against trying everything.
#include "render/exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sfsm/random.h"
#include "tests/figures/counted_character.h"

namespace {

using render::Exchange;

constexpr double infinite = std::numeric_limits<double>::infinity();
const figures::Way* const ways[] = {&figures::by_opengl(), &figures::natively()};

constexpr float found = 1e-4f;  // [octaves] to which sizes are searched for

// All of them at once, in metres and in centimetres.
struct Market {
    const figures::Way& way;
    std::vector<tests::CountedCharacter> characters;
    std::vector<Exchange::Kind> kinds;
    Exchange exchange;

    explicit Market(const figures::Way& by) : way(by) {
        characters.reserve(9);  // kinds point to them
        for (const std::size_t triangles : {12u, 1300u, 50'000u})
            for (const int points : {0, 64, 4096}) characters.emplace_back(triangles, points, way);
        double unit = 1;
        for (const tests::CountedCharacter& character : characters) {
            kinds.push_back({&character.choices, 1.9 * unit * unit, 1.65 * unit});
            unit = unit == 1 ? 100 : 1;
        }
        exchange = Exchange(kinds, way);
    }
};

// What somebody costs: J of exchange.h, in double.
struct Person {
    const Market& market;
    std::size_t kind;
    double rate, share, surface, cell;  // [px / piece], (0, 1], [px^2], [px]

    const figures::Way& way() const { return market.way; }
    double height() const { return market.kinds[kind].height * std::sqrt(surface / market.kinds[kind].area); }
    double together(double error, double work) const { return share * surface / 4 * error + rate * work; }
    double most_points() const { return static_cast<double>(market.characters[kind].choices.most_samples()); }

    double as_mesh() const {
        return together(way().error.of_mesh(height()),
                        way().effort.single + way().effort.triangle * market.characters[kind].triangles());
    }
    double as_points(double count) const {
        return together(way().error.of_points(std::sqrt(surface / count), cell),
                        way().effort.single + way().effort.point * count);
    }
    // Of a block, which is drawn as one only where its people are small (render/select.cpp).
    bool may_be_splat() const {
        return market.characters[kind].choices.block_reach() >= 0 && height() <= Exchange::tallest_splat;
    }
    double as_splat() const {
        if (!may_be_splat()) return infinite;
        return together(way().error.of_splat(height()) * way().error.times_in_cells(cell), way().effort.splat);
    }
    // Of points that are so far apart [px].
    double as_points_apart(double spacing) const {
        const double fewest = std::min<double>(figures::fewest_points, most_points());
        return most_points() > 0 ? as_points(std::clamp(surface / (spacing * spacing), fewest, most_points()))
                                 : infinite;
    }
    double as_best_points() const {
        double least = infinite;
        const auto all = static_cast<int>(most_points());
        for (int count = std::min<int>(figures::fewest_points, all); count <= all; ++count)
            if (count > 0) least = std::min(least, as_points(count));
        return least;
    }
};

std::string text_of(const Person& person) {
    return std::to_string(person.market.characters[person.kind].triangles()) + " triangles, " +
           std::to_string(person.most_points()) + " points, rate " + std::to_string(person.rate) + ", share " +
           std::to_string(person.share) + ", " + std::to_string(person.surface) + " px^2, cell " +
           std::to_string(person.cell);
}

// Numbers by chance.
struct Draws {
    std::uint64_t drawn = 0;
    std::uint64_t next() { return sfsm::stream(7, drawn++); }
    std::size_t below(std::size_t count) { return sfsm::below(next(), static_cast<std::uint32_t>(count)); }
    double by_logarithm(double from, double to) { return from * std::pow(to / from, sfsm::unit(next())); }
};

TEST(Exchange, ChoosesWithinSevenPerCentOfTheBestOfEverything) {
    constexpr double slack = 1.07;  // between steps, half an octave apart, and with points no nearer than 0.3 px
    constexpr int tries = 6000;
    for (const figures::Way* way : ways) {
        const Market market(*way);
        Draws draws;
        int points = 0, meshes = 0, splats = 0;
        for (int i = 0; i < tries; ++i) {
            const std::size_t cell = draws.below(market.exchange.cells().size());
            const Person person{market,
                                draws.below(market.kinds.size()),
                                draws.by_logarithm(Exchange::rate_of(0), Exchange::rate_of(Exchange::steps - 1)),
                                draws.by_logarithm(1.0 / 16, 1),
                                draws.by_logarithm(0.1, 1e6),
                                market.exchange.cells()[cell]};
            Exchange::Terms terms;
            market.exchange.find_terms(person.rate, cell, terms);
            const auto sizes = terms.sizes(person.kind, Exchange::place_of(static_cast<float>(person.share)));
            const auto spacing = static_cast<double>(sizes.spacing);
            // Points of a frame that are all as large are as dense for everybody: then theirs is the spacing to beat.
            const double best_points = way->has_cells ? person.as_best_points() : person.as_points_apart(spacing);
            const bool is_mesh = person.surface >= static_cast<double>(sizes.mesh_from);
            const double alone = is_mesh ? person.as_mesh() : person.as_points_apart(spacing);
            ASSERT_LE(alone, slack * std::min(best_points, person.as_mesh())) << text_of(person);
            const bool is_splat = person.may_be_splat() && person.surface <= static_cast<double>(sizes.splat_to);
            ASSERT_LE(is_splat ? person.as_splat() : alone,
                      slack * std::min({best_points, person.as_mesh(), person.as_splat()}))
                << text_of(person);
            (is_splat ? splats : is_mesh ? meshes : points) += 1;
        }
        EXPECT_GT(std::min({points, meshes, splats}), tries / 20);
    }
}

// Where all points of a frame are as large, of whom a third shows.
TEST(Exchange, SpacesThePointsOfAFrameAsAThirdOfAPersonAsks) {
    const Market market(figures::by_opengl());
    for (int step = 0; step < Exchange::steps; ++step) {
        constexpr double share = 0.35355339059327379;
        constexpr std::size_t with_many_points = 8;
        const Person person{market, with_many_points, Exchange::rate_of(step), share, 2000, 1};
        const Exchange::Terms& terms = market.exchange.at_step(step, 0);
        EXPECT_LE(person.as_points_apart(static_cast<double>(terms.spacing)), 1.005 * person.as_best_points()) << step;
        for (const float spacing : terms.spacings) EXPECT_FLOAT_EQ(std::exp2(spacing), terms.spacing);
    }
}

TEST(Exchange, SpacesPointsWiderAtAHigherRate) {
    for (const figures::Way* way : ways) {
        const Market market(*way);
        for (std::size_t cell = 0; cell < market.exchange.cells().size(); ++cell)
            for (int step = 1; step < Exchange::steps; ++step) {
                const Exchange::Terms &low = market.exchange.at_step(step - 1, cell),
                                      &high = market.exchange.at_step(step, cell);
                for (std::size_t i = 0; i < low.spacings.size(); ++i)
                    EXPECT_GE(high.spacings[i], low.spacings[i] - found) << "step " << step << ", cell " << cell;
            }
    }
}

// Of whose points all together are much less work than their triangles. Others may better be meshes at a higher rate.
TEST(Exchange, MakesFewerMeshesAndMoreSplatsAtAHigherRate) {
    for (const figures::Way* way : ways) {
        const Market market(*way);
        const std::size_t kinds = market.kinds.size();
        for (std::size_t cell = 0; cell < market.exchange.cells().size(); ++cell)
            for (int step = 1; step < Exchange::steps; ++step)
                for (std::size_t i = 0; i < kinds * Exchange::shares; ++i) {
                    const tests::CountedCharacter& character = market.characters[i % kinds];
                    if (2 * way->effort.point * static_cast<double>(character.choices.most_samples()) >
                        way->effort.triangle * character.triangles())
                        continue;
                    const Exchange::Terms &low = market.exchange.at_step(step - 1, cell),
                                          &high = market.exchange.at_step(step, cell);
                    EXPECT_GE(high.meshes_from[i], low.meshes_from[i] - found) << "step " << step << ", cell " << cell;
                    EXPECT_GE(high.splats_to[i], low.splats_to[i] - found) << "step " << step << ", cell " << cell;
                }
    }
}

TEST(Exchange, MakesNobodyASplatWhoIsTaller) {
    constexpr double rounding = 1e-4;
    for (const figures::Way* way : ways) {
        const Market market(*way);
        double tallest = 0;
        for (std::size_t cell = 0; cell < market.exchange.cells().size(); ++cell)
            for (int step = 0; step < Exchange::steps; ++step)
                for (std::size_t kind = 0; kind < market.kinds.size(); ++kind)
                    for (float place = 0; place <= Exchange::shares - 1; place += 0.5f) {
                        const auto sizes = market.exchange.at_step(step, cell).sizes(kind, place);
                        const auto surface = static_cast<double>(sizes.splat_to);
                        tallest = std::max(tallest, Person{market, kind, 0, 1, surface, 1}.height());
                    }
        EXPECT_NEAR(tallest, Exchange::tallest_splat, rounding * Exchange::tallest_splat);
    }
}

bool is_between(float a, float b, float value) {
    constexpr float rounding = 1e-5f;
    return value >= std::min(a, b) - rounding && value <= std::max(a, b) + rounding;
}

TEST(Exchange, BetweenStepsLiesBetweenThem) {
    const Market market(figures::natively());
    for (std::size_t cell = 0; cell < market.exchange.cells().size(); ++cell)
        for (int step = 0; step + 1 < Exchange::steps; ++step)
            for (const double part : {0.1, 0.5, 0.9}) {
                const double low = Exchange::rate_of(step), high = Exchange::rate_of(step + 1);
                Exchange::Terms terms;
                market.exchange.find_terms(low * std::pow(high / low, part), cell, terms);
                const Exchange::Terms &a = market.exchange.at_step(step, cell),
                                      &b = market.exchange.at_step(step + 1, cell);
                EXPECT_EQ(terms.cell, a.cell);
                EXPECT_TRUE(is_between(a.spacing, b.spacing, terms.spacing));
                for (std::size_t i = 0; i < a.spacings.size(); ++i)
                    EXPECT_TRUE(is_between(a.spacings[i], b.spacings[i], terms.spacings[i]));
                for (std::size_t i = 0; i < a.meshes_from.size(); ++i) {
                    EXPECT_TRUE(is_between(a.meshes_from[i], b.meshes_from[i], terms.meshes_from[i]));
                    EXPECT_TRUE(is_between(a.splats_to[i], b.splats_to[i], terms.splats_to[i]));
                }
            }
}

TEST(Exchange, KnowsItsStepsByTheirRates) {
    for (int step = 0; step < Exchange::steps; ++step) {
        EXPECT_EQ(Exchange::step_below(Exchange::rate_of(step)), step);
        if (step + 1 < Exchange::steps) {
            EXPECT_EQ(Exchange::step_below(0.9 * Exchange::rate_of(step) + 0.1 * Exchange::rate_of(step + 1)), step);
            EXPECT_LT(Exchange::rate_of(step), Exchange::rate_of(step + 1));
        }
    }
}

TEST(Exchange, TakesAnyRateAndShare) {
    const Market market(figures::natively());
    constexpr int last = Exchange::steps - 1;
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [rate, step] :
         {std::pair{0.0, 0}, {-1.0, 0}, {1e-300, 0}, {not_a_number, 0}, {1e9, last}, {1e300, last}, {infinite, last}}) {
        EXPECT_EQ(Exchange::step_below(rate), step) << rate;
        Exchange::Terms terms;
        market.exchange.find_terms(rate, 0, terms);
        const Exchange::Terms& expected = market.exchange.at_step(step, 0);
        for (std::size_t i = 0; i < terms.spacings.size(); ++i)
            EXPECT_NEAR(terms.spacings[i], expected.spacings[i], 1e-3) << rate;
    }
    for (const auto& [share, place] : {std::pair{1.0f, 0.0f}, {0.5f, 2.0f}, {2.0f, 0.0f}, {0.0f, 8.0f}})
        EXPECT_FLOAT_EQ(Exchange::place_of(share), place) << share;
    const float of_nothing = Exchange::place_of(std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(of_nothing >= 0 && of_nothing <= Exchange::shares - 1);
}

}  // namespace
