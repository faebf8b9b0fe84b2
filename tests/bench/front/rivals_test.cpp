// Rivals are what they say they are: of people of all sizes, and in a crowd.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/bench/front/rivals/by_distance.h"
#include "tests/bench/front/rivals/largest_first.h"
#include "tests/bench/front/rivals/roll.h"
#include "tests/bench/front/rivals/smallest_demoted.h"
#include "tests/bench/front/small_venue.h"
#include "tests/bench/front/views.h"

namespace {

using bench::front::ByDistance;
using bench::front::LargestFirst;
using bench::front::Rival;
using bench::front::SmallestDemoted;
using render::Subject;

constexpr double floor_points = 16;
constexpr double density = 1.2;
constexpr double infinity = std::numeric_limits<double>::infinity();

bench::front::Cast cast() {
    return bench::front::cast_of(bench::front::small_venue().stage().figures());
}

// Somebody whose surface covers 4 million px^2 at a metre.
Subject somebody_at(double depth) {
    Subject subject;
    subject.depth = static_cast<float>(depth);
    subject.surface = static_cast<float>(4e6 / (depth * depth));
    subject.demand = static_cast<float>(density) * subject.surface;
    return subject;
}

// From 20 m to 2 km, no two as far; in no order.
std::vector<Subject> people() {
    constexpr std::size_t count = 997, step = 389;  // primes
    std::vector<Subject> all;
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(somebody_at(20 * std::pow(100.0, static_cast<double>(i * step % count) / count)));
    return all;
}

// [points] What the mesh is believed to cost, by prices alone.
double mesh_points() {
    const auto choices = cast();
    const sfsm::Work work = choices[0].all()[choices[0].exact()].level.work;
    double pieces = 0;
    for (std::size_t i = 0; i < sfsm::work_kinds; ++i)
        pieces += figures::natively().pieces[i] * static_cast<double>(work.counts[i]);
    return std::floor(pieces / figures::natively().pieces[sfsm::index_of(sfsm::WorkKind::point)]);
}

// [points] Half a pixel apart; the mesh, of which there are more than there are points.
double wanted_by(const Subject& subject) {
    constexpr double splat_area = 0.25, fewest = 4;  // [px^2], points
    const double wanted = std::max(fewest, std::ceil(static_cast<double>(subject.demand) / splat_area));
    return wanted <= static_cast<double>(cast()[0].most_samples()) ? wanted : mesh_points();
}

double spent_by(const Rival& rival, const Subject& subject) {
    const auto points = static_cast<double>(rival.points_of(subject));
    return std::isfinite(points) ? points : mesh_points();
}

double spent_by(const Rival& rival, const std::vector<Subject>& of) {
    double spent = 0;
    for (const Subject& subject : of) spent += spent_by(rival, subject);
    return spent;
}

template <typename Rule>
Rule settled(double budget, const std::vector<Subject>& of = people()) {
    Rule rule(cast(), budget);
    rule.settle(of);
    return rule;
}

template <typename Rule>
class FrontBudget : public testing::Test {};
using Budgets = testing::Types<LargestFirst, SmallestDemoted>;
TYPED_TEST_SUITE(FrontBudget, Budgets);

TYPED_TEST(FrontBudget, IsKeptWithinOnePersonsPoints) {
    const auto all = people();
    const double most = spent_by(settled<TypeParam>(infinity), all);
    const double least = spent_by(settled<TypeParam>(0), all);
    ASSERT_GT(most, 20 * least);
    for (double budget = least; budget < most; budget *= 1.37) {
        const double spent = spent_by(settled<TypeParam>(budget), all);
        EXPECT_LE(spent, budget);
        EXPECT_GE(spent, budget - mesh_points());
    }
}

TYPED_TEST(FrontBudget, MoreOfItTakesFromNobody) {
    const auto all = people();
    std::vector<double> before(all.size(), 0);
    for (double budget = 5e3; budget < 2e7; budget *= 1.37) {
        const TypeParam rule = settled<TypeParam>(budget);
        for (std::size_t i = 0; i < all.size(); ++i) {
            EXPECT_GE(spent_by(rule, all[i]), before[i]);
            before[i] = spent_by(rule, all[i]);
        }
    }
}

TYPED_TEST(FrontBudget, LeavesEverybodyTheFloorAndNoneMoreThanAHalfPixelAsksFor) {
    for (const double budget : {0.0, 2e4, 2e5, 2e6, infinity}) {
        const TypeParam rule = settled<TypeParam>(budget);
        for (const Subject& subject : people()) {
            const double wanted = wanted_by(subject);
            EXPECT_GE(spent_by(rule, subject), std::min(floor_points, wanted));
            EXPECT_LE(spent_by(rule, subject), wanted);
        }
    }
}

TYPED_TEST(FrontBudget, IsTheFloorWithoutAnyAndAllWithoutBounds) {
    const TypeParam none = settled<TypeParam>(0), all = settled<TypeParam>(infinity);
    for (const Subject& subject : people()) {
        const double wanted = wanted_by(subject);
        EXPECT_EQ(spent_by(none, subject), std::min(floor_points, wanted));
        EXPECT_EQ(spent_by(all, subject), wanted);
    }
}

TYPED_TEST(FrontBudget, WhoIsAsLargeIsDrawnAlike) {
    const std::vector<Subject> same(500, somebody_at(200));
    const TypeParam all = settled<TypeParam>(infinity, same), none = settled<TypeParam>(0, same);
    ASSERT_GT(spent_by(all, same), spent_by(none, same));
    const TypeParam half = settled<TypeParam>((spent_by(all, same) + spent_by(none, same)) / 2, same);
    EXPECT_LE(spent_by(half, same), spent_by(all, same) / 2 + spent_by(none, same));
}

TYPED_TEST(FrontBudget, WhoIsTooNearIsAMesh) {
    std::vector<Subject> all = people();
    all[3].surface = all[3].demand = std::numeric_limits<float>::infinity();
    const TypeParam rule = settled<TypeParam>(0, all);
    EXPECT_EQ(rule.points_of(all[3]), std::numeric_limits<float>::infinity());
    EXPECT_EQ(rule.shape_of(all[3]).choice, cast()[0].exact());
}

TEST(FrontRivals, LargestFirstGivesAllOrTheFloor) {
    const LargestFirst rule = settled<LargestFirst>(4e5), all = settled<LargestFirst>(infinity),
                       none = settled<LargestFirst>(0);
    double smallest_full = infinity, largest_floor = 0;
    for (const Subject& subject : people()) {
        const double spent = spent_by(rule, subject), surface = static_cast<double>(subject.surface);
        if (spent_by(all, subject) == spent_by(none, subject)) continue;
        if (spent == spent_by(all, subject))
            smallest_full = std::min(smallest_full, surface);
        else {
            EXPECT_EQ(spent, spent_by(none, subject));
            largest_floor = std::max(largest_floor, surface);
        }
    }
    EXPECT_GT(largest_floor, 0);
    EXPECT_LT(smallest_full, infinity);
    EXPECT_GT(smallest_full, largest_floor);
}

TEST(FrontRivals, DemotionIsOfALevelAtATime) {
    const SmallestDemoted rule = settled<SmallestDemoted>(1e5), all = settled<SmallestDemoted>(infinity);
    int least_lost = 99, most_lost = 0;
    for (const Subject& subject : people()) {
        const double spent = spent_by(rule, subject);
        if (spent <= floor_points) continue;
        const int lost = static_cast<int>(std::lround(std::log2(spent_by(all, subject) / spent)));
        least_lost = std::min(least_lost, lost);
        most_lost = std::max(most_lost, lost);
    }
    EXPECT_GT(most_lost, 0);
    EXPECT_LE(most_lost - least_lost, 1);
}

TEST(FrontRivals, ByDistanceNobodyGetsFewerForBeingNearerOrForLongerDistances) {
    const ByDistance::Distances shorter{40, 80, 400}, longer{50, 100, 500};
    const ByDistance one(cast(), shorter), other(cast(), longer);
    double before = infinity;
    for (double depth = 20; depth < 2000; depth *= 1.03) {
        const Subject subject = somebody_at(depth);
        EXPECT_LE(spent_by(one, subject), before) << depth;
        EXPECT_LE(spent_by(one, subject), spent_by(other, subject)) << depth;
        EXPECT_GE(one.is_splat(subject), other.is_splat(subject)) << depth;
        before = spent_by(one, subject);
    }
}

TEST(FrontRivals, ByDistanceIsWhatItsDistancesSay) {
    const ByDistance rule(cast(), {40, 80, 400});
    const auto points = [&](double depth) { return static_cast<double>(rule.points_of(somebody_at(depth))); };
    const auto demand = [&](double depth) { return static_cast<double>(somebody_at(depth).demand); };
    EXPECT_EQ(points(39), infinity);
    EXPECT_EQ(points(79), std::ceil(demand(79)));
    EXPECT_EQ(points(159), std::ceil(demand(159)));
    EXPECT_EQ(points(161), std::ceil(demand(161) / 2));
    EXPECT_EQ(points(321), std::ceil(demand(321) / 4));
    EXPECT_EQ(points(401), 0);
    EXPECT_TRUE(rule.is_splat(somebody_at(401)));
    EXPECT_FALSE(rule.is_splat(somebody_at(399)));
}

// Cells of a pixel while points are close; and no larger than was asked for, however far apart they are.
TEST(FrontRivals, CellsFollowTheMeanSpacing) {
    EXPECT_EQ(settled<SmallestDemoted>(infinity).splat_size(), 1);
    const double coarse = settled<SmallestDemoted>(0).splat_size();
    EXPECT_EQ(coarse, 2.85);
    const std::vector<Subject> same(500, somebody_at(40));  // 2,500 px^2 each
    for (const double spacing : {1.9, 2.2, 3.0}) {
        const auto rule = settled<SmallestDemoted>(500 * 2500 / (spacing * spacing), same);
        const double points = spent_by(rule, same) / 500, of_rule = std::sqrt(2500 / points);
        EXPECT_NEAR(rule.splat_size(), of_rule > 2 ? std::min(2.85, 0.75 * of_rule / 0.8408964) : 1, 1e-4);
    }
}

// In a frame as it is drawn.
TEST(FrontRivals, TheBudgetHoldsInACrowd) {
    auto& venue = bench::front::small_venue();
    auto& shooter = venue.shooter(sfsm::Drawing::native);
    const auto shot = bench::front::shots(venue.stage().place.cameras, venue.size().height).at(1);
    shooter.survey(shot.view_now(venue.size().width, venue.size().height), shot.tick);
    const SmallestDemoted any(cast(), 0);
    const bench::front::Roll roll(any);
    const std::size_t alone = shooter.select(roll, shot.tick).people.size();
    EXPECT_EQ(roll.people().size(), alone);
    ASSERT_GT(alone, 100u);
    const double least = spent_by(settled<SmallestDemoted>(0, roll.people()), roll.people());
    const double most = spent_by(settled<SmallestDemoted>(infinity, roll.people()), roll.people());
    for (const double share : {0.1, 0.5, 0.9}) {
        const double budget = std::lerp(least, most, share);
        const auto rule = settled<SmallestDemoted>(budget, roll.people());
        const sfsm::Work& work = shooter.select(rule, shot.tick).work;
        double spent = spent_by(rule, roll.people());
        EXPECT_LE(spent, budget);
        EXPECT_GE(spent, budget - mesh_points());
        for (const Subject& subject : roll.people())
            if (!std::isfinite(rule.points_of(subject))) spent -= mesh_points();
        EXPECT_EQ(static_cast<double>(work[sfsm::WorkKind::point]), spent);
    }
}

}  // namespace
