// No bound is ever broken, and none is so loose that it says nothing.
#include "render/error_bounds.h"

#include <gtest/gtest.h>

#include <map>

#include "sfsm/random.h"
#include "tests/render/small_scene.h"
#include "tests/render/true_errors.h"

namespace {

using scene::Role;

const tests::SmallScene& small_scene() {
    static const tests::SmallScene scene(3000, 3);
    return scene;
}

// Among whom every seventh of the spectators stands: in so few seats everybody finds one.
const scene::Crowd& crowd_of_all_roles() {
    static const scene::Crowd crowd = [] {
        scene::Crowd some = small_scene().crowd;
        for (std::size_t person = 0; person < some.size(); person += 7)
            if (some.role[person] == Role::spectator) some.role[person] = Role::standing;
        return some;
    }();
    return crowd;
}

const render::ErrorBounds& bounds_of_scene() {
    static const auto bounds =
        render::measure_error_bounds(crowd_of_all_roles(), small_scene().cast, small_scene().figures());
    return bounds[0];
}

// By period: the largest that was seen of what the bound allows.
using Shares = std::array<double, motion::max_period + 1>;

// Adds what is seen of a person in a hundred ticks from one on; nothing may be beyond the bound.
void watch(const tests::Watched& of, const render::MotionBounds& bounds, std::size_t person, std::int64_t from,
           bool far, Shares& shares) {
    constexpr int ticks = 100;
    const figures::SplatKeys keys = figures::splat_keys(of.poses);
    const render::MotionBound& bound =
        (far ? bounds.far : bounds.single)[static_cast<std::size_t>(of.crowd.role[person])];
    std::vector<std::vector<glm::dvec3>> real, shown;
    for (std::int64_t tick = from; tick < from + ticks; ++tick) {
        real.push_back(tests::surface_at(of, person, tick));
        shown.push_back(far ? tests::surface_at(of, person, tick, &keys) : real.back());
    }
    const int longest = far ? motion::max_period - 1 + render::ticks_a_key - 1 : motion::max_period - 1;
    const double scale = tests::scale_of(of, person);
    for (int now = 0; now < ticks; ++now)
        for (int age = 0; age <= std::min(longest, now); ++age) {
            const int period = far ? std::max(1, age + 2 - render::ticks_a_key) : age + 1;
            const double apart = tests::farthest_apart(real[now], shown[now - age]);
            const double allowed = scale * static_cast<double>(bound[period]);
            ASSERT_LE(apart, allowed) << "person " << person << " at " << from + now << ", " << age << " ticks old";
            for (int longer = period; longer <= motion::max_period; ++longer)
                if (bound[longer] > 0)
                    shares[longer] = std::max(shares[longer], apart / scale / static_cast<double>(bound[longer]));
        }
}

// Some people of a role, when one act of theirs ends and another begins, and at other times.
Shares watch_some(Role role, bool far) {
    const scene::CastMember& member = small_scene().cast[0];
    const motion::PoseTable& poses = small_scene().poses[0];
    const scene::Crowd& crowd = crowd_of_all_roles();
    constexpr int most_people = 24;
    Shares shares{};
    int people = 0;
    for (std::size_t person = 0; person < crowd.size() && people < most_people; ++person) {
        if (crowd.role[person] != role) continue;
        ++people;
        const std::int64_t tick = 977 * people;
        const scene::Act act = scene::act_around(crowd, person, member, poses, tick);
        for (const std::int64_t from : {act.until - 50, act.from + 20, act.until - 200})
            watch({crowd, member, poses}, bounds_of_scene().motion, person, from, far, shares);
    }
    EXPECT_GT(people, 5);
    return shares;
}

TEST(ErrorBounds, NobodyWhoMovesLessOftenIsFartherOffThanTheirBound) {
    for (const Role role : {Role::spectator, Role::standing, Role::walker, Role::runner}) {
        const render::MotionBound& bound = bounds_of_scene().motion.single[static_cast<std::size_t>(role)];
        EXPECT_EQ(bound[0], 0);
        EXPECT_EQ(bound[1], 0);
        EXPECT_TRUE(std::ranges::is_sorted(bound));
        const Shares shares = watch_some(role, false);
        for (int period = 2; period <= motion::max_period; ++period)
            EXPECT_GT(shares[period], 0.8) << "role " << static_cast<int>(role) << ", period " << period;
    }
}

TEST(ErrorBounds, NobodyInAFarBlockIsFartherOffThanTheirBound) {
    for (const Role role : {Role::spectator, Role::standing}) {
        EXPECT_TRUE(std::ranges::is_sorted(bounds_of_scene().motion.far[static_cast<std::size_t>(role)]));
        const Shares shares = watch_some(role, true);
        for (int period = 1; period <= motion::max_period; ++period)
            EXPECT_GT(shares[period], 0.8) << "role " << static_cast<int>(role) << ", period " << period;
    }
}

// Clips of one vertex and one point that jump about by chance.
motion::PoseTable jumping(std::initializer_list<motion::ClipPoses> clips, std::uint64_t seed) {
    motion::PoseTable table;
    table.clips = clips;
    table.vertex_count = table.point_count = 1;
    table.box = {glm::vec3(-1), glm::vec3(1)};
    table.rest_height = 2;
    for (motion::ClipPoses& clip : table.clips) {
        clip.first_pose = table.pose_count;
        table.pose_count += clip.pose_count;
        table.clip_boxes.push_back(table.box);
    }
    for (int pose = 0; pose < table.pose_count; ++pose) {
        const std::uint64_t bits = sfsm::hash(seed, static_cast<std::uint64_t>(pose));
        table.vertices.push_back({static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(bits >> 16),
                                  static_cast<std::uint16_t>(bits >> 32), 0, 0});
    }
    table.points = table.vertices;
    return table;
}

// One spectator, who plays the first clip, and in excitement the others.
scene::Crowd lone_spectator(std::uint32_t own) {
    scene::Crowd crowd;
    crowd.position = {glm::vec3(0)};
    crowd.yaw = {1};
    crowd.height = {1.6f};
    crowd.character = {0};
    crowd.role = {Role::spectator};
    crowd.around = {0.3f};
    crowd.hash = {own};
    crowd.palette.resize(1);
    crowd.blocks = {{0, 1, {}, {}}};
    return crowd;
}

// What is seen in ten minutes is the bound, for some people together, where every pose may be next to any other's.
void expect_exact(const motion::PoseTable& table, std::vector<std::uint8_t> excited) {
    scene::CastMember member;
    member.acts[0] = {{0}, std::move(excited)};
    const model::Mesh mesh;
    const std::vector<figures::Figure> figures{{&mesh, &table, nullptr}};
    Shares shares{};
    for (std::uint32_t own = 0; own < 6; ++own) {
        const scene::Crowd crowd = lone_spectator(own);
        const auto bounds = render::measure_motion_bounds(crowd, std::span(&member, 1), figures);
        for (std::int64_t tick = -1000; tick < 36'000; tick += 60) {
            watch({crowd, member, table}, bounds[0], 0, tick, false, shares);
            if (tick % 600 == 0) watch({crowd, member, table}, bounds[0], 0, tick, true, shares);
        }
    }
    for (int period = 2; period <= motion::max_period; ++period) EXPECT_GT(shares[period], 0.999) << period;
}

TEST(ErrorBounds, AreWhatIsSeenOfOneClip) {
    expect_exact(jumping({{0, 90, 1}}, 1), {});
    expect_exact(jumping({{0, 7, 1}}, 2), {});
    expect_exact(jumping({{0, 25, 4}}, 3), {});
    expect_exact(jumping({{0, 3, 50}}, 4), {});
}

TEST(ErrorBounds, CountTheStepFromAClipToAnother) {
    // Still but for the change of clips, and for who waits between them.
    motion::PoseTable table = jumping({{0, 60, 1}, {0, 60, 1}}, 5);
    for (int pose = 0; pose < 60; ++pose) table.vertices[pose] = table.vertices[0];
    for (int pose = 60; pose < 120; ++pose) table.vertices[pose] = table.vertices[60];
    expect_exact(table, {1});
    expect_exact(jumping({{0, 60, 1}, {0, 60, 1}, {0, 60, 1}}, 6), {1, 2});
}

TEST(ErrorBounds, CountTheStepFromThePoseThatIsHeldToAClip) {
    // Who waits for a wave holds the first pose; from no other is it so far to the first of those that follow.
    motion::PoseTable table = jumping({{0, 60, 1}, {0, 60, 1}}, 5);
    for (motion::PosedVertex& vertex : table.vertices) vertex = {32767, 0, 0, 0, 0};
    table.vertices[0].x = 0;
    for (int pose = 60; pose < 90; ++pose) table.vertices[pose].x = 65535;
    expect_exact(table, {1});
}

TEST(ErrorBounds, CountNoStepToAClipThatNeverFollows) {
    motion::PoseTable table = jumping({{0, 60, 1}, {0, 61, 1}}, 7);
    for (int pose = 0; pose < 60; ++pose) table.vertices[pose] = table.vertices[0];
    for (int pose = 60; pose < 121; ++pose) table.vertices[pose] = table.vertices[60];
    scene::CastMember member;
    member.acts[0] = {{0}, {1}};
    const model::Mesh mesh;
    const std::vector<figures::Figure> figures{{&mesh, &table, nullptr}};
    const auto bounds = render::measure_motion_bounds(lone_spectator(1), std::span(&member, 1), figures);
    EXPECT_EQ(bounds[0].single[0].back(), 0) << "clips of two lengths don't alternate";
}

TEST(ErrorBounds, TurningOnTheSpotIsCounted) {
    struct Back final : scene::Path {
        float length(float) const override { return 20; }
        glm::vec2 position(float arc, float offset) const override {
            const float rest = arc - 20 * std::floor(arc / 20);
            return {rest < 10 ? rest : 20 - rest, offset};
        }
        glm::vec2 tangent(float arc, float) const override {
            return {arc - 20 * std::floor(arc / 20) < 10 ? 1 : -1, 0};
        }
        float turning(float) const override { return std::numeric_limits<float>::infinity(); }
        motion::Bounds bounds(float offset) const override { return {{0, 0, offset}, {10, 0, offset}}; }
    };
    scene::Crowd crowd = lone_spectator(1);
    crowd.role = {Role::walker};
    crowd.path = std::make_shared<Back>();
    scene::CastMember member;
    for (scene::Acts& acts : member.acts) acts.calm = {0};
    member.gait_speed[static_cast<int>(Role::walker)] = 1.4f;
    motion::PoseTable table = jumping({{0, 1, 1}}, 8);
    const model::Mesh mesh;
    const std::vector<figures::Figure> figures{{&mesh, &table, nullptr}};
    const auto bounds = render::measure_motion_bounds(crowd, std::span(&member, 1), figures);
    Shares shares{};
    for (std::int64_t tick = -100; tick < 4000; tick += 60)
        watch({crowd, member, table}, bounds[0], 0, tick, false, shares);
    EXPECT_GT(shares[2], 0.9);
}

TEST(ErrorBounds, NoPieceOfASurfaceIsFartherFromItsPointsThanTheirBound) {
    const figures::Figure figure = small_scene().figures()[0];
    const render::Covering& covering = bounds_of_scene().covering;
    const int all = figure.poses->point_count;
    const std::vector<int> counts{1, 2, 3, 4, 7, 8, 15, 16, 17, 31, 100, 255, 256, 1000, all - 1, all};
    std::vector<double> most(counts.size());
    for (int pose = 5; pose < figure.poses->pose_count; pose += 61) {
        const std::vector<double> seen = tests::true_covering(figure, pose, counts);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            ASSERT_LE(seen[i], static_cast<double>(covering.radius(static_cast<std::uint32_t>(counts[i]))))
                << counts[i] << " points, pose " << pose;
            most[i] = std::max(most[i], seen[i]);
        }
    }
    constexpr double loosest = 2.5;
    for (std::size_t i = 0; i < counts.size(); ++i)
        EXPECT_LT(covering.radius(static_cast<std::uint32_t>(counts[i])), loosest * most[i]) << counts[i];
    for (int count = 1; count <= all + 1; ++count)
        ASSERT_LE(covering.radius(static_cast<std::uint32_t>(count)),
                  covering.radius(static_cast<std::uint32_t>(count) - 1));
}

TEST(ErrorBounds, WhoHasNoPointsIsNotCovered) {
    const auto casting = scene::cast(small_scene().person);
    const motion::PoseTable poses = motion::bake_poses(small_scene().person, casting.clips, {}, std::size_t{1} << 26);
    const render::Covering covering({&small_scene().person.mesh, &poses, nullptr});
    EXPECT_EQ(covering.radius(100), std::numeric_limits<float>::infinity());
    EXPECT_EQ(bounds_of_scene().covering.radius(0), std::numeric_limits<float>::infinity());
}

}  // namespace
