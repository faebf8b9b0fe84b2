// What each rate would draw and lose, held against the frames that are selected by it.
#include "render/rate_forecaster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "render/select.h"
#include "sfsm/prices.h"
#include "tests/render/counted_allocations.h"
#include "tests/render/drawn_points.h"
#include "tests/render/small_scene.h"
#include "tests/render/troupe.h"

namespace {

using render::Exchange;
using render::Frame;
using render::RateForecaster;
using render::Selector;
using sfsm::WorkKind;

const figures::Way* const ways[] = {&figures::by_opengl(), &figures::natively()};

// Natively people are of more points.
const tests::SmallScene& scene_of(const figures::Way& way) {
    constexpr std::int64_t people = 12'000;
    static const tests::SmallScene few(people, 0.5), many(people, 3.0);
    return way.has_cells ? many : few;
}

struct Seen {
    std::string name;
    render::View view;
};

// Some from so far away that blocks are drawn as one.
std::vector<Seen> views_of(const tests::SmallScene& scene) {
    std::vector<Seen> views;
    for (const char* preset : {"still", "close", "medium", "remote"})
        views.push_back({preset, render::make_view(scene::aim_cameras(scene.plan).named(preset).at(0.0), 640, 360)});
    views.push_back({"above", render::make_view({{0, 1500, 300}, {0, 0, 0}, 0.4}, 640, 360)});
    views.push_back({"aside", render::make_view({{700, 250, 500}, {0, 0, 0}, 0.5}, 640, 360)});
    views.push_back({"beside", render::make_view({{300, 120, 200}, {0, 0, 0}, 0.5}, 640, 360)});
    return views;
}

sfsm::Decision at_rate(double rate) {
    sfsm::Decision decision;
    decision.rate = rate;
    return decision;
}

const sfsm::RateStep& step_at(std::span<const sfsm::RateStep> rates, double rate) {
    return *std::ranges::find(rates, rate, &sfsm::RateStep::rate);
}

double count(const sfsm::Work& work, WorkKind kind) {
    return static_cast<double>(work[kind]);
}

// Of all frames together.
struct Totals {
    sfsm::Work foreseen, drawn;
};

// Of people who are in the bin that a border runs through some are counted on the wrong side; where blocks are drawn as
// one, whole blocks.
void expect_same_counts(const sfsm::Work& foreseen, const Frame& frame, const tests::SmallScene& scene,
                        const std::string& where) {
    constexpr double share = 0.03, few = 24, blocks = 4;
    const double block = static_cast<double>(scene.crowd.size()) / static_cast<double>(scene.crowd.blocks.size());
    const bool has_blocks = !frame.far_blocks.empty() || foreseen[WorkKind::single] < frame.work[WorkKind::person];
    const double people = has_blocks ? blocks * block : few;
    const double singles = std::max(count(frame.work, WorkKind::single), 1.0);
    const auto near = [&](WorkKind kind, double of_a_person) {
        const double expected = count(frame.work, kind);
        EXPECT_NEAR(count(foreseen, kind), expected, share * expected + people * of_a_person)
            << sfsm::entry_of(kind).name << ", " << where;
    };
    near(WorkKind::triangle, few / people * static_cast<double>(scene.person.mesh.triangle_count()));
    // Where nearly all are meshes, who isn't has the most points there are.
    const bool few_points = count(frame.work, WorkKind::point) < count(frame.work, WorkKind::triangle) / 2;
    near(WorkKind::point,
         few_points ? scene.poses[0].point_count : std::max(8.0, count(frame.work, WorkKind::point) / singles));
    near(WorkKind::single, 1);
}

TEST(RateForecast, CountsWhatSelectionDraws) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = way});
        std::size_t far_blocks = 0;
        Totals all;
        for (const Seen& seen : views_of(scene)) {
            const auto rates = selector.survey(seen.view, 100).forecast.rates;
            ASSERT_GE(rates.size(), Exchange::steps);
            for (const sfsm::RateStep& step : rates) {
                const Frame& frame = selector.select(at_rate(step.rate), 99);
                far_blocks += frame.far_blocks.size();
                expect_same_counts(
                    step.work, frame, scene,
                    seen.name + ", rate " + std::to_string(step.rate) + " " + std::string(sfsm::name_of(way->drawing)));
                all.foreseen += step.work;
                all.drawn += frame.work;
            }
        }
        EXPECT_GT(far_blocks, 100u);
        for (const WorkKind kind : {WorkKind::triangle, WorkKind::point, WorkKind::single}) {
            constexpr double bias = 0.015;
            EXPECT_NEAR(count(all.foreseen, kind) / count(all.drawn, kind), 1, bias)
                << sfsm::entry_of(kind).name << ' ' << sfsm::name_of(way->drawing);
        }
    }
}

// A person isn't drawn by a part of a point.
TEST(RateForecast, CountsTheLastPointOfEverybody) {
    constexpr double fewest = figures::fewest_points + 1, few = 40;  // points a person, beside which one is much
    const figures::Way way = tests::without_blocks(figures::natively());
    const tests::SmallScene& scene = scene_of(way);
    Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = &way});
    double people = 0, too_many = 0;
    for (const Seen& seen : views_of(scene)) {
        const auto rates = selector.survey(seen.view, 100).forecast.rates;
        for (const sfsm::RateStep& step : rates) {
            const sfsm::Work& drawn = selector.select(at_rate(step.rate), 99).work;
            const double points = count(drawn, WorkKind::point), singles = count(drawn, WorkKind::single);
            if (count(drawn, WorkKind::triangle) > 0 || points > few * singles || points < fewest * singles) continue;
            people += singles;
            too_many += count(step.work, WorkKind::point) - points;
        }
    }
    ASSERT_GT(people, 1000);
    EXPECT_NEAR(too_many / people, 0, 0.2);
}

TEST(RateForecast, LosesWhatTheFrameIsExpectedTo) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = way});
        for (const Seen& seen : views_of(scene)) {
            constexpr double background = 0.02, share = 0.05, digit = 2e-6;
            const render::Survey& survey = selector.survey(seen.view, 100, {{}, nullptr, background});
            EXPECT_GE(survey.background_error, 0);  // people may cover all of it
            EXPECT_LT(survey.background_error, background);
            for (const sfsm::RateStep& step : survey.forecast.rates) {
                const double loss = selector.select(at_rate(step.rate), 99).expected_flip - survey.background_error;
                EXPECT_NEAR(step.loss, loss, share * loss + digit)
                    << seen.name << ", rate " << step.rate << ' ' << sfsm::name_of(way->drawing);
            }
        }
    }
}

// Who moves when is by chance: over as many ticks as the longest period it is what was foreseen.
void expect_as_many_move(Selector& selector, const Seen& seen, int step, const std::string& where) {
    const double rate = Exchange::rate_of(step);
    double foreseen = 0, moved = 0;
    for (std::int64_t tick = 100; tick < 100 + motion::max_period; ++tick) {
        const auto rates = selector.survey(seen.view, tick).forecast.rates;
        foreseen += count(step_at(rates, rate).work, WorkKind::motion_update);
        moved += count(selector.select(at_rate(rate), tick - 1).work, WorkKind::motion_update);
    }
    foreseen /= motion::max_period;
    moved /= motion::max_period;
    constexpr double share = 0.06, people = 4;  // blocks that a class' border runs through
    EXPECT_NEAR(foreseen, moved, share * moved + people) << seen.name << ", rate " << rate << ' ' << where;
}

TEST(RateForecast, CountsWhoMovesOnAverage) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        const std::string name(sfsm::name_of(way->drawing));
        Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = way});
        Selector limited(scene.crowd, scene.cast, scene.figures(), {.way = way, .max_error = 2});
        for (const Seen& seen : views_of(scene)) {
            for (int step = 1; step < Exchange::steps; step += 5) expect_as_many_move(selector, seen, step, name);
            expect_as_many_move(limited, seen, Exchange::steps - 1, name + " under a limit");
        }
    }
}

// Cells of another size are other work at once: a rate just below is foreseen by itself.
TEST(RateForecast, ForeseesBothSidesOfAChangeOfCells) {
    const figures::Way& way = figures::natively();
    const tests::SmallScene& scene = scene_of(way);
    Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = &way});
    int changes = 0;
    for (const Seen& seen : views_of(scene)) {
        const auto rates = selector.survey(seen.view, 100).forecast.rates;
        for (std::size_t i = 1; i < rates.size(); ++i) {
            if (!(rates[i].rate < sfsm::least_rise * rates[i - 1].rate)) continue;
            ++changes;
            const double coarser = count(selector.select(at_rate(rates[i].rate), 99).work, WorkKind::point);
            const double finer = count(selector.select(at_rate(rates[i - 1].rate), 99).work, WorkKind::point);
            const double between =
                count(selector.select(at_rate(0.5 * (rates[i].rate + rates[i - 1].rate)), 99).work, WorkKind::point);
            EXPECT_LT(coarser, 0.9 * finer) << seen.name;
            EXPECT_NEAR(between, finer, 0.01 * finer) << seen.name;
        }
    }
    EXPECT_GT(changes, 1);
}

TEST(RateForecast, CellsThatTakeMoreThanTheySaveStayAPixel) {
    figures::Way way = figures::natively();
    const tests::SmallScene& scene = scene_of(way);
    const auto changes = [&](double resampling) {
        way.effort.resampling = resampling;
        Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = &way});
        std::size_t steps = 0;
        for (const Seen& seen : views_of(scene))
            steps += selector.survey(seen.view, 100).forecast.rates.size() - Exchange::steps;
        return steps;
    };
    constexpr double triangles_a_cell = 1000;
    EXPECT_GT(changes(0), 0u);
    EXPECT_EQ(changes(triangles_a_cell), 0u);
}

TEST(RateForecast, LosesMoreAndCostsLessAlongTheRates) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = way});
        for (const Seen& seen : views_of(scene)) {
            const auto rates = selector.survey(seen.view, 100).forecast.rates;
            for (std::size_t i = 1; i < rates.size(); ++i) {
                const auto pieces = [&](const sfsm::RateStep& step) {
                    return sfsm::cost_of(step.work, {0, way->pieces});
                };
                EXPECT_GT(rates[i].rate, rates[i - 1].rate);
                EXPECT_GE(rates[i].loss, rates[i - 1].loss);
                EXPECT_LE(pieces(rates[i]), pieces(rates[i - 1]) + 4)  // counts are whole
                    << seen.name << ", rate " << rates[i].rate << ' ' << sfsm::name_of(way->drawing);
                EXPECT_LE(rates[i].motion_distance, rates[i - 1].motion_distance);
                EXPECT_LE(rates[i].splat_size, sfsm::max_splat_size);
                const auto state = rates[i].splat_size > 0                   ? sfsm::State::points
                                   : std::isfinite(rates[i].motion_distance) ? sfsm::State::slowed
                                                                             : sfsm::State::original;
                EXPECT_EQ(rates[i].state, state);
            }
            EXPECT_EQ(rates.back().state, sfsm::State::points) << seen.name;
        }
    }
}

// D is the nearest who moves less often; and nobody does before it.
TEST(RateForecast, HasTheDistanceFromWhichSomebodyMovesLessOften) {
    const figures::Way& way = figures::natively();
    const tests::SmallScene& scene = scene_of(way);
    const auto staleness = render::measure_staleness(scene.crowd, scene.cast, scene.figures());
    const figures::Choices choices(scene.figures()[0], way);
    const render::ErrorBounds bounds;
    RateForecaster forecaster(
        {{{&choices, static_cast<double>(scene.poses[0].area), static_cast<double>(scene.poses[0].rest_height)},
          staleness[0],
          &bounds,
          1}},
        way);
    const render::View view = render::make_view({{0, 0, 0}, {0, 0, -1}, 0.8}, 640, 360);
    forecaster.begin(view, {});
    for (float depth = 4; depth < 400; depth *= 1.05f) {
        const float pixels = view.pixels_per_metre(depth);
        forecaster.add({.people = 10, .depth = depth, .pixels_per_metre = pixels, .surface = 1.9f * pixels * pixels});
    }
    int slowed = 0;
    for (const sfsm::RateStep& step : forecaster.finish()) {
        render::Paces paces;
        forecaster.find_paces(step.rate, paces);
        double nearest = std::numeric_limits<double>::infinity();
        for (float depth = 4; depth < 400; depth *= 1.05f)
            if (paces.period(0, scene::Role::spectator, view.pixels_per_metre(depth)) > 1)
                nearest = std::min(nearest, static_cast<double>(depth));
        if (std::isinf(nearest)) {
            EXPECT_TRUE(std::isinf(step.motion_distance));
            continue;
        }
        ++slowed;
        EXPECT_NEAR(step.motion_distance, nearest, 0.051);  // a tenth of a metre is told
    }
    EXPECT_GT(slowed, 5);
}

// People who are all points: S is by the usual density that of their number.
TEST(RateForecast, HasTheSizeOfAsManyPoints) {
    for (const figures::Way* drawing : ways) {
        const figures::Way one_by_one = tests::without_blocks(*drawing), *way = &one_by_one;
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = way});
        const Seen seen = views_of(scene)[0];
        const auto rates = selector.survey(seen.view, 100).forecast.rates;
        int compared = 0;
        for (const sfsm::RateStep& step : rates) {
            const Frame& frame = selector.select(at_rate(step.rate), 99);
            double surface = 0, points = 0;
            for (const render::Person& person : frame.people) {
                if (way->representations[person.representation].is_mesh) continue;
                const double pixels =
                    static_cast<double>(person.instance.scale * frame.view.pixels_per_metre(person.depth));
                surface += static_cast<double>(scene.poses[0].area) * pixels * pixels;
                points += person.count;
            }
            if (points < 1000) continue;
            ++compared;
            const double size = std::min(std::sqrt(1.2 * surface / points), sfsm::max_splat_size);
            EXPECT_NEAR(step.splat_size, size, 0.03 * size) << "rate " << step.rate;
        }
        EXPECT_GT(compared, 0);
    }
}

// So many characters, of each a forecaster's people are as many.
struct Troupe : tests::Troupe {
    explicit Troupe(std::size_t count) : tests::Troupe(count, 200, 600) {}

    RateForecaster::Group group(std::size_t kind, float depth) const {
        const float pixels = view.pixels_per_metre(depth);
        return {.kind = kind,
                .people = 3,
                .is_block = depth > 300,
                .depth = depth,
                .pixels_per_metre = pixels,
                .surface = 1.9f * pixels * pixels,
                .share = 0.5f,
                .place = Exchange::place_of(0.5f)};
    }
    // Of one kind, or of all.
    std::vector<sfsm::RateStep> forecast(std::optional<std::size_t> only = {}) {
        forecaster.begin(view, {});
        for (std::size_t kind = 0; kind < characters.size(); ++kind)
            for (float depth = 5; depth < 900 && (!only || *only == kind); depth *= 1.1f)
                forecaster.add(group(kind, depth));
        const auto rates = forecaster.finish();
        std::vector<sfsm::RateStep> steps;
        for (int step = 0; step < Exchange::steps; ++step) steps.push_back(step_at(rates, Exchange::rate_of(step)));
        return steps;
    }
};

// Apart from the cells, in which all are together, each is drawn as alone: at low rates, in cells of a pixel.
TEST(RateForecast, OfManyCharactersIsTheSumOfThem) {
    constexpr std::size_t characters = 64;
    Troupe troupe(characters);
    const std::vector<sfsm::RateStep> together = troupe.forecast();
    const double canvas = troupe.forecaster.canvas_px();  // losses are of one that grows where people fill it
    std::vector<sfsm::RateStep> sum(together.size());
    std::vector<std::size_t> cells(together.size());  // the largest of somebody alone
    const auto note_cells = [&] {
        for (std::size_t i = 0; i < cells.size(); ++i)
            cells[i] = std::max(cells[i], troupe.forecaster.cell_of(together[i].rate));
    };
    note_cells();
    for (std::size_t kind = 0; kind < characters; ++kind) {
        const std::vector<sfsm::RateStep> alone = troupe.forecast(kind);
        for (std::size_t i = 0; i < alone.size(); ++i) {
            sum[i].work += alone[i].work;
            sum[i].loss += alone[i].loss * troupe.forecaster.canvas_px() / canvas;
        }
        note_cells();
    }
    int compared = 0;
    for (std::size_t i = 0; i < together.size(); ++i) {
        if (cells[i] > 0) continue;
        ++compared;
        for (const WorkKind kind : {WorkKind::triangle, WorkKind::point, WorkKind::single, WorkKind::motion_update})
            EXPECT_NEAR(count(together[i].work, kind), count(sum[i].work, kind), characters)
                << sfsm::entry_of(kind).name << ", rate " << together[i].rate;
        EXPECT_NEAR(together[i].loss, sum[i].loss, 1e-6 * characters);
    }
    EXPECT_GT(compared, 3);
}

TEST(RateForecast, AllocatesNothingAfterTheFirstFrames) {
    Troupe troupe(64);
    render::Paces paces;
    const auto frame = [&] {
        troupe.forecaster.begin(troupe.view, {});
        for (std::size_t kind = 0; kind < troupe.characters.size(); ++kind)
            for (float depth = 5; depth < 900; depth *= 1.1f) troupe.forecaster.add(troupe.group(kind, depth));
        troupe.forecaster.finish();
        troupe.forecaster.find_paces(0.3, paces);
    };
    frame();
    const std::size_t before = tests::allocations();
    for (int i = 0; i < 3; ++i) frame();
    EXPECT_EQ(tests::allocations(), before);
}

TEST(RateForecast, ForgetsTheFrameBefore) {
    Troupe troupe(3);
    const std::vector<sfsm::RateStep> first = troupe.forecast();
    EXPECT_GT(troupe.forecaster.covered(), 0);
    EXPECT_EQ(troupe.forecast(), first);
    troupe.forecaster.begin(troupe.view, {});
    for (const sfsm::RateStep& step : troupe.forecaster.finish()) {
        EXPECT_EQ(step.work, sfsm::Work{});
        EXPECT_EQ(step.loss, 0);
        EXPECT_EQ(step.splat_size, 0);
        EXPECT_TRUE(std::isinf(step.motion_distance));
        EXPECT_EQ(step.state, sfsm::State::original);
    }
    EXPECT_EQ(troupe.forecaster.covered(), 0);
    render::Paces paces;
    troupe.forecaster.find_paces(1, paces);
    EXPECT_EQ(paces.period(2, scene::Role::spectator, 5), 1);
    EXPECT_EQ(troupe.forecast(), first);
}

}  // namespace
