// By rate: what a frame says of itself is what it draws, and no one's representation or amount jumps about.
#include "render/rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include "render/select.h"
#include "sfsm/prices.h"
#include "sfsm/random.h"
#include "tests/render/drawn_errors.h"
#include "tests/render/drawn_points.h"
#include "tests/render/lone_person.h"
#include "tests/render/small_scene.h"

namespace {

using render::Exchange;
using render::Frame;
using render::Selector;
using sfsm::State;
using sfsm::WorkKind;

constexpr std::int64_t tick = 100;
const figures::Way* const ways[] = {&figures::by_opengl(), &figures::natively()};

// Natively people are of more points.
const tests::SmallScene& scene_of(const figures::Way& way) {
    static const tests::SmallScene few(3000, 0.5), many(3000, 3.0);
    return way.has_cells ? many : few;
}

std::vector<render::View> views() {
    std::vector<render::View> all;
    for (const char* preset : {"still", "close", "medium", "remote"})
        all.push_back(
            render::make_view(scene::aim_cameras(scene_of(figures::natively()).plan).named(preset).at(0.0), 640, 360));
    all.push_back(render::make_view({{0, 1500, 300}, {0, 0, 0}, 0.4}, 640, 360));
    all.push_back(render::make_view({{300, 120, 200}, {0, 0, 0}, 0.5}, 640, 360));
    return all;
}

Selector selector_of(const figures::Way& way, double max_error = std::numeric_limits<double>::infinity()) {
    const tests::SmallScene& scene = scene_of(way);
    render::SelectOptions options;
    options.way = &way;
    options.max_error = max_error;
    return {scene.crowd, scene.cast, scene.figures(), options};
}

sfsm::Decision at_rate(double rate) {
    sfsm::Decision decision;
    decision.rate = rate;
    return decision;
}

double rate_at(int step) {
    return Exchange::rate_of(step);
}

bool is_mesh(const render::Person& person, const figures::Way& way) {
    return way.representations[person.representation].is_mesh;
}

TEST(RateRule, WorkIsTheSumOverItsPeopleAndTheStateTheirs) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector = selector_of(*way);
        for (const render::View& view : views())
            for (int step = 0; step < Exchange::steps; step += 3) {
                const std::int64_t visible = selector.survey(view, tick).forecast.frame[WorkKind::person];
                const Frame& frame = selector.select(at_rate(rate_at(step)), tick - 1);
                sfsm::Work expected;
                bool simplified = !frame.far_blocks.empty();
                expected[WorkKind::person] = std::ssize(frame.people);
                for (const render::FarBlock& block : frame.far_blocks)
                    expected[WorkKind::person] += scene.crowd.blocks[block.block].count;
                expected[WorkKind::single] = std::ssize(frame.people);
                for (const render::Person& person : frame.people) {
                    const std::uint32_t points = tests::points_of(person, *way);
                    expected[WorkKind::point] += points;
                    if (points == 0)
                        expected[WorkKind::triangle] += static_cast<std::int64_t>(scene.person.mesh.triangle_count());
                    simplified |= points > 0;
                }
                expected[WorkKind::motion_update] = frame.work[WorkKind::motion_update];
                EXPECT_EQ(frame.work, expected);
                EXPECT_EQ(frame.work[WorkKind::person], visible);
                EXPECT_LE(frame.work[WorkKind::motion_update], visible);
                EXPECT_EQ(frame.state == State::points, simplified);
            }
    }
}

TEST(RateRule, AnyRateIsSafe) {
    for (const figures::Way* way : ways) {
        Selector selector = selector_of(*way);
        selector.survey(views()[0], tick);
        const auto work = [&](double rate) { return selector.select(at_rate(rate), tick - 1).work; };
        EXPECT_EQ(work(1e-300), work(1e-9));
        EXPECT_EQ(work(1e300), work(std::numeric_limits<double>::infinity()));
        EXPECT_EQ(work(std::numeric_limits<double>::quiet_NaN()), work(0)) << "decided by D and S";
        EXPECT_LE(work(1e300)[WorkKind::triangle], work(1)[WorkKind::triangle]);
    }
}

// Of each person in a frame the amount: points, the last of them in part.
struct Amount {
    bool is_mesh = false;
    double points = 0;
};

// By who they are: the crowd's order, as all of whom are visible are listed.
std::vector<Amount> amounts_of(const Frame& frame, const figures::Way& way) {
    std::vector<Amount> amounts;
    for (const render::Person& person : frame.people)
        amounts.push_back({is_mesh(person, way), person.count - 1.0 + static_cast<double>(person.last_share)});
    return amounts;
}

// Nobody's amount differs by more than a share, but whose representation does.
void expect_close(const std::vector<Amount>& a, const std::vector<Amount>& b, double share, const std::string& where) {
    ASSERT_EQ(a.size(), b.size());
    std::size_t switched = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        switched += a[i].is_mesh != b[i].is_mesh;
        if (a[i].is_mesh || b[i].is_mesh) continue;
        ASSERT_NEAR(a[i].points, b[i].points, share * a[i].points) << where;
    }
    EXPECT_LE(static_cast<double>(switched), 0.02 * static_cast<double>(a.size()) + 5) << where;
}

TEST(RateRule, NearlyTheSameRateDrawsNearlyTheSame) {
    const figures::Way way = tests::without_blocks(figures::natively());
    Selector selector = selector_of(way);
    const double last = rate_at(Exchange::steps - 1);
    for (const render::View& view : views()) {
        selector.survey(view, tick);
        int cell_changes = 0;
        for (double rate = rate_at(0); rate < last; rate *= 1.3) {
            const Frame& frame = selector.select(at_rate(rate), tick - 1);
            const double size = frame.splat_size;
            const std::vector<Amount> amounts = amounts_of(frame, way);
            const Frame& next = selector.select(at_rate(rate * 1.001), tick - 1);
            if (next.splat_size != size)
                ++cell_changes;  // another size of cells asks for other points of everybody
            else
                expect_close(amounts, amounts_of(next, way), 0.002, "rate " + std::to_string(rate));
        }
        EXPECT_LE(cell_changes, 1);
    }
}

TEST(RateRule, NearlyTheSameDistanceDrawsNearlyTheSame) {
    const figures::Way way = tests::without_blocks(figures::natively());
    Selector selector = selector_of(way);
    for (const double distance : {60.0, 200.0, 700.0}) {
        for (int step = 4; step < Exchange::steps; step += 3) {
            const auto look = [&](double from) {
                selector.survey(render::make_view({{0, 0.8 * from, from}, {0, 0, 0}, 0.6}, 640, 360), tick);
                const Frame& frame = selector.select(at_rate(rate_at(step)), tick - 1);
                return std::pair(frame.splat_size, amounts_of(frame, way));
            };
            const auto [size, amounts] = look(distance);
            const auto [next_size, next] = look(distance + 0.001);
            if (size == next_size && amounts.size() == next.size())
                expect_close(amounts, next, 0.002, std::to_string(distance) + " m");
        }
    }
}

// In the order in which people go through them.
enum class Shown { mesh, points, splat };

// By who they are: numbers in the crowd.
std::vector<Shown> shown_in(const Frame& frame, const std::vector<std::uint32_t>& numbers, const scene::Crowd& crowd,
                            const figures::Way& way) {
    std::vector<Shown> shown;
    tests::for_each_drawn(frame, numbers, crowd, [&](std::size_t, std::uint32_t, const render::Person* alone) {
        shown.push_back(!alone ? Shown::splat : is_mesh(*alone, way) ? Shown::mesh : Shown::points);
    });
    return shown;
}

TEST(RateRule, NobodyComesBackToARepresentationAsTheRateRises) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector = selector_of(*way);
        for (const render::View& view : views()) {
            selector.survey(view, tick);
            const auto numbers = tests::numbers_of(selector.select({}, tick - 1), scene.crowd, scene.cast, tick);
            std::vector<Shown> before(numbers.size(), Shown::mesh);
            std::size_t back = 0, forth = 0, as_cells_change = 0;
            double size = 0;
            for (double rate = rate_at(0) / 2; rate < 2 * rate_at(Exchange::steps - 1); rate *= 1.04) {
                const Frame& frame = selector.select(at_rate(rate), tick - 1);
                const auto now = shown_in(frame, numbers, scene.crowd, *way);
                const bool cells_change = way->has_cells && frame.splat_size != size;
                for (std::size_t i = 0; i < now.size(); ++i) {
                    (cells_change ? as_cells_change : back) += now[i] < before[i];
                    forth += now[i] > before[i];
                }
                before = now;
                size = frame.splat_size;
            }
            EXPECT_EQ(back, 0u) << sfsm::name_of(way->drawing) << ", of " << forth;
            EXPECT_LE(as_cells_change, forth / 100) << "larger cells blur points: a few are better as meshes then";
            EXPECT_GT(forth, 0u);
        }
    }
}

TEST(RateRule, SomebodyWhoWalksOffIsAMeshThenPoints) {
    const glm::vec3 feet(0);
    for (const figures::Way* way : ways) {
        const tests::LonePeople one(tests::make_lift(0.25f, 0, 1, 8), {&feet, 1}, 2000);
        Selector selector(one.crowd, one.cast, one.figures(), {.way = way});
        for (int step = 0; step < Exchange::steps; step += 4) {
            // In cells of each size, which change with what the person covers.
            std::map<double, std::pair<int, Amount>> last;
            Amount now;
            for (double distance = 1; distance < 3000; distance *= 1.01) {
                selector.survey(render::make_view({{0, 0.9, distance}, {0, 0.9, 0}, 0.6}, 640, 360), tick);
                const Frame& frame = selector.select(at_rate(rate_at(step)), tick - 1);
                ASSERT_EQ(frame.people.size(), 1u);
                now = amounts_of(frame, *way)[0];
                const double size = way->has_cells ? frame.splat_size : 0;
                auto& [changes, before] = last.try_emplace(size, 0, now).first->second;
                changes += now.is_mesh != before.is_mesh;
                if (!now.is_mesh && !before.is_mesh) {
                    EXPECT_LE(now.points, before.points * 1.0001) << distance << " m, rate " << rate_at(step);
                }
                before = now;
            }
            EXPECT_FALSE(now.is_mesh);
            for (const auto& [size, found] : last)
                EXPECT_LE(found.first, 1) << "rate " << rate_at(step) << ' ' << sfsm::name_of(way->drawing);
        }
    }
}

TEST(RateRule, WhoIsTooNearIsAMesh) {
    const glm::vec3 feet(0);
    const figures::Way& way = figures::natively();
    const tests::LonePeople one(tests::make_lift(0.25f, 0, 1, 40), {&feet, 1}, 4000);
    Selector selector(one.crowd, one.cast, one.figures(), {.way = &way});
    const float radius = std::hypot(0.9f, std::hypot(0.25f, 0.25f));
    for (const double rate : {1.0, 1e9})
        for (float distance = 0.5f; distance < 6; distance += 0.1f) {
            selector.survey(render::make_view({{0, 0.9, distance}, {0, 0.9, 0}, 0.6}, 640, 360), tick);
            const Frame& frame = selector.select(at_rate(rate), tick - 1);
            ASSERT_EQ(frame.people.size(), 1u);
            if (distance < 0.99f * way.nearest * radius) {
                EXPECT_TRUE(is_mesh(frame.people[0], way)) << distance << " m";
            } else if (rate > 1e6 && distance > 1.01f * way.nearest * radius) {
                EXPECT_FALSE(is_mesh(frame.people[0], way)) << distance << " m";
            }
        }
}

// However near they are and however many there, and however few pixels there are.
TEST(RateRule, NobodyIsExpectedToShowOnMoreThanThePicture) {
    constexpr double most_flip = 0.6;  // of a pixel, late and as a splat
    const std::vector<glm::vec3> feet(12, glm::vec3(0));
    for (const figures::Way* way : ways) {
        const tests::LonePeople one(tests::make_lift(0.25f, 1, 1, 8), feet, 2000);
        Selector selector(one.crowd, one.cast, one.figures(), {.way = way});
        for (const auto& [width, height] : {std::pair(640, 360), std::pair(4, 4), std::pair(1, 1)})
            for (double distance = 0.01; distance < 10; distance *= 1.5) {
                const render::View view = render::make_view({{0, 1.7, distance}, {0, 0.9, 0}, 0.6}, width, height);
                for (const sfsm::RateStep& step : selector.survey(view, tick).forecast.rates) {
                    EXPECT_LE(step.loss, most_flip) << distance << " m, " << width << " px";
                    EXPECT_LE(selector.select(at_rate(step.rate), tick - 1).expected_flip, most_flip);
                }
            }
    }
}

TEST(MaxError, BoundsWhatEveryFramePromises) {
    for (const figures::Way* way : ways)
        for (const double most : {30.0, 3.0, 1.0, 0.1, 1e-9}) {
            Selector selector = selector_of(*way, most);
            double motion = 0, splat = 0;
            for (const render::View& view : views()) {
                selector.survey(view, tick);
                for (int step = 0; step < Exchange::steps; step += 2) {
                    const Frame& frame = selector.select(at_rate(rate_at(step)), tick - 1);
                    ASSERT_LE(frame.max_motion_px, most) << "rate " << rate_at(step);
                    ASSERT_LE(frame.max_splat_px, most) << "rate " << rate_at(step);
                    motion = std::max(motion, frame.max_motion_px);
                    splat = std::max(splat, frame.max_splat_px);
                    if (most > 1e-6) continue;
                    EXPECT_EQ(frame.state, State::original);
                    EXPECT_EQ(frame.work[WorkKind::motion_update], frame.work[WorkKind::person]);
                    EXPECT_EQ(frame.work[WorkKind::point], 0);
                }
            }
            if (most < 1) continue;
            EXPECT_GT(motion, 0.5 * most) << "it leaves what it allows";
            EXPECT_GT(splat, 0.5 * most) << "it leaves what it allows";
        }
}

TEST(MaxError, IsForeseen) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector = selector_of(*way, 2.0);
        for (const render::View& view : views()) {
            const auto rates = selector.survey(view, tick).forecast.rates;
            for (const sfsm::RateStep& step : rates) {
                const auto pieces = [&](const sfsm::Work& work) {
                    return sfsm::cost_of(sfsm::only_on<sfsm::WorkAxis::shape>(work), {0, way->pieces});
                };
                const double drawn = pieces(selector.select(at_rate(step.rate), tick - 1).work);
                const double people = 12 * static_cast<double>(scene.person.mesh.triangle_count());
                EXPECT_NEAR(pieces(step.work), drawn, 0.08 * drawn + people) << "rate " << step.rate;
            }
        }
    }
}

// Sizes are summed up in bins under a limit.
void expect_nearly(const sfsm::RateStep& found, const sfsm::RateStep& expected, const tests::SmallScene& scene) {
    constexpr double share = 0.015, people = 3;
    const auto near = [&](WorkKind kind, double of_a_person) {
        const auto count = static_cast<double>(expected.work[kind]);
        EXPECT_NEAR(static_cast<double>(found.work[kind]), count, share * count + people * of_a_person)
            << sfsm::entry_of(kind).name << ", rate " << expected.rate;
    };
    near(WorkKind::triangle, static_cast<double>(scene.person.mesh.triangle_count()));
    near(WorkKind::point, 100);
    near(WorkKind::single, 1);
    EXPECT_EQ(found.work[WorkKind::motion_update], expected.work[WorkKind::motion_update]);
    EXPECT_EQ(found.motion_distance, expected.motion_distance);
    EXPECT_NEAR(found.loss, expected.loss, share * expected.loss + 2e-6);
}

TEST(MaxError, ThatNobodyReachesChangesNothing) {
    for (const figures::Way* way : ways) {
        Selector free = selector_of(*way), bound = selector_of(*way, 1e7);
        for (const render::View& view : views()) {
            const auto expected = free.survey(view, tick).forecast.rates;
            const auto found = bound.survey(view, tick).forecast.rates;
            for (std::size_t i = 0; i < found.size(); ++i) expect_nearly(found[i], expected[i], scene_of(*way));
            for (int step = 0; step < Exchange::steps; step += 5) {
                const Frame &a = free.select(at_rate(rate_at(step)), tick - 1),
                            &b = bound.select(at_rate(rate_at(step)), tick - 1);
                ASSERT_EQ(a.people.size(), b.people.size());
                EXPECT_EQ(std::memcmp(a.people.data(), b.people.data(), a.people.size() * sizeof(render::Person)), 0);
                EXPECT_EQ(a.far_blocks, b.far_blocks);
                EXPECT_EQ(a.work, b.work);
            }
        }
    }
}

// What is promised of a frame, against every vertex of some of its people.
TEST(Promise, IsKept) {
    for (const figures::Way* way : ways)
        for (const double most : {std::numeric_limits<double>::infinity(), 2.0}) {
            const tests::SmallScene& scene = scene_of(*way);
            Selector selector = selector_of(*way, most);
            double motion_share = 0, splat_share = 0;
            for (const render::View& view : views())
                for (const int step : {6, 15, 24, Exchange::steps - 1}) {
                    const std::int64_t now = tick + 37 * step;
                    selector.survey(view, now);
                    const Frame exact = selector.select({}, now - 1);
                    const auto numbers = tests::numbers_of(exact, scene.crowd, scene.cast, now);
                    const Frame& frame = selector.select(at_rate(rate_at(step)), now - 1);
                    const tests::Off off =
                        tests::farthest_off(frame, exact, numbers, scene.crowd, scene.poses, *way, 23);
                    ASSERT_LE(off.motion_px, frame.max_motion_px) << "rate " << rate_at(step);
                    ASSERT_LE(off.splat_px, frame.max_splat_px) << "rate " << rate_at(step);
                    if (frame.max_motion_px > 0)
                        motion_share = std::max(motion_share, off.motion_px / frame.max_motion_px);
                    if (frame.max_splat_px > 0) splat_share = std::max(splat_share, off.splat_px / frame.max_splat_px);
                }
            EXPECT_GT(motion_share, 0.05) << "it says nothing";
            EXPECT_GT(splat_share, 0.05) << "it says nothing";
        }
}

// Of somebody around the eye a part is before the near plane, where no point of them shows; and who walks off is drawn
// where they were.
TEST(Promise, IsKeptByWhoIsAroundTheEye) {
    const glm::vec3 feet(0);
    std::uint64_t draws = 0;
    const auto within = [&](double low, double high) {
        return low + (high - low) * sfsm::unit(sfsm::stream(7, draws++));
    };
    for (const figures::Way* way : ways)
        for (const scene::Role role : {scene::Role::standing, scene::Role::walker}) {
            tests::LonePeople one(tests::make_lift(0.25f, 1, 4, 8), {&feet, 1}, 2000);
            one.crowd.role[0] = role;
            one.cast[0].gait_speed[static_cast<int>(scene::Role::walker)] = 8;  // [m/s]
            one.crowd.blocks[0].box = {glm::vec3(-1000), glm::vec3(1000)};  // wherever they walk
            Selector selector(one.crowd, one.cast, one.figures(), {.way = way});
            for (const auto& [width, height] :
                 {std::pair(1, 1), std::pair(4, 4), std::pair(64, 36), std::pair(640, 360)})
                for (int i = 0; i < 200; ++i) {
                    const std::int64_t now = tick + i;
                    const glm::vec3 place = scene::place(one.crowd, 0, one.cast[0], now).position;
                    const glm::dvec3 around(within(-4, 4), within(0, 2.5), within(-4, 4));
                    const glm::dvec3 ahead(within(-1, 1), within(-1, 1), within(-1, 1));
                    const glm::dvec3 eye = glm::dvec3(place) + around;
                    selector.survey(render::make_view({eye, eye + ahead, 1.0}, width, height), now);
                    const Frame exact = selector.select({}, now - 1);
                    const auto numbers = tests::numbers_of(exact, one.crowd, one.cast, now);
                    for (const double rate : {0.001, 0.02, 0.5, 1.4}) {
                        const Frame& frame = selector.select(at_rate(rate), now - 1);
                        const tests::Off off =
                            tests::farthest_off(frame, exact, numbers, one.crowd, one.poses, *way, 1);
                        ASSERT_LE(off.motion_px, frame.max_motion_px) << "rate " << rate << ", " << width << " px";
                        ASSERT_LE(off.splat_px, frame.max_splat_px) << "rate " << rate << ", " << width << " px";
                    }
                }
        }
}

// Who is in a lift is off by as far as it has gone since, wherever in its course.
TEST(Promise, OfSomebodyAloneIsHardlyMoreThanTheyAreOff) {
    const glm::vec3 feet(0);
    const figures::Way& way = figures::by_opengl();
    const tests::LonePeople one(tests::make_lift(0.25f, 1, 4, 2), {&feet, 1});
    const render::View view = render::make_view({{0, 1.5, 60}, {0, 1.5, 0}, 0.1}, 640, 360);
    for (const double distance : {10.0, 30.0}) {
        sfsm::Decision decision{State::slowed, distance, 0};
        Selector selector(one.crowd, one.cast, one.figures(), {.way = &way});
        double most_off = 0, promised = 0;
        for (std::int64_t now = tick; now < tick + 4 * motion::ticks_per_second; ++now) {
            selector.survey(view, now);
            const Frame exact = selector.select({}, now - 1);
            const auto numbers = tests::numbers_of(exact, one.crowd, one.cast, now);
            const Frame& frame = selector.select(decision, now - 1);
            most_off =
                std::max(most_off, tests::farthest_off(frame, exact, numbers, one.crowd, one.poses, way, 1).motion_px);
            ASSERT_LE(most_off, frame.max_motion_px);
            promised = frame.max_motion_px;
        }
        EXPECT_GT(most_off, 0.8 * promised)
            << "D " << distance << " m, period " << motion::update_period(60, static_cast<float>(distance));
    }
}

// Blocks that are drawn as one show poses that are a little old even if everybody moves in each frame.
TEST(Promise, OfABlockDrawnAsOneCountsHowOldItsPosesAre) {
    for (const figures::Way* way : ways) {
        const tests::SmallScene& scene = scene_of(*way);
        Selector selector = selector_of(*way);
        const render::View view = render::make_view({{0, 1500, 300}, {0, 0, 0}, 0.4}, 640, 360);
        const sfsm::Decision decision{State::points, std::numeric_limits<double>::infinity(), sfsm::max_splat_size};
        double off_px = 0;
        for (std::int64_t now = tick; now < tick + render::ticks_a_key; ++now) {
            selector.survey(view, now);
            const Frame exact = selector.select({}, now - 1);
            const auto numbers = tests::numbers_of(exact, scene.crowd, scene.cast, now);
            const Frame& frame = selector.select(decision, now - 1);
            ASSERT_FALSE(frame.far_blocks.empty());
            const tests::Off off = tests::farthest_off(frame, exact, numbers, scene.crowd, scene.poses, *way, 7);
            ASSERT_LE(off.motion_px, frame.max_motion_px);
            off_px = std::max(off_px, off.motion_px);
        }
        EXPECT_GT(off_px, 0.05);
    }
}

// Whoever may be off by so much moves as seldom as that allows: by bounds of those alone, or of blocks.
TEST(MaxError, IsUsedUpByHowOftenPeopleMove) {
    const figures::Way& way = figures::natively();
    const tests::SmallScene& scene = scene_of(way);
    const auto role = scene::Role::spectator;
    const figures::Choices choices(scene.figures()[0], way);
    const auto staleness = render::measure_staleness(scene.crowd, scene.cast, scene.figures());
    render::ErrorBounds bounds;
    for (std::size_t period = 0; period <= motion::max_period; ++period) {
        bounds.motion.single[0][period] = 0.01f * static_cast<float>(period);
        bounds.motion.far[0][period] = 0.01f * static_cast<float>(period + 5);
    }
    const auto area = static_cast<double>(scene.poses[0].area),
               height = static_cast<double>(scene.poses[0].rest_height);
    render::RateForecaster forecaster({{{&choices, area, height}, staleness[0], &bounds, 1}}, way);
    const render::View view = render::make_view({{0, 0, 0}, {0, 0, -1}, 0.8}, 640, 360);
    const float depth = 100, pixels = view.pixels_per_metre(depth);
    forecaster.begin(view, {});
    forecaster.add({.people = 10, .depth = depth, .pixels_per_metre = pixels, .surface = 1.9f * pixels * pixels});
    forecaster.finish();
    render::RateRule rule(forecaster);
    rule.decide(rate_at(Exchange::steps - 1), 1);
    render::Subject subject{.role = role, .depth = depth, .pixels_per_metre = pixels};
    const int wanted = rule.period_of(subject);
    ASSERT_GE(wanted, 12);
    subject.allowed = 0.095f;
    EXPECT_EQ(rule.period_of(subject), 8) << "of the bounds 0.08 and, of the next, 0.12";
    subject.is_block = true;
    EXPECT_EQ(rule.period_of(subject), 4) << "of the bounds 0.09 and, of the next, 0.11";
}

}  // namespace
