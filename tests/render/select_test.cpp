#include "render/select.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "render/batches.h"
#include "render/contact_shade.h"
#include "sfsm/prices.h"
#include "tests/render/drawn_points.h"
#include "tests/render/small_scene.h"

namespace {

using render::Frame;
using render::Selector;
using sfsm::Decision;
using sfsm::State;

const tests::SmallScene& small_scene() {
    static const tests::SmallScene scene(3000);
    return scene;
}

render::View view_of(const char* preset) {
    return render::make_view(scene::aim_cameras(small_scene().plan).named(preset).at(0.0), 640, 360);
}

Decision points_of(double splat_size, double motion_distance = 50) {
    return {State::points, motion_distance, splat_size};
}

const Frame& select_at(Selector& selector, const render::View& view, const Decision& decision, std::int64_t tick) {
    selector.survey(view, tick);
    return selector.select(decision, tick - 1);
}

Frame select_once(const render::View& view, const Decision& decision, std::int64_t tick = 100) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    return select_at(selector, view, decision, tick);
}

bool same_bits(const Frame& a, const Frame& b) {
    static_assert(sizeof(render::Person) == sizeof(render::Instance) + 9 * 4, "no padding: bytes can be compared");
    return a.people.size() == b.people.size() &&
           std::memcmp(a.people.data(), b.people.data(), a.people.size() * sizeof(render::Person)) == 0 &&
           a.work == b.work;
}

// [pieces] What people's shapes are believed to cost.
double shape_cost(const sfsm::Work& work, const figures::Way& way = figures::by_opengl()) {
    return sfsm::cost_of(sfsm::only_on<sfsm::WorkAxis::shape>(work), {0, way.pieces});
}

// [m] Where every `stride`-th vertex of a person is in the world.
std::vector<glm::vec3> surface_of(std::size_t person, std::int64_t tick, int stride) {
    const tests::SmallScene& scene = small_scene();
    const motion::PoseTable& table = scene.poses[0];
    const scene::Placement at = scene::place(scene.crowd, person, scene.cast[0], tick);
    const scene::Action action = scene::act(scene.crowd, person, scene.cast[0], table, tick);
    const int pose = table.pose_at(action.clip, action.clip_tick);
    const float scale = scene.crowd.height[person] / table.rest_height;
    const float s = std::sin(at.yaw), c = std::cos(at.yaw);
    std::vector<glm::vec3> spots;
    for (int vertex = 0; vertex < table.vertex_count; vertex += stride) {
        const glm::vec3 p = motion::unpack_position(table.vertices[pose * table.vertex_count + vertex], table.box);
        spots.push_back(at.position + scale * glm::vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x));
    }
    return spots;
}

// Every vertex of a person, projected: the slow truth about who shows.
bool some_vertex_shows(const render::View& view, std::size_t person, std::int64_t tick) {
    const std::vector<glm::vec3> surface = surface_of(person, tick, 1);
    return std::any_of(surface.begin(), surface.end(), [&](const glm::vec3& spot) {
        const glm::vec4 clip = view.clip_from_camera_relative * glm::vec4(view.relative(spot), 1.0f);
        return std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z < clip.w;
    });
}

TEST(Selection, NeverDropsSomeoneWhoShows) {
    for (const char* preset : {"still", "close", "medium", "remote"}) {
        const render::View view = view_of(preset);
        const Frame selection = select_once(view, {});
        std::set<std::tuple<float, float, float>> selected;
        for (const render::Person& person : selection.people) {
            const glm::vec3& at = person.instance.position;
            selected.insert({at.x, at.y, at.z});
        }
        std::size_t showing = 0;
        for (std::size_t person = 0; person < small_scene().crowd.size(); ++person) {
            if (!some_vertex_shows(view, person, 100)) continue;
            ++showing;
            const scene::Placement placement = scene::place(small_scene().crowd, person, small_scene().cast[0], 100);
            const glm::vec3 p = view.relative(placement.position);
            EXPECT_TRUE(selected.contains({p.x, p.y, p.z})) << preset << ", person " << person;
        }
        EXPECT_GT(showing, 0u) << preset;
        // Balls around bodies are loose, but not so loose that culling is no use.
        EXPECT_LT(static_cast<double>(selection.people.size()), 1.3 * static_cast<double>(showing) + 20) << preset;
    }
}

// In blocks that are wholly in view.
std::int64_t people_far_away(const Frame& frame) {
    std::int64_t people = 0;
    for (const render::FarBlock& block : frame.far_blocks) {
        const scene::CrowdBlock& all = small_scene().crowd.blocks[block.block];
        EXPECT_EQ(render::overlap(frame.view, all.box), render::Overlap::inside);
        people += all.count;
    }
    return people;
}

TEST(Selection, WhoStandsDarkensWhatTheyStandOnAndWhoSitsDoesNot) {
    const scene::Crowd& crowd = small_scene().crowd;
    std::map<float, int> expected, found;
    for (std::size_t person = 0; person < crowd.size(); ++person)
        ++expected[crowd.role[person] == scene::Role::spectator ? 0 : render::contact_reach * crowd.height[person]];
    for (const render::Person& person : select_once(view_of("remote"), {}).people) ++found[person.shade_radius];
    EXPECT_GT(expected.size(), 5u) << "nobody stands";
    EXPECT_EQ(found, expected) << "everybody is in view";
}

TEST(Selection, WorkIsTheSumOverItsPeople) {
    const Frame selection = select_once(view_of("still"), points_of(2));
    std::int64_t triangles = 0, points = 0;
    for (const render::Person& person : selection.people) {
        points += tests::points_of(person);
        if (tests::points_of(person) == 0)
            triangles += static_cast<std::int64_t>(small_scene().person.mesh.triangle_count());
    }
    EXPECT_EQ(selection.work[sfsm::WorkKind::person], std::ssize(selection.people) + people_far_away(selection));
    EXPECT_EQ(selection.work[sfsm::WorkKind::single], std::ssize(selection.people));
    EXPECT_EQ(selection.work[sfsm::WorkKind::triangle], triangles);
    EXPECT_EQ(selection.work[sfsm::WorkKind::point], points);
    EXPECT_GT(points, 0);
}

TEST(Batches, PartThePeopleByHowTheyAreDrawn) {
    render::Batches batches;
    for (const double splat_size : {0.0, 1.0, 4.0}) {
        const Frame frame = select_once(view_of("still"), splat_size > 0 ? points_of(splat_size) : Decision{});
        batches.gather(frame);
        std::vector<render::Instance> instances(frame.people.size());
        batches.write_instances(frame, instances);
        std::vector<const render::Person*> people;  // as they should be gathered
        for (const render::Person& person : frame.people) people.push_back(&person);
        std::ranges::stable_sort(people, {}, &render::Person::batch);
        std::uint32_t next = 0;
        for (const render::Batch& batch : batches.all()) {
            ASSERT_EQ(batch.first_instance, next);
            ASSERT_GT(batch.instance_count, 0u);
            for (; next < batch.first_instance + batch.instance_count; ++next) {
                const render::Person& person = *people[next];
                EXPECT_EQ(std::memcmp(&instances[next], &person.instance, sizeof person.instance), 0);
                EXPECT_EQ(std::tie(batch.character, batch.representation, batch.first, batch.count, batch.pose),
                          std::tie(person.character, person.representation, person.first, person.count, person.pose));
            }
        }
        EXPECT_EQ(next, people.size());
        EXPECT_LT(batches.all().size(), people.size()) << "nobody shares a pose";
    }
}

// What is drawn besides people is known before, and in the frame as it was known.
TEST(Selection, HasTheWorkOfWhatIsAroundThePeople) {
    const sfsm::Work around{0, 0, 0, 0, 1234, 640 * 360};
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    const render::View view = view_of("still");
    const std::int64_t people = selector.survey(view, 100).forecast.frame[sfsm::WorkKind::person];
    const sfsm::Work bare = selector.select(points_of(2), 99).work;
    sfsm::Work expected = around;
    expected[sfsm::WorkKind::person] = people;
    for (int frame = 0; frame < 2; ++frame) {  // it doesn't add up
        EXPECT_EQ(selector.survey(view, 100, {around, nullptr}).forecast.frame, expected);
        sfsm::Work all = bare;
        all += around;
        EXPECT_EQ(selector.select(points_of(2), 99).work, all);
    }
}

// Whatever was asked for: a frame in which nobody is a point is not of state 2, and one in which everybody moves in
// every frame not of state 1.
TEST(Selection, StateFollowsFromWhatWasDrawn) {
    const render::View still = view_of("still"), close = view_of("close");
    const double far = 2 * 300;  // [m] beyond everybody
    EXPECT_EQ(select_once(still, {}).state, State::original);
    EXPECT_EQ(select_once(still, {State::slowed, 5, 0}).state, State::slowed);
    EXPECT_EQ(select_once(still, {State::slowed, far, 0}).state, State::original);
    EXPECT_EQ(select_once(still, points_of(4, far)).state, State::points);
    EXPECT_EQ(select_once(close, points_of(0.01, far)).state, State::original);
    EXPECT_EQ(select_once(close, points_of(0.01, 1)).state, State::slowed);
    EXPECT_EQ(select_once(view_of("remote"), points_of(8, far)).state, State::points);
}

TEST(Selection, LargerSplatsNeverCostMore) {
    const auto price = [](const Frame& frame) { return shape_cost(frame.work); };
    double last = price(select_once(view_of("still"), {}));
    for (double splat_size = 0.25; splat_size <= 32; splat_size *= 1.3) {
        const double now = price(select_once(view_of("still"), points_of(splat_size)));
        EXPECT_LE(now, last) << "S = " << splat_size;
        last = now;
    }
}

TEST(Selection, IsTheSameOnAnyNumberOfThreads) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Frame alone = select_once(view_of("still"), points_of(2));
    Frame together;
    {
        const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 4);
        together = select_once(view_of("still"), points_of(2));
    }
    EXPECT_TRUE(same_bits(alone, together));
}

TEST(Selection, NeedsNoFrameBeforeIt) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    for (std::int64_t tick = 90; tick < 100; ++tick) select_at(selector, view_of("close"), points_of(3, 20), tick);
    const Frame after_others = select_at(selector, view_of("still"), points_of(2), 100);
    EXPECT_TRUE(same_bits(after_others, select_once(view_of("still"), points_of(2))));
}

// Nor does what a view shows: neither its range, nor who is seen, nor any price.
TEST(Survey, NeedsNoFrameBeforeIt) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    for (const char* preset : {"remote", "close", "medium", "still", "close"}) {
        Selector fresh(small_scene().crowd, small_scene().cast, small_scene().figures());
        const render::Survey &survey = selector.survey(view_of(preset), 100),
                             &alone = fresh.survey(view_of(preset), 100);
        EXPECT_EQ(survey.range, alone.range) << preset;
        EXPECT_EQ(survey.forecast.frame[sfsm::WorkKind::person], alone.forecast.frame[sfsm::WorkKind::person])
            << preset;
        EXPECT_TRUE(std::ranges::equal(survey.forecast.motion, alone.forecast.motion)) << preset;
        EXPECT_TRUE(std::ranges::equal(survey.forecast.shapes, alone.forecast.shapes)) << preset;
    }
}

TEST(Survey, OfNobodyCostsAndLosesNothing) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    const render::View up = render::make_view({{0, 200, 0}, {0, 300, 0}, 0.8}, 640, 360);
    const render::Survey& survey = selector.survey(up, 100);
    EXPECT_EQ(survey.range, 1);
    EXPECT_EQ(survey.forecast.frame[sfsm::WorkKind::person], 0);
    for (const sfsm::Step& step : survey.forecast.motion) {
        EXPECT_EQ(step.work[sfsm::WorkKind::motion_update], 0);
        EXPECT_EQ(step.loss_px, 0);
    }
    for (const sfsm::Step& step : survey.forecast.shapes) {
        EXPECT_EQ(step.work[sfsm::WorkKind::triangle] + step.work[sfsm::WorkKind::point], 0);
        EXPECT_EQ(step.loss_px, 0);
    }
    const Frame& selection = selector.select(points_of(4), 99);
    EXPECT_TRUE(selection.people.empty());
    EXPECT_EQ(selection.work, sfsm::Work{});
}

TEST(Selection, MovesEverybodyInStateZeroAndFewerTheNearerD) {
    const Frame all = select_once(view_of("still"), {});
    EXPECT_EQ(all.work[sfsm::WorkKind::motion_update], all.work[sfsm::WorkKind::person]);
    EXPECT_TRUE(same_bits(select_once(view_of("still"), {State::original, 1, 0}), all)) << "D means nothing there";
    std::int64_t last = all.work[sfsm::WorkKind::person];
    for (const double motion_distance : {200.0, 120.0, 60.0, 20.0, 1.0}) {
        const std::int64_t moved =
            select_once(view_of("still"), {State::slowed, motion_distance, 0}).work[sfsm::WorkKind::motion_update];
        EXPECT_LE(moved, last) << "D = " << motion_distance;
        last = moved;
    }
    EXPECT_LT(last, all.work[sfsm::WorkKind::person] / 2);
}

TEST(Selection, MovesEachPersonOnceAPeriod) {
    // Over as many frames as the longest period everybody moves at least once, and the far ones just once.
    const Decision decision{State::slowed, 1.0, 0};
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures(),
                      {.theta = 10.0f});  // everybody at the longest period
    const render::View view = view_of("remote");
    std::int64_t moved = 0, people = 0;
    for (std::int64_t tick = 100; tick < 100 + motion::max_period; ++tick) {
        const Frame& selection = select_at(selector, view, decision, tick);
        moved += selection.work[sfsm::WorkKind::motion_update];
        people = selection.work[sfsm::WorkKind::person];
        // Staggered: no frame moves more than twice its share of the people.
        EXPECT_LT(selection.work[sfsm::WorkKind::motion_update],
                  2 * selection.work[sfsm::WorkKind::person] / motion::max_period + 20);
    }
    EXPECT_EQ(moved, people);
}

TEST(Selection, NothingMovesWhileTimeStandsStill) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    selector.survey(view_of("still"), 50);
    EXPECT_EQ(selector.select({}, 50).work[sfsm::WorkKind::motion_update], 0);
}

TEST(Selection, RangeReachesTheFarthestPersonInView) {
    for (const char* preset : {"still", "close", "medium", "remote"}) {
        const render::View view = view_of(preset);
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
        const float range = selector.survey(view, 0).range;
        float farthest = 0;
        for (const render::Person& person : selector.select({}, -1).people)
            farthest = std::max(farthest, view.depth(person.instance.position));
        constexpr float half_a_body = 1.0f;  // [m] depth is that of a person's middle, an instance that of the feet
        EXPECT_NEAR(range, farthest, half_a_body) << preset;
    }
}

// What a forecast says of a step, against what selecting it does. Forecasts count people in bins of depth and size, so
// they are right on average: a few hundred people leave some per cent.
constexpr double bin_error = 0.08;

TEST(Forecast, CountsWhatSelectionDraws) {
    for (const char* preset : {"still", "close", "medium", "remote"}) {
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
        const sfsm::Forecast forecast = selector.survey(view_of(preset), 100).forecast;
        EXPECT_EQ(forecast.shapes.front().setting, 0);
        for (const sfsm::Step& step : forecast.shapes) {
            const Decision decision = step.setting == 0 ? Decision{} : points_of(step.setting);
            const sfsm::Work work = selector.select(decision, 99).work;
            EXPECT_EQ(forecast.frame[sfsm::WorkKind::person], work[sfsm::WorkKind::person]);
            // In units of price: what changes from one kind to another is counted in both.
            const double price = shape_cost(work), foreseen = shape_cost(step.work);
            EXPECT_NEAR(foreseen, price, bin_error * price) << preset << ", S = " << step.setting;
        }
    }
}

TEST(Selection, HasOnlyThoseWhoHaveArrived) {
    scene::Crowd crowd = small_scene().crowd;
    crowd.filled_tick = 1000;
    Selector selector(crowd, small_scene().cast, small_scene().figures());
    const render::View view = view_of("remote");
    std::int64_t before = 0;
    for (const std::int64_t tick : {0, 1, 250, 500, 1000}) {
        EXPECT_GE(selector.survey(view, tick).forecast.frame[sfsm::WorkKind::person], before);
        before = selector.survey(view, tick).forecast.frame[sfsm::WorkKind::person];
        EXPECT_EQ(selector.select({}, tick - 1).work[sfsm::WorkKind::person], before);
        EXPECT_TRUE(tick > 0 || before == 0);
    }
    EXPECT_EQ(before, select_once(view, {}).work[sfsm::WorkKind::person]);
}

// From so far away that all blocks of the stands are surveyed as one: the camera looks down from one and a half
// kilometres, or along the ground.
const render::View far_views[] = {
    render::make_view({{0, 1500, 300}, {0, 0, 0}, 0.4}, 640, 360),
    render::make_view({{900, 350, 700}, {0, 0, 0}, 0.5}, 640, 360),
};

// The forecast that asking person by person gives.
sfsm::Forecast by_person(render::Forecaster& forecaster, const Frame& frame, float range,
                         const render::SelectOptions& options) {
    const tests::SmallScene& scene = small_scene();
    forecaster.begin(range);
    for (const render::Person& person : frame.people) {
        const float pixels = frame.view.pixels_per_metre(person.depth), side = person.instance.scale * pixels;
        forecaster.add(0, scene::Role::spectator, person.depth, options.density * scene.poses[0].area * side * side,
                       pixels);
    }
    return forecaster.finish(options.theta);
}

// Blocks are a thirtieth of their distance deep, people's sizes those of the whole crowd: prices differ by a hundredth.
TEST(Survey, BlocksThatAreFarAreWorthTheirPeople) {
    constexpr double block_error = 0.01;
    for (const figures::Way* drawing : {&figures::by_opengl(), &figures::natively()}) {
        const figures::Way one_by_one = tests::without_blocks(*drawing), *way = &one_by_one;
        const render::SelectOptions options{.way = way};
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures(), options);
        const auto staleness =
            render::measure_staleness(small_scene().crowd, small_scene().cast, small_scene().figures());
        render::Forecaster forecaster({{figures::Choices(small_scene().figures()[0], *way), staleness[0]}}, *way,
                                      options.density);
        for (const render::View& view : far_views) {
            const render::Survey& survey = selector.survey(view, 100);
            const Frame& frame = selector.select({}, 99);
            float range = 1;
            for (const render::Person& person : frame.people) range = std::max(range, person.depth);
            EXPECT_EQ(survey.range, range);
            EXPECT_EQ(survey.forecast.frame[sfsm::WorkKind::person], std::ssize(frame.people));
            EXPECT_GT(frame.people.size(), small_scene().crowd.size() * 9 / 10);
            const sfsm::Forecast exact = by_person(forecaster, frame, range, options);
            for (std::size_t i = 0; i < exact.shapes.size(); ++i) {
                const sfsm::Step &step = survey.forecast.shapes[i], &expected = exact.shapes[i];
                const double cost = shape_cost(expected.work, *way);
                EXPECT_NEAR(shape_cost(step.work, *way), cost, block_error * cost) << "S = " << expected.setting;
                EXPECT_NEAR(step.loss_px, expected.loss_px, block_error * expected.loss_px);
            }
            for (std::size_t i = 0; i < exact.motion.size(); ++i) {
                const auto updates = [](const sfsm::Step& step) {
                    return static_cast<double>(step.work[sfsm::WorkKind::motion_update]);
                };
                EXPECT_NEAR(updates(survey.forecast.motion[i]), updates(exact.motion[i]),
                            5 * block_error * updates(exact.motion[i]))
                    << "D = " << exact.motion[i].setting;
            }
        }
    }
}

// Of blocks that are drawn as one: at each step as many people are drawn one by one as was foreseen, but for blocks
// that ask for just what one splat serves.
TEST(Survey, FarBlocksAreForeseenAsTheyAreDrawn) {
    for (const figures::Way* way : {&figures::by_opengl(), &figures::natively()}) {
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures(), {.way = way});
        for (const render::View& view : far_views) {
            const sfsm::Forecast forecast = selector.survey(view, 100).forecast;
            const std::vector<sfsm::Step> steps(forecast.shapes.begin(), forecast.shapes.end());
            const auto people = static_cast<double>(forecast.frame[sfsm::WorkKind::person]);
            const auto singles = [&](double splat_size) {
                const Frame& frame = selector.select(splat_size > 0 ? points_of(splat_size) : Decision{}, 99);
                EXPECT_EQ(frame.work[sfsm::WorkKind::person], forecast.frame[sfsm::WorkKind::person]);
                return static_cast<double>(frame.work[sfsm::WorkKind::single]);
            };
            EXPECT_EQ(singles(0), people) << "everybody by oneself";
            EXPECT_LT(singles(steps.back().setting), 0.05 * people);
            constexpr double bin = 0.05;  // of demand, and so twice what it is of S
            for (const sfsm::Step& step : steps) {
                const auto foreseen = static_cast<double>(step.work[sfsm::WorkKind::single]);
                EXPECT_LE(foreseen, singles(step.setting * (1 - bin)) * 1.01) << "S = " << step.setting;
                EXPECT_GE(foreseen, singles(step.setting * (1 + bin)) * 0.99) << "S = " << step.setting;
            }
        }
    }
}

// What their people do is asked every few ticks only, and so that nothing depends on the frames before.
TEST(Selection, OfFarBlocksDoesNotDependOnTheFramesBefore) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    const auto keys_at = [](Selector& by, std::int64_t tick) {
        by.survey(far_views[0], tick);
        const Frame& frame = by.select(points_of(4, 1e6), tick - 1);
        EXPECT_FALSE(frame.far_blocks.empty());
        std::vector<std::pair<render::FarBlock, std::vector<int>>> blocks;
        for (const render::FarBlock& block : frame.far_blocks) {
            const scene::CrowdBlock& all = small_scene().crowd.blocks[block.block];
            const std::uint8_t* first = frame.far_people.keys + all.first;
            EXPECT_LE(block.tick, tick);
            EXPECT_GT(block.tick, tick - 8);
            blocks.emplace_back(block, std::vector<int>(first, first + all.count));
        }
        return blocks;
    };
    std::set<std::vector<int>> different;
    for (const std::int64_t tick : {100, 101, 102, 5000, 7, 103, 104, 250'000'000}) {
        Selector fresh(small_scene().crowd, small_scene().cast, small_scene().figures());
        const auto keys = keys_at(selector, tick);
        EXPECT_EQ(keys, keys_at(fresh, tick)) << tick;
        different.insert(keys.front().second);
    }
    EXPECT_GT(different.size(), 3u) << "people move";
}

// From the first frame on: some blocks are asked at ticks before 0 then.
TEST(Selection, OfFarBlocksHasTheKeysOfTheirTicks) {
    const figures::SplatKeys keys = figures::splat_keys(small_scene().poses.front());
    for (const std::int64_t tick : {0, 1, 2, 3, 100}) {
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
        selector.survey(far_views[0], tick);
        const Frame& frame = selector.select(points_of(4, 1e6), tick - 1);
        EXPECT_FALSE(frame.far_blocks.empty());
        for (const render::FarBlock& far : frame.far_blocks) {
            const scene::CrowdBlock& block = small_scene().crowd.blocks[far.block];
            for (std::size_t person = block.first; person < block.first + block.count; ++person) {
                const scene::Action action =
                    scene::act(small_scene().crowd, person, small_scene().cast[0], small_scene().poses[0], far.tick);
                const int pose = small_scene().poses[0].pose_at(action.clip, action.clip_tick);
                ASSERT_EQ(frame.far_people.keys[person], keys.of_pose[static_cast<std::size_t>(pose)])
                    << "tick " << tick << ", asked at " << far.tick;
            }
        }
    }
}

// Each key is the one next to the pose that the person has.
TEST(Selection, KeysOfFarPeopleAreNextToTheirPoses) {
    const motion::PoseTable& poses = small_scene().poses.front();
    const figures::SplatKeys keys = figures::splat_keys(poses);
    ASSERT_EQ(keys.of_pose.size(), static_cast<std::size_t>(poses.pose_count));
    for (const motion::ClipPoses& clip : poses.clips) {
        std::vector<int> own;
        for (const int pose : keys.poses)
            if (pose >= clip.first_pose && pose < clip.first_pose + clip.pose_count) own.push_back(pose);
        ASSERT_FALSE(own.empty());
        const auto apart = [&](int a, int b) {
            const int steps = std::abs(a - b);
            return std::min(steps, clip.pose_count - steps);
        };
        for (int pose = clip.first_pose; pose < clip.first_pose + clip.pose_count; ++pose) {
            int least = clip.pose_count;
            for (const int key : own) least = std::min(least, apart(pose, key));
            // The last key of a clip may be nearer to its first than a step.
            const int chosen = keys.poses[keys.of_pose[static_cast<std::size_t>(pose)]];
            EXPECT_LE(apart(pose, chosen), std::max(least, poses.pose_count / 48 + 1)) << pose;
        }
    }
}

TEST(Survey, IsTheSameOnAnyNumberOfThreads) {
    for (const render::View& view : {far_views[0], far_views[1], view_of("remote")}) {
        std::vector<sfsm::Step> motion, shapes;
        for (const int threads : {1, 2, 4}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
            const sfsm::Forecast forecast = selector.survey(view, 100).forecast;
            if (threads == 1) {
                motion.assign(forecast.motion.begin(), forecast.motion.end());
                shapes.assign(forecast.shapes.begin(), forecast.shapes.end());
            }
            EXPECT_TRUE(std::ranges::equal(forecast.motion, motion)) << threads;
            EXPECT_TRUE(std::ranges::equal(forecast.shapes, shapes)) << threads;
        }
    }
}

// People who come in are counted one by one, far away too.
TEST(Survey, FarBlocksFillAsPeopleCome) {
    scene::Crowd crowd = small_scene().crowd;
    crowd.filled_tick = 1000;
    Selector selector(crowd, small_scene().cast, small_scene().figures());
    const auto people = [&](std::int64_t tick) {
        return static_cast<double>(selector.survey(far_views[0], tick).forecast.frame[sfsm::WorkKind::person]);
    };
    const double all = people(1000);
    EXPECT_EQ(people(0), 0);
    EXPECT_NEAR(people(500), all / 2, all / 20);
}

TEST(Forecast, CountsWhoMovesOnAverage) {
    for (const float theta : {motion::default_theta, 3 * motion::default_theta}) {
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures(), {.theta = theta});
        const sfsm::Forecast forecast = selector.survey(view_of("still"), 100).forecast;
        for (const sfsm::Step& step : std::vector(forecast.motion.begin(), forecast.motion.end())) {
            std::int64_t moved = 0;
            constexpr std::int64_t ticks = 2 * motion::max_period;
            for (std::int64_t tick = 100; tick < 100 + ticks; ++tick)
                moved += select_at(selector, view_of("still"), {State::slowed, step.setting, 0}, tick)
                             .work[sfsm::WorkKind::motion_update];
            const double mean = static_cast<double>(moved) / ticks;
            EXPECT_NEAR(static_cast<double>(step.work[sfsm::WorkKind::motion_update]), mean, bin_error * mean)
                << "theta = " << theta << ", D = " << step.setting;
        }
    }
}

// [px] How far the surface of everybody near enough to the view is from where it should be, on average over them and
// over ten minutes, if the motion distance is `motion_distance`.
double measured_displacement(const render::View& view, double motion_distance) {
    constexpr std::size_t person_stride = 7;
    constexpr int vertex_stride = 41, looks = 60;
    const tests::SmallScene& scene = small_scene();
    double displaced = 0;
    std::int64_t people = 0;
    for (int look = 0; look < looks; ++look) {
        const std::int64_t tick = 597 * look;
        for (std::size_t person = look % person_stride; person < scene.crowd.size(); person += person_stride) {
            const std::vector<glm::vec3> now = surface_of(person, tick, vertex_stride);
            const glm::vec3 middle = view.relative(now[now.size() / 2]);
            if (!render::sphere_visible(view, middle, 0.5f)) continue;
            ++people;
            const float depth = std::max(view.depth(middle), render::near_plane);
            const int period = motion::update_period(depth, static_cast<float>(motion_distance));
            if (period == 1) continue;
            const std::vector<glm::vec3> old =
                surface_of(person, motion::due_tick(tick, period, scene.crowd.hash[person]), vertex_stride);
            double moved = 0;
            for (std::size_t spot = 0; spot < now.size(); ++spot)
                moved += static_cast<double>(glm::distance(now[spot], old[spot])) / static_cast<double>(now.size());
            displaced += moved * static_cast<double>(view.pixels_per_metre(depth));
        }
    }
    return displaced / static_cast<double>(people);
}

TEST(Forecast, LossOfMotionIsTheCrowdsOwnOverTime) {
    for (const char* preset : {"still", "remote"}) {
        const render::View view = view_of(preset);
        Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
        const sfsm::Forecast forecast = selector.survey(view, 100).forecast;
        for (const sfsm::Step& step : forecast.motion) {
            const double measured = measured_displacement(view, step.setting);
            constexpr double chance = 0.12;  // who is excited when, among a few hundred
            EXPECT_NEAR(step.loss_px, measured, chance * measured + 0.0003) << preset << ", D = " << step.setting;
        }
    }
}

TEST(Forecast, WorkShrinksAndLossGrowsAlongTheSteps) {
    Selector selector(small_scene().crowd, small_scene().cast, small_scene().figures());
    for (const char* preset : {"still", "close", "medium", "remote"}) {
        const sfsm::Forecast forecast = selector.survey(view_of(preset), 100).forecast;
        for (std::size_t i = 1; i < forecast.shapes.size(); ++i) {
            const sfsm::Step &finer = forecast.shapes[i - 1], &coarser = forecast.shapes[i];
            EXPECT_GT(coarser.setting, finer.setting);
            EXPECT_LE(2 * coarser.work[sfsm::WorkKind::point] + coarser.work[sfsm::WorkKind::triangle],
                      2 * finer.work[sfsm::WorkKind::point] + finer.work[sfsm::WorkKind::triangle]);
            EXPECT_GE(coarser.loss_px, finer.loss_px);
        }
        for (std::size_t i = 1; i < forecast.motion.size(); ++i) {
            EXPECT_LT(forecast.motion[i].setting, forecast.motion[i - 1].setting);
            EXPECT_LE(forecast.motion[i].work[sfsm::WorkKind::motion_update],
                      forecast.motion[i - 1].work[sfsm::WorkKind::motion_update]);
            EXPECT_GE(forecast.motion[i].loss_px, forecast.motion[i - 1].loss_px);
        }
    }
}

// Natively a person has any number of points, the last of them in part, and a model has more of them.

Selector native_selector() {
    static const tests::SmallScene scene(3000, 3.0);
    return {scene.crowd, scene.cast, scene.figures(), {.way = &figures::natively()}};
}

TEST(NativeSelection, WorkIsTheSumOverItsPeople) {
    Selector selector = native_selector();
    for (const double splat_size : {0.0, 0.5, 1.0, 2.7, 9.0}) {
        const Frame& frame =
            select_at(selector, view_of("still"), splat_size > 0 ? points_of(splat_size) : Decision{}, 100);
        std::int64_t triangles = 0, points = 0;
        for (const render::Person& person : frame.people) {
            EXPECT_GT(person.last_share, 0);
            EXPECT_LE(person.last_share, 1);
            EXPECT_GT(person.depth, 0);
            const std::uint32_t drawn = tests::points_of(person, figures::natively());
            points += drawn;
            if (drawn == 0) triangles += static_cast<std::int64_t>(small_scene().person.mesh.triangle_count());
        }
        EXPECT_EQ(frame.work[sfsm::WorkKind::person], std::ssize(frame.people) + people_far_away(frame));
        EXPECT_EQ(frame.work[sfsm::WorkKind::single], std::ssize(frame.people));
        EXPECT_EQ(frame.work[sfsm::WorkKind::triangle], triangles) << "S = " << splat_size;
        EXPECT_EQ(frame.work[sfsm::WorkKind::point], points) << "S = " << splat_size;
        EXPECT_EQ(points > 0, splat_size > 0);
    }
}

TEST(NativeSelection, StateFollowsFromWhatWasDrawn) {
    const double far = 2 * 300;  // [m] beyond everybody
    Selector selector = native_selector();
    const auto state = [&](const char* preset, const Decision& decision) {
        return select_at(selector, view_of(preset), decision, 100).state;
    };
    EXPECT_EQ(state("still", {}), State::original);
    EXPECT_EQ(state("still", {State::slowed, 5, 0}), State::slowed);
    EXPECT_EQ(state("still", points_of(4, far)), State::points);
    EXPECT_EQ(state("close", points_of(0.01, far)), State::original) << "all need more points than a model has";
    EXPECT_EQ(state("close", points_of(0.01, 1)), State::slowed);
}

TEST(NativeSelection, LargerSplatsNeverCostMore) {
    Selector selector = native_selector();
    const auto price = [&](const Decision& decision) {
        return shape_cost(select_at(selector, view_of("still"), decision, 100).work, figures::natively());
    };
    double last = price({});
    for (double splat_size = 0.25; splat_size <= 32; splat_size *= 1.1) {
        const double now = price(points_of(splat_size));
        EXPECT_LE(now, last) << "S = " << splat_size;
        last = now;
    }
}

TEST(NativeForecast, CountsWhatSelectionDraws) {
    constexpr double error = 0.03;  // bins of demand are sixteenths of an octave
    const auto one = static_cast<double>(small_scene().person.mesh.triangle_count());  // somebody in the next bin
    Selector selector = native_selector();
    for (const char* preset : {"still", "close", "medium", "remote"}) {
        const sfsm::Forecast forecast = selector.survey(view_of(preset), 100).forecast;
        for (const sfsm::Step& step : forecast.shapes) {
            const Decision decision = step.setting == 0 ? Decision{} : points_of(step.setting);
            const double price = shape_cost(selector.select(decision, 99).work, figures::natively());
            const double foreseen = shape_cost(step.work, figures::natively());
            EXPECT_NEAR(foreseen, price, error * price + one) << preset << ", S = " << step.setting;
        }
    }
}

}  // namespace
