// One person, or a few who stand apart: when they are seen, how they are drawn, how old their motion is, and what the
// forecast says that loses. All expectations are worked out here, in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "render/select.h"
#include "tests/render/drawn_points.h"
#include "tests/render/lone_person.h"
#include "tests/render/small_scene.h"

namespace {

using render::Selector;
using sfsm::Decision;
using sfsm::State;

constexpr int width = 640, height = 360;
constexpr float body_half = 0.25f;  // [m]

render::View view_from(glm::dvec3 position, glm::dvec3 along, double fov_y = 0.9) {
    return render::make_view({position, position + along, fov_y}, width, height);
}

// A still figure of this breadth and depth [m] shows if one of its box' corners does or, in views narrower than it, one
// of many spots in it.
bool some_spot_shows(const render::View& view, glm::dvec3 feet, glm::dvec2 half) {
    constexpr int steps = 12;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j)
            for (int k = 0; k <= steps; ++k) {
                const glm::dvec3 spot =
                    feet + glm::dvec3(half.x * (2.0 * i / steps - 1), 1.8 * j / steps, half.y * (2.0 * k / steps - 1));
                const glm::dvec3 seen = spot - view.position;
                const double depth = glm::dot(seen, glm::dvec3(view.forward));
                if (depth > render::near_plane &&
                    std::abs(glm::dot(seen, glm::dvec3(view.right))) < depth * view.tan_half_x &&
                    std::abs(glm::dot(seen, glm::dvec3(view.up))) < depth * view.tan_half_y)
                    return true;
            }
    return false;
}

struct Views {
    int shown = 0, kept = 0;  // of those where they show, and where they are selected
};

// Looks near and far past somebody of this breadth and depth [m]: they must be selected wherever they show.
Views look_past(glm::vec2 half) {
    const glm::vec3 feet(3, 1, -2);
    model::Character character = tests::make_lift(half.x, 0, 0.5, 1);
    for (glm::vec3& position : character.mesh.positions) position.z *= half.y / half.x;
    // One wide block as well, so that the person is judged and not their block.
    tests::LonePeople lone(std::move(character), {&feet, 1});
    lone.crowd.blocks[0].box = {feet - 50.0f, feet + 50.0f};
    Selector selector(lone.crowd, lone.cast, lone.figures());
    std::mt19937_64 random(1);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    Views views;
    for (int i = 0; i < 4000; ++i) {
        const double azimuth = 6.283 * unit(), elevation = 1.2 * unit() - 0.6, distance = 0.3 + 12 * unit() * unit();
        const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                              std::cos(azimuth) * std::cos(elevation));
        const glm::dvec3 camera = glm::dvec3(feet) + glm::dvec3(0, 0.9, 0) + distance * back;
        const glm::dvec3 askew(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
        const render::View view = view_from(camera, askew - back);
        const std::int64_t selected = selector.survey(view, 0).forecast.frame[sfsm::WorkKind::person];
        const bool shows = some_spot_shows(view, feet, half);
        EXPECT_TRUE(selected == 1 || !shows) << "view " << i;
        views.shown += shows;
        views.kept += selected == 1;
    }
    return views;
}

TEST(LonePerson, IsSelectedAtEveryEdgeOfTheView) {
    const Views views = look_past({body_half, body_half});
    // The ball around a standing body is loose at its sides; looser it would be of no use.
    EXPECT_LT(views.kept, views.shown + views.shown / 4);
}

// Such as beasts are.
TEST(LonePerson, IsSelectedHoweverLongOrBroad) {
    EXPECT_GT(look_past({0.2f, 1.6f}).shown, 1000);
    EXPECT_GT(look_past({1.6f, 0.2f}).shown, 1000);
}

TEST(LonePerson, IsDrawnWholeByWhoeverStandsInThem) {
    const glm::vec3 feet(0, 0, 0);
    const tests::LonePeople lone(tests::make_lift(body_half, 0, 0.5, 8), {&feet, 1}, 4000);
    Selector selector(lone.crowd, lone.cast, lone.figures());
    for (const double ahead : {-0.2, -0.05, 0.0, 0.05, 0.1}) {
        // Their middle is behind the camera or just before it, their front in view.
        const render::View view = view_from({0, 0.9, ahead}, {0, 0, 1}, 1.4);
        const render::Survey& survey = selector.survey(view, 0);
        ASSERT_EQ(survey.forecast.frame[sfsm::WorkKind::person], 1) << ahead;
        EXPECT_GE(survey.range, 1);
        for (const sfsm::Step& step : survey.forecast.shapes) {
            EXPECT_GE(step.loss_px, 0);
            EXPECT_EQ(step.work[sfsm::WorkKind::point], 0) << "S = " << step.setting;
        }
        const render::Frame& selection = selector.select({State::points, 10, 32}, -1);
        ASSERT_EQ(selection.people.size(), 1u);
        EXPECT_EQ(tests::points_of(selection.people[0]), 0u) << "millimetres away nothing but triangles will do";
    }
}

figures::Way at_price(double of_a_point) {
    figures::Way way = figures::by_opengl();
    way.pieces[sfsm::index_of(sfsm::WorkKind::point)] = of_a_point;
    return way;
}

Selector selector_of(const tests::LonePeople& lone, const figures::Way& way = figures::by_opengl()) {
    return {lone.crowd, lone.cast, lone.figures(), {.way = &way}};
}

// The number of points that the only person has at view depth `depth` under S.
std::uint32_t points_at(Selector& selector, double depth, double splat_size) {
    selector.survey(view_from({0, 0.9, depth}, {0, 0, -1}), 0);
    const render::Frame& selection = selector.select({State::points, 10, splat_size}, -1);
    return selection.people.size() == 1 ? tests::points_of(selection.people[0]) : ~0u;
}

TEST(LonePerson, HasTwoPointsHoweverSmall) {
    const glm::vec3 feet(0, 0, 0);
    const tests::LonePeople lone(tests::make_lift(body_half, 0, 0.5, 8), {&feet, 1}, 4000);
    Selector selector = selector_of(lone);
    for (const double depth : {900.0, 3000.0, 30000.0})
        for (const double splat_size : {1.0, 8.0, 32.0}) EXPECT_EQ(points_at(selector, depth, splat_size), 2u);
}

// 1.2 points for each splat-sized square of the whole surface, and no more than the next number on the ladder.
TEST(LonePerson, HasAsManyPointsAsTheirSurfaceHasSquares) {
    const glm::vec3 feet(0, 0, 0);
    const tests::LonePeople lone(tests::make_lift(body_half, 0, 0.5, 40), {&feet, 1}, 8000);
    Selector selector = selector_of(lone);
    const double area = 4 * 1.8 * 2 * body_half + 2 * std::pow(2 * body_half, 2);  // [m^2]
    for (double depth = 6; depth < 200; depth *= 1.13) {
        for (const double splat_size : {0.8, 1.0, 2.7, 9.0}) {
            const double pixels = height / (2 * std::tan(0.45) * depth);
            const double wanted = 1.2 * area * pixels * pixels / (splat_size * splat_size);
            const std::uint32_t points = points_at(selector, depth, splat_size);
            if (wanted > 6100) continue;  // near the end of the model
            EXPECT_GE(points, std::max(2.0, 0.999 * wanted)) << depth << " m, S = " << splat_size;
            EXPECT_LE(points, std::max(2.0, 1.51 * wanted)) << depth << " m, S = " << splat_size;
        }
    }
}

TEST(LonePerson, HasNoMorePointsThanTheirTrianglesAreWorth) {
    const glm::vec3 feet(0, 0, 0);
    const tests::LonePeople lone(tests::make_lift(body_half, 0, 0.5, 4), {&feet, 1}, 4000);
    const auto triangles = static_cast<std::uint32_t>(lone.character.mesh.triangle_count());
    ASSERT_EQ(triangles, 192u);
    for (const float price : {1.0f, 2.0f, 5.0f}) {
        const figures::Way way = at_price(static_cast<double>(price));
        Selector selector = selector_of(lone, way);
        std::uint32_t most = 0;
        bool changed = false;
        for (double depth = 1000; depth > 1; depth *= 0.93) {
            const std::uint32_t points = points_at(selector, depth, 2);
            ASSERT_NE(points, ~0u);
            EXPECT_LE(price * static_cast<float>(points), static_cast<float>(triangles)) << depth << " m";
            EXPECT_TRUE(points == 0 || !changed) << "nearer than triangles there are no points again";
            changed |= points == 0;
            most = std::max(most, points);
        }
        EXPECT_TRUE(changed);
        EXPECT_GT(price * static_cast<float>(most), 0.6f * static_cast<float>(triangles)) << "price " << price;
    }
}

// A model of fewer points than its triangles are worth.
TEST(LonePerson, HasNoMorePointsThanTheirModel) {
    const glm::vec3 feet(0, 0, 0);
    for (const std::size_t model : {48u, 50u, 63u, 64u}) {  // and all of them, where the ladder has that number
        const tests::LonePeople lone(tests::make_lift(body_half, 0, 0.5, 20), {&feet, 1}, model);
        Selector selector = selector_of(lone);
        std::uint32_t most = 0;
        for (double depth = 1000; depth > 1; depth *= 0.93) most = std::max(most, points_at(selector, depth, 2));
        EXPECT_EQ(most, model == 64 ? 64u : 48u) << model;
    }
}

// Between two updates nothing of a person changes, not a bit, wherever they go meanwhile.
TEST(LonePerson, StaysAsTheyWereUntilTheyAreDue) {
    for (const scene::Role role : {scene::Role::standing, scene::Role::walker}) {
        // A walker's place is its lane's offset and its arc.
        const glm::vec3 place = role == scene::Role::walker ? glm::vec3(1, 0, 12) : glm::vec3(0, 0, 40);
        tests::LonePeople lone(tests::make_lift(body_half, 0.5f, 4, 1), {&place, 1});
        lone.crowd.role[0] = role;
        lone.crowd.blocks[0].box = {glm::vec3(-200), glm::vec3(200)};
        Selector selector(lone.crowd, lone.cast, lone.figures());
        const render::View view = view_from({-30, 30, -100}, {0.1, -0.25, 1}, 1.2);
        const Decision decision{State::slowed, 1, 0};
        render::Instance last{};
        std::uint32_t last_pose = 0;
        int moves = 0, period = 0, since = 0;
        for (std::int64_t tick = 500; tick < 700; ++tick) {
            selector.survey(view, tick);
            const render::Frame& selection = selector.select(decision, tick - 1);
            ASSERT_EQ(selection.people.size(), 1u);
            const bool moved = selection.work[sfsm::WorkKind::motion_update] == 1;
            if (tick > 500 && !moved) {
                EXPECT_EQ(std::memcmp(&last, &selection.people[0].instance, sizeof last), 0) << "tick " << tick;
                EXPECT_EQ(last_pose, selection.people[0].pose) << "tick " << tick;
            }
            if (moved) {
                // When they move, they are where and how they are at that very tick.
                selector.survey(view, tick);
                const render::Frame& now = selector.select({}, tick - 1);
                EXPECT_EQ(std::memcmp(&selection.people[0].instance, &now.people[0].instance, sizeof last), 0)
                    << "tick " << tick;
                selector.survey(view, tick);
                if (moves > 1) {
                    EXPECT_NEAR(since, period, 1) << "a period changes as slowly as the depth";
                }
                period = since;
                since = 0;
                ++moves;
            }
            ++since;
            last = selector.select(decision, tick - 1).people[0].instance;
            last_pose = selector.select(decision, tick - 1).people[0].pose;
        }
        EXPECT_GT(moves, 10);
        EXPECT_LT(moves, 60);
    }
}

// People in a row away from the camera, whose surface all moves at one speed: what the forecast says that a motion
// distance loses is how far, on average over them and over time, their picture is from where it should be.
TEST(Forecast, LossOfMotionIsTheMeasuredDisplacement) {
    constexpr float rise = 0.8f;  // [m/s]
    std::vector<glm::vec3> places;
    for (int i = 0; i < 120; ++i)
        places.emplace_back(0.02f * static_cast<float>(i), 0, -4.0f - 2.0f * static_cast<float>(i));
    const tests::LonePeople row(tests::make_lift(body_half, rise, 20, 1), places);
    const render::View view = view_from({0, 0.9, 0}, {0, 0, -1});
    const auto poses = static_cast<std::uint32_t>(row.poses[0].pose_count);
    Selector selector(row.crowd, row.cast, row.figures()), fresh(row.crowd, row.cast, row.figures());
    const sfsm::Forecast forecast = selector.survey(view, 0).forecast;
    ASSERT_EQ(forecast.frame[sfsm::WorkKind::person], 120);
    const std::vector<sfsm::Step> steps(forecast.motion.begin(), forecast.motion.end());
    for (const sfsm::Step& step : steps) {
        double displaced = 0;  // [px] summed
        int looks = 0;
        for (std::int64_t tick = 400; tick < 400 + 3 * motion::max_period; ++tick) {
            // How high everybody's pose is, by where they stand.
            const auto heights = [&](Selector& by, const Decision& decision) {
                by.survey(view, tick);
                std::map<float, double> found;
                const render::Frame& selection = by.select(decision, tick - 1);
                for (const render::Person& person : selection.people)
                    found[person.instance.position.z] =
                        static_cast<double>(rise) * std::min(person.pose, poses - person.pose) / 60;
                return found;
            };
            const std::map<float, double> old = heights(selector, {State::slowed, step.setting, 0});
            const std::map<float, double> now = heights(fresh, {});
            for (const auto& [z, height_now] : now) {
                const double lag = std::abs(height_now - old.at(z));
                displaced += lag * height / (2 * std::tan(0.45) * -z);
                ++looks;
            }
        }
        if (std::isinf(step.setting)) {
            EXPECT_EQ(step.loss_px, 0);
            EXPECT_EQ(displaced, 0);
            continue;
        }
        constexpr double bin_width = 0.1;  // 64 bins of depth, of which the nearest has several periods in it
        const double measured = displaced / looks;
        EXPECT_NEAR(step.loss_px, measured, bin_width * measured + 0.002) << "D = " << step.setting;
    }
    EXPECT_GT(steps.back().loss_px, 0.1);
}

// Of splats: half a splat for each who is drawn by points, and no more than half of what they cover themselves, which
// is what they lose in far blocks.
TEST(Forecast, LossOfSplatsIsHalfASplatOrHalfThePerson) {
    std::vector<glm::vec3> places;
    for (int i = 0; i < 150; ++i)
        places.emplace_back(0.02f * static_cast<float>(i), 0, -4.0f - 3.0f * static_cast<float>(i));
    const tests::LonePeople row(tests::make_lift(body_half, 0, 0.5, 20), places, 1000);
    const double area = 4 * 1.8 * 2 * body_half + 2 * std::pow(2 * body_half, 2);  // [m^2]
    const render::View view = view_from({0, 0.9, 0}, {0, 0, -1});
    Selector selector(row.crowd, row.cast, row.figures());
    const sfsm::Forecast forecast = selector.survey(view, 0).forecast;
    const std::vector<sfsm::Step> steps(forecast.shapes.begin(), forecast.shapes.end());
    for (const sfsm::Step& step : steps) {
        double lost = 0;
        const Decision decision = step.setting == 0 ? Decision{} : Decision{State::points, 1000, step.setting};
        const render::Frame& selection = selector.select(decision, -1);
        const auto silhouette_at = [&](double z) { return std::sqrt(area / 4) * height / (2 * std::tan(0.45) * -z); };
        for (const render::Person& person : selection.people)
            if (tests::points_of(person) > 0)
                lost += std::min(step.setting, silhouette_at(person.instance.position.z)) / 2;
        for (const render::FarBlock& block : selection.far_blocks)
            for (std::uint32_t i = 0; i < row.crowd.blocks[block.block].count; ++i)
                lost += silhouette_at(row.crowd.position[row.crowd.blocks[block.block].first + i].z) / 2;
        constexpr double bin_width = 0.05;
        const double measured = lost / static_cast<double>(forecast.frame[sfsm::WorkKind::person]);
        EXPECT_NEAR(step.loss_px, measured, bin_width * measured) << "S = " << step.setting;
    }
    EXPECT_EQ(steps.front().loss_px, 0);
    EXPECT_GT(steps.back().loss_px, 1);
}

// Its steps reach from the finest that is worth drawing to the coarsest that a law may ask for.
TEST(Forecast, HasStepsForAllThatALawMayDecide) {
    const glm::vec3 feet(0, 0, -30);
    const tests::LonePeople lone(tests::make_lift(body_half, 0, 0.5, 8), {&feet, 1}, 1000);
    Selector selector(lone.crowd, lone.cast, lone.figures());
    const render::Survey& survey = selector.survey(view_from({0, 0.9, 0}, {0, 0, -1}), 0);
    const auto& splats = survey.forecast.shapes;
    EXPECT_EQ(splats.front().setting, 0);
    EXPECT_LT(splats[1].setting, 0.5);
    EXPECT_DOUBLE_EQ(splats.back().setting, sfsm::max_splat_size);
    for (std::size_t i = 2; i < splats.size(); ++i) EXPECT_NEAR(splats[i].setting / splats[i - 1].setting, 1.19, 0.01);
    const auto& moves = survey.forecast.motion;
    EXPECT_TRUE(std::isinf(moves.front().setting)) << "everybody moves";
    EXPECT_LT(moves[1].setting, survey.range);
    EXPECT_LT(moves.back().setting, 0.02 * survey.range);
    EXPECT_NEAR(survey.range, 30, 0.01);
}

}  // namespace
