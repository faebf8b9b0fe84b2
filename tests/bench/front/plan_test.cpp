#include "tests/bench/front/plan.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "render/exchange.h"
#include "tests/bench/front/compare.h"
#include "tests/bench/front/crops.h"
#include "tests/bench/front/marks.h"
#include "tests/bench/front/small_venue.h"

namespace {

using bench::front::Part;
using bench::front::plan;
using bench::front::Row;
using bench::front::Setting;
using bench::front::settings;
using bench::front::Step;

const std::set<std::string> presets{"still", "close", "medium", "remote", "wide"};

TEST(FrontPlan, EveryPresetOfEveryCrowdHasTwelvePointsOrMore) {
    constexpr int fewest = 12;
    std::map<std::pair<std::int64_t, std::string>, int> points;
    for (const Step& step : plan({}))
        if (step.setting && presets.contains(step.view)) ++points[{step.people, step.view}];
    EXPECT_EQ(points.size(), std::size(bench::front::crowds) * presets.size());
    for (const auto& [where, count] : points) EXPECT_GE(count, fewest) << where.first << where.second;
}

TEST(FrontPlan, EveryWayToDrawIsInEveryPresetAndTheDearestOfLargeCrowdsOnce) {
    std::set<std::string> families;
    for (const Setting& setting : settings()) families.insert(setting.family);
    for (const std::int64_t people : bench::front::crowds)
        for (const std::string& family : families) {
            std::set<std::string> views;
            int steps = 0;
            for (const Step& step : plan({.people = {people}, .families = {family}}))
                if (presets.contains(step.view)) {
                    views.insert(step.view);
                    ++steps;
                }
            const bool once = family == "OpenGL triangles" && people > bench::front::most_for_opengl_triangles;
            const bool never = family.starts_with("rival: ") && !bench::front::is_marked(people);
            EXPECT_EQ(views.size(), never ? 0 : once ? 1 : presets.size()) << family << people;
            EXPECT_TRUE(!once || steps == 1) << family << people;
        }
}

TEST(FrontPlan, EightMomentsOfTheTourAreSeen) {
    std::set<std::string> views;
    for (const Step& step : plan({})) views.insert(step.view);
    EXPECT_EQ(views.size(), presets.size() + bench::front::moments);
}

TEST(FrontPlan, NoTwoStepsAreOfOneRow) {
    std::set<std::string> rows;
    const std::vector<Step> steps = plan({});
    for (const Step& step : steps)
        rows.insert(std::to_string(step.people) + step.view + step.law + std::to_string(step.target_ms) + "|" +
                    (step.setting ? step.setting->family + "|" + step.setting->name : ""));
    EXPECT_EQ(rows.size(), steps.size());
    EXPECT_EQ(plan({.people = {300, 20, 300}}).size(), plan({.people = {300, 20}}).size());
}

TEST(FrontCrops, NoTwoStepsHaveOneName) {
    std::set<std::string> names;
    const std::vector<Step> steps = plan({});
    for (const Step& step : steps) {
        Row row;
        row.people = step.people;
        row.view = step.view;
        row.law = step.law;
        row.target_ms = step.target_ms;
        if (step.setting) row.family = step.setting->family;
        if (step.setting) row.setting = step.setting->name;
        names.insert(bench::front::crop_name(row));
    }
    EXPECT_EQ(names.size(), steps.size());
}

TEST(FrontPlan, LawsAreMarkedInThreeCrowds) {
    std::map<std::int64_t, int> marks;
    for (const Step& step : plan({.families = {"laws"}})) {
        EXPECT_EQ(step.setting, nullptr);
        ++marks[step.people];
    }
    // Three laws, and one as it was where that is recorded; along the path the default one by rates and by D and S.
    const int views = static_cast<int>(presets.size()), moments = bench::front::moments * 2 * 2;
    const int as_now = views * 3 * 5 + moments, with_before = views * 4 * 5 + moments;
    EXPECT_EQ(marks, (std::map<std::int64_t, int>{{20'000, with_before}, {200'000, as_now}, {1'000'000, with_before}}));
}

// As it was recorded, to the last digit; and nothing else is.
TEST(FrontPlan, WhatWasChosenBeforeRatesIsDrawnAgain) {
    int found = 0;
    for (const Step& step : plan({.people = {20'000}, .families = {"laws"}})) {
        EXPECT_EQ(step.recorded.has_value(), step.law == "before rates");
        if (!step.recorded) continue;
        EXPECT_EQ(step.recorded->rate, 0);
        if (step.view != "close" || step.target_ms != 16.6) continue;
        ++found;
        EXPECT_EQ(*step.recorded, (sfsm::Decision{sfsm::State::points, 80.295, 1.917}));
    }
    EXPECT_EQ(found, 1);
}

TEST(FrontPlan, RivalsAreInEveryPreset) {
    for (const Setting& setting : settings()) {
        if (!setting.rival) continue;
        EXPECT_TRUE(setting.family.starts_with("rival: ")) << setting.family;
        std::set<std::string> views;
        for (const Step& step : plan({.people = {20'000}, .families = {setting.family}})) views.insert(step.view);
        EXPECT_EQ(views, presets) << setting.family;
    }
}

// Which the laws that decide by rates go through, and no two have one name.
TEST(FrontSettings, RatesSpanTheExchange) {
    double least = 1e9, most = 0;
    int everywhere = 0;
    for (const Setting& setting : settings()) {
        if (setting.family != "native rates") continue;
        EXPECT_EQ(setting.decision(100).rate, setting.rate);
        least = std::min(least, setting.rate);
        most = std::max(most, setting.rate);
        everywhere += setting.where == bench::front::Where::everywhere;
    }
    EXPECT_EQ(least, render::Exchange::rate_of(0));
    EXPECT_GE(2 * most, render::Exchange::rate_of(render::Exchange::steps - 1));
    EXPECT_EQ(everywhere, 8);
}

TEST(FrontPlan, RefusesViewsAndFamiliesThatAreNotThere) {
    EXPECT_NO_THROW(check(Part{.views = {"still", "roam-4s"}, .families = {"laws", "native points"}}));
    EXPECT_THROW(check(Part{.views = {"stil"}}), std::invalid_argument);
    EXPECT_THROW(check(Part{.families = {"native"}}), std::invalid_argument);
}

// Whatever a way of drawing can draw people as, some setting has somebody drawn so.
TEST(FrontSettings, EveryRepresentationOfEveryWayIsDrawn) {
    auto& venue = bench::front::small_venue();
    const auto shots = bench::front::shots(venue.stage().place.cameras, venue.size().height);
    for (const sfsm::Drawing drawing : {sfsm::Drawing::native, sfsm::Drawing::opengl}) {
        const figures::Way& way = bench::front::way_of(drawing);
        // Choosing needs no driver: the native renderer stands for any.
        bench::Shooter shooter(venue.renderer(sfsm::Drawing::native), venue.stage().place.crowd, venue.stage(), way);
        std::set<std::string> drawn;
        for (const auto& shot : shots)
            for (const Setting& setting : settings()) {
                if (setting.drawing != drawing) continue;
                const render::View view = shot.view_now(venue.size().width, venue.size().height);
                const double range = static_cast<double>(shooter.survey(view, shot.tick).range);
                const render::Frame& frame = shooter.select(setting.decision(range), shot.tick);
                for (const render::Person& person : frame.people)
                    drawn.emplace(way.representations[person.representation].name);
                for (const auto& representation : way.representations)
                    if (representation.is_by_block && !frame.far_blocks.empty()) drawn.emplace(representation.name);
            }
        for (const auto& representation : way.representations)
            EXPECT_TRUE(drawn.contains(std::string(representation.name)))
                << sfsm::name_of(drawing) << ' ' << representation.name;
    }
}

TEST(FrontCompare, NamesWhatMovedAndNotTimes) {
    Row row;
    row.view = "close";
    row.family = "native points";
    row.setting = "S = 2";
    row.frame.flip = 0.012;
    Row other = row;
    other.frame.flip = 0.01234;
    other.work[sfsm::WorkKind::point] = 7;
    other.wall_ms = 99;
    EXPECT_EQ(bench::front::moved({{}, {row}}, {{}, {other}}),
              (std::vector<std::string>{"close, native points S = 2: points 7, committed 0",
                                        "close, native points S = 2: flip 0.01234, committed 0.01200"}));
    other = row;
    other.wall_ms = 99;
    other.frame.flip += 1e-7;  // below what is written
    EXPECT_TRUE(bench::front::moved({{}, {row}}, {{}, {other}}).empty());
    EXPECT_EQ(bench::front::moved({{}, {row}}, {}),
              std::vector<std::string>{"close, native points S = 2: committed, not found"});
    EXPECT_EQ(bench::front::moved({}, {{}, {row}}),
              std::vector<std::string>{"close, native points S = 2: found, not committed"});
}

TEST(FrontCompare, OpenGlIsComparedOnlyOfOneDriver) {
    Row row;
    row.family = "OpenGL points";
    bench::front::Machine machine;
    machine.opengl = "another";
    EXPECT_TRUE(bench::front::moved({machine, {row}}, {}).empty());
    EXPECT_EQ(bench::front::moved({machine, {row}}, {machine, {}}).size(), 1u);
}

TEST(FrontCrops, DetailIsOfTheCrowdAlone) {
    const render::Image image{3, 1, {0, 0, 0, 60, 60, 60, 0, 0, 0}};
    EXPECT_EQ(bench::front::detail_of(image, {1, 1, 1}), (std::vector<std::uint8_t>{30, 30, 0}));
    EXPECT_EQ(bench::front::detail_of(image, {0, 1, 1}), (std::vector<std::uint8_t>{0, 30, 0}));
}

TEST(FrontCrops, AreWhereMostOfTheDetailIs) {
    constexpr int width = 400, height = 300;
    std::vector<std::uint8_t> crowd(std::size_t{width} * height);
    for (int y = 150; y < 230; ++y)
        for (int x = 200; x < 320; ++x) crowd[static_cast<std::size_t>(y) * width + x] = 1;
    crowd[0] = 1;
    const bench::front::Place place = bench::front::busiest(crowd, width, height);
    EXPECT_EQ(place.x, 200);
    EXPECT_EQ(place.y, 150);
    render::Image image{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
    image.pixels[std::size_t{3} * (std::size_t{151} * width + 202) + 1] = 99;
    const render::Image crop = bench::front::cut(image, place);
    EXPECT_EQ(crop.width, bench::front::crop_width);
    EXPECT_EQ(crop.pixels[std::size_t{3} * (bench::front::crop_width + 2) + 1], 99);
}

TEST(FrontCrops, EachRowHasANameOfItsOwn) {
    Row row;
    row.people = 20'000;
    row.view = "close";
    row.family = "native mixture";
    row.setting = "D = 0.25 L, S = 1.4";
    EXPECT_EQ(bench::front::crop_name(row), "20000-close-native-mixture-D-0.25-L-S-1.4.jpg");
    row.law = "paper";
    row.target_ms = 16.6;
    EXPECT_EQ(bench::front::crop_name(row), "20000-close-paper-16.6.jpg");
}

}  // namespace
