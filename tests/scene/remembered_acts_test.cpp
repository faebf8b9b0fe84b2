// What is remembered of what people do, against asking anew each time.
#include "scene/remembered_acts.h"

#include <gtest/gtest.h>

#include <limits>

#include "sfsm/random.h"
#include "tests/scene/fake_cast.h"

namespace {

using scene::Act;
using scene::Action;
using scene::Crowd;
using scene::RememberedActs;
using scene::Role;
using tests::FakeCast;

constexpr std::int64_t wave_lap = 20 * 60, wave_interval = 45 * 60;  // [ticks]

bool same(const Action& a, const Action& b) {
    return a.clip == b.clip && a.clip_tick == b.clip_tick;
}

// Sitters change acts and know waves; others keep one. Spectators, standing people and athletes.
struct Scene {
    FakeCast cast;
    Crowd crowd;

    explicit Scene(int seated_ticks = tests::seated_ticks) {
        tests::add_sitter(cast);
        for (int clip = 0; clip < 3; ++clip) {
            cast.poses[0].clips[clip].pose_count = seated_ticks;
            cast.poses[0].clips[clip].ticks_per_pose = 1;
        }
        tests::add_stander(cast);
        crowd = tests::populate(cast, 60'000);
    }
    Act around(std::size_t i, std::int64_t tick) const {
        return scene::act_around(crowd, i, member(i), poses(i), tick);
    }
    Action at(std::size_t i, std::int64_t tick) const { return scene::act(crowd, i, member(i), poses(i), tick); }
    Action at(RememberedActs& acts, std::size_t i, std::int64_t tick) const {
        return acts.at(i, member(i), poses(i), tick);
    }
    const scene::CastMember& member(std::size_t i) const { return cast.members[crowd.character[i]]; }
    const motion::PoseTable& poses(std::size_t i) const { return cast.poses[crowd.character[i]]; }
};

// Each role and character among them.
constexpr std::size_t stride = 487;

const Scene& shared_scene() {
    static const Scene scene;
    return scene;
}

TEST(Acts, LastFromTheirFirstTickToTheirLast) {
    const Scene& scene = shared_scene();
    bool held[2] = {}, waves = false;
    for (std::size_t i = 0; i < scene.crowd.size(); i += stride) {
        for (std::int64_t tick = -wave_lap; tick < 2 * wave_interval;) {
            const Act act = scene.around(i, tick);
            ASSERT_LE(act.from, tick);
            ASSERT_GT(act.until, tick);
            for (std::int64_t other = act.from; other < act.until; ++other) {
                ASSERT_TRUE(same(act.at(other), scene.at(i, other))) << i << " at " << other;
                ASSERT_EQ(scene.around(i, other).until, act.until) << i << " at " << other;
            }
            const Act next = scene.around(i, act.until);
            EXPECT_EQ(next.from, act.until);
            held[0] |= act.holds && !next.holds;
            held[1] |= next.holds && !act.holds;
            waves |= !act.holds && act.until - act.from == tests::seated_ticks && next.holds;
            tick = act.until;
        }
    }
    EXPECT_TRUE(held[0] && held[1] && waves) << "no hold was looked at";
}

TEST(RememberedActs, AreThoseThatWouldBeFoundAnewTickAfterTick) {
    const Scene& scene = shared_scene();
    RememberedActs acts(scene.crowd);
    for (std::int64_t tick = wave_interval - 100; tick < 2 * wave_interval + 2 * wave_lap; ++tick)
        for (std::size_t i = 0; i < scene.crowd.size(); i += 10 * stride)
            ASSERT_TRUE(same(scene.at(acts, i, tick), scene.at(i, tick))) << i << " at " << tick;
}

TEST(RememberedActs, AreThoseThatWouldBeFoundAnewInAnyOrder) {
    const Scene& scene = shared_scene();
    RememberedActs acts(scene.crowd);
    for (std::uint64_t n = 0; n < 200'000; ++n) {
        const std::size_t i = stride * sfsm::below(sfsm::hash(1, n), 100);
        // Near where they were last, and anywhere.
        const std::int64_t tick = n % 3 == 0
                                      ? sfsm::below(sfsm::hash(2, n), 100'000)
                                      : 5 * static_cast<std::int64_t>(n) / 100 - sfsm::below(sfsm::hash(3, n), 64);
        ASSERT_TRUE(same(scene.at(acts, i, tick), scene.at(i, tick))) << i << " at " << tick;
    }
}

// What doesn't fit into what is kept is found all the same.
TEST(RememberedActs, HoldForLongClipsAndLateTicks) {
    for (const int ticks : {240, 70'000}) {
        const Scene scene(ticks);
        RememberedActs acts(scene.crowd);
        constexpr std::int64_t latest = std::numeric_limits<std::int32_t>::max();
        for (const std::int64_t start : {std::int64_t{0}, latest - 500, latest, 3 * latest, -latest - 500, -3 * latest})
            for (std::int64_t tick = start; tick < start + 1000; tick += 7)
                for (std::size_t i = 0; i < scene.crowd.size(); i += 20 * stride)
                    ASSERT_TRUE(same(scene.at(acts, i, tick), scene.at(i, tick))) << i << " at " << tick;
    }
}

}  // namespace
