// What a frame may promise holds for characters of others too: many clips of lengths of their own, parts of bodies,
// morph targets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "render/error_bounds.h"
#include "scene/cast.h"
#include "scene/places/stadium.h"
#include "tests/reference/studio.h"
#include "tests/render/true_errors.h"

namespace {

class BoundsOf : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        model_ = reference::model_of_file(GetParam(), figures::natively());
        if (!model_) GTEST_SKIP() << "NO ../shared/assets/" << GetParam() << ", NOTHING IS MEASURED";
        member_ = scene::cast(model_->character).member;
        const std::span<const scene::CastMember> cast(&member_, 1);
        const std::span<const motion::PoseTable> poses(&model_->poses, 1);
        crowd_ = scene::populate(scene::plan_stadium(people, scene::room_for(cast, poses)), {people, cast, poses, 1});
        const figures::Figure figure = model_->product();
        bounds_ = render::measure_error_bounds(crowd_, cast, std::span(&figure, 1))[0];
    }

    static constexpr std::int64_t people = 1000;
    std::unique_ptr<reference::Model> model_;
    scene::CastMember member_;
    scene::Crowd crowd_;
    render::ErrorBounds bounds_;
};

TEST_P(BoundsOf, MotionAreNeverBrokenAndReached) {
    constexpr int ticks = 70, most_people = 4;
    constexpr std::array ages{1, 2, 3, 7, 15, 31};
    const tests::Watched of{crowd_, member_, model_->poses};
    std::array<int, scene::role_count> watched{};
    std::array<std::array<double, ages.size()>, scene::role_count> shares{};
    for (std::size_t person = 0; person < crowd_.size(); ++person) {
        const auto role = static_cast<std::size_t>(crowd_.role[person]);
        if (watched[role]++ >= most_people) continue;
        const scene::Act act = scene::act_around(crowd_, person, member_, model_->poses, 1009 * watched[role]);
        std::vector<std::vector<glm::dvec3>> surfaces;
        for (std::int64_t tick = act.until - ticks / 2; tick < act.until + ticks / 2; ++tick)
            surfaces.push_back(tests::surface_at(of, person, tick));
        for (std::size_t i = 0; i < ages.size(); ++i)
            for (int now = ages[i]; now < ticks; ++now) {
                const double allowed =
                    tests::scale_of(of, person) *
                    static_cast<double>(bounds_.motion.single[role][static_cast<std::size_t>(ages[i]) + 1]);
                const double apart = tests::farthest_apart(surfaces[now], surfaces[now - ages[i]]);
                ASSERT_LE(apart, allowed) << "role " << role << ", " << ages[i] << " ticks";
                if (allowed > 0) shares[role][i] = std::max(shares[role][i], apart / allowed);
            }
    }
    for (std::size_t role = 0; role < scene::role_count; ++role)
        for (std::size_t i = 0; i < ages.size() && watched[role] > 0; ++i)
            EXPECT_TRUE(shares[role][i] > 0.5 || bounds_.motion.single[role].back() == 0)
                << "role " << role << ", " << ages[i] << " ticks: " << shares[role][i];
}

TEST_P(BoundsOf, CoveringIsNeverBrokenAndNotLoose) {
    // Of so few poses: the bound is of all, and the worst may be one in a hundred.
    constexpr double loosest = 3.5;
    const figures::Figure figure = model_->product();
    std::vector<int> counts{4, 8, 20, 64, 200, 600, figure.poses->point_count};
    std::erase_if(counts, [&](int count) { return count > figure.poses->point_count; });
    std::vector<double> most(counts.size());
    constexpr int poses = 9;
    for (int i = 0; i < poses; ++i) {
        const std::vector<double> seen =
            tests::true_covering(figure, (2 * i + 1) * figure.poses->pose_count / (2 * poses), counts);
        for (std::size_t n = 0; n < counts.size(); ++n) {
            ASSERT_LE(seen[n], static_cast<double>(bounds_.covering.radius(static_cast<std::uint32_t>(counts[n]))))
                << counts[n] << " points";
            most[n] = std::max(most[n], seen[n]);
        }
    }
    for (std::size_t n = 0; n < counts.size(); ++n)
        EXPECT_LT(bounds_.covering.radius(static_cast<std::uint32_t>(counts[n])), loosest * most[n]) << counts[n];
}

INSTANTIATE_TEST_SUITE_P(Characters, BoundsOf,
                         testing::Values("CesiumMan/CesiumMan.glb", "Fox/Fox.glb",
                                         "QuaterniusKnight/KnightCharacter.glb",
                                         "AnimatedMorphCube/AnimatedMorphCube.glb", "RaylibRobot/robot.glb"),
                         [](const auto& test) {
                             const std::string name = test.param;
                             return name.substr(0, name.find('/'));
                         });

}  // namespace
