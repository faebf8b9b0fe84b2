// The tree of candidates against plain loops over all of them, in double.
#include "pointsample/farthest_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "pointsample/even.h"
#include "pointsample/farthest_order.h"
#include "pointsample/opening.h"
#include "tests/motion/tentacle.h"

namespace {

using pointsample::Candidates;
using pointsample::Place;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-5;  // relative: of a float's squares of differences

// Three levels of the tree, and a last leaf that is not full.
constexpr std::size_t many = 2500;

// In clumps, facing anywhere, stretched up to four times.
Candidates clumps(std::size_t count, std::uint64_t seed) {
    tests::Random random(seed);
    Candidates candidates;
    glm::vec3 middle;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 20 == 0) middle = random.vector(-0.4f, 0.4f);
        const Place place{middle + random.vector(-0.1f, 0.1f), random.rotation() * glm::vec3(0, 0, 1)};
        candidates.append(place, random(0, 1) < 0.5f ? 1.0f : random(1, 4), {static_cast<std::uint32_t>(i), 0, 0});
    }
    candidates.pad();
    return candidates;
}

// The rule itself: Euclid's, twice that where normals oppose.
double squared(const Place& a, const Place& b) {
    const glm::dvec3 apart = glm::dvec3(a.position) - glm::dvec3(b.position);
    const bool opposed = glm::dot(glm::dvec3(a.normal), glm::dvec3(b.normal)) < -0.7;
    return glm::dot(apart, apart) * (opposed ? 4 : 1);
}

// What the tree is to know, by looking at everything.
class Everything {
public:
    explicit Everything(const Candidates& candidates)
        : candidates_(candidates), is_point_(candidates.count), distances_(candidates.count, infinity) {}

    void choose(std::size_t i) {
        is_point_[i] = 1;
        chosen_.push_back(i);
        cover(candidates_.place(i));
    }
    void unchoose(std::size_t i) {
        is_point_[i] = 0;
        chosen_.erase(std::find(chosen_.begin(), chosen_.end(), i));
        distances_.assign(distances_.size(), infinity);
        for (const std::size_t point : chosen_) cover(candidates_.place(point));
    }
    void cover(const Place& place) {
        for (std::size_t i = 0; i < distances_.size(); ++i)
            distances_[i] = std::min(distances_[i], squared(candidates_.place(i), place));
    }

    bool is_point(std::size_t i) const { return is_point_[i] != 0; }
    const std::vector<std::size_t>& chosen() const { return chosen_; }

    double distance(std::size_t i) const { return distances_[i]; }
    double key(std::size_t i) const { return distance(i) * static_cast<double>(candidates_.stretch(i)); }

    double largest_key() const {
        double largest = 0;
        for (std::size_t i = 0; i < distances_.size(); ++i)
            if (!is_point(i)) largest = std::max(largest, key(i));
        return largest;
    }
    double farthest() const {
        double largest = -1;
        for (std::size_t i = 0; i < distances_.size(); ++i)
            if (!is_point(i)) largest = std::max(largest, distance(i));
        return largest;
    }
    // The key that a point would have, were it a candidate.
    double key_among_others(std::size_t i) const {
        double nearest = infinity;
        for (const std::size_t other : chosen_)
            if (other != i) nearest = std::min(nearest, squared(candidates_.place(i), candidates_.place(other)));
        return nearest * static_cast<double>(candidates_.stretch(i));
    }

private:
    const Candidates& candidates_;
    std::vector<char> is_point_;
    std::vector<double> distances_;
    std::vector<std::size_t> chosen_;
};

template <typename Tree>
void expect_alike(const Tree& tree, const Everything& all, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        if (all.is_point(i)) continue;
        const double key = all.key(i);
        ASSERT_NEAR(static_cast<double>(tree.key(i)), key, rounding * key) << i;
    }
    ASSERT_NEAR(static_cast<double>(tree.farthest()), all.farthest(), rounding * all.farthest());
}

TEST(FarthestTree, KnowsEveryKeyAsPointsComeAndGo) {
    Candidates candidates = clumps(many, 1);
    pointsample::FarthestTree<true> tree(candidates);
    Everything all(candidates);
    tests::Random random(2);
    const auto any = [&](std::size_t count) { return static_cast<std::size_t>(random(0, static_cast<float>(count))); };
    EXPECT_EQ(tree.farthest(), std::numeric_limits<float>::infinity());
    for (int step = 0; step < 400; ++step) {
        const bool few = step < 200;  // then the nearest of those left may be far away
        if (all.chosen().size() > (few ? 3 : 2) && random(0, 1) < (few ? 0.7f : 0.4f)) {
            const std::size_t gone = all.chosen()[any(all.chosen().size())];
            tree.unchoose(gone);
            all.unchoose(gone);
        } else {
            std::size_t next = tree.next();
            ASSERT_FALSE(all.is_point(next));
            if (!all.chosen().empty()) {
                ASSERT_GE(all.key(next), all.largest_key() * (1 - rounding));
            }
            if (random(0, 1) < 0.3f) next = any(many);
            if (all.is_point(next)) continue;
            tree.choose(next);
            all.choose(next);
        }
        if (few || step % 10 == 0) {
            ASSERT_NO_FATAL_FAILURE(expect_alike(tree, all, many)) << step;
        }
    }
}

// Far from all else, whose nearest others are many times farther than any candidate was from its own.
TEST(FarthestTree, TheOnlyPointOfAFarClumpCanGo) {
    Candidates near = clumps(900, 13), candidates;
    for (std::size_t i = 0; i < near.count; ++i) {
        Place place = near.place(i);
        place.position = 0.02f * place.position + glm::vec3(i < 300 ? 0 : i < 600 ? 3 : 30, 0, 0);
        candidates.append(place, near.stretch(i), near.surface[i]);
    }
    candidates.pad();
    pointsample::FarthestTree<true> tree(candidates);
    Everything all(candidates);
    for (const std::size_t point : {10u, 400u, 800u}) {
        tree.choose(point);
        all.choose(point);
    }
    for (const std::size_t point : {400u, 800u}) {
        tree.unchoose(point);
        all.unchoose(point);
        ASSERT_NO_FATAL_FAILURE(expect_alike(tree, all, candidates.count)) << point;
        EXPECT_GE(all.key(tree.next()), all.largest_key() * (1 - rounding));
    }
}

TEST(FarthestTree, APointIsCrowdedByOthersNearerThanItsStretchAllows) {
    Candidates candidates = clumps(many, 3);
    pointsample::FarthestTree<true> tree(candidates);
    Everything all(candidates);
    for (std::size_t i = 0; i < many; i += 5) {
        tree.choose(i);
        all.choose(i);
    }
    int stretched = 0;
    for (const std::size_t point : all.chosen()) {
        const double key = all.key_among_others(point);
        EXPECT_TRUE(tree.is_crowded(point, static_cast<float>(key * (1 + rounding)))) << point;
        EXPECT_FALSE(tree.is_crowded(point, static_cast<float>(key * (1 - rounding)))) << point;
        stretched += candidates.stretch(point) > 1.5f;
    }
    EXPECT_GT(stretched, 100);
}

TEST(FarthestTree, PlacesThatAreNoCandidatesCoverToo) {
    Candidates candidates = clumps(many, 4);
    pointsample::FarthestTree<false> tree(candidates);
    Everything all(candidates);
    tests::Random random(5);
    for (int i = 0; i < 60; ++i) {
        const Place place{random.vector(-0.5f, 0.5f), random.rotation() * glm::vec3(1, 0, 0)};
        tree.cover(place);
        all.cover(place);
        if (i % 6 == 0) {
            ASSERT_NO_FATAL_FAILURE(expect_alike(tree, all, many));
        }
    }
}

TEST(FarthestTree, GivesAwayAtMostTwoPercentALevelForEvenDensity) {
    Candidates candidates = clumps(many, 6);
    pointsample::FarthestTree<false> tree(candidates);
    Everything all(candidates);
    constexpr double two_levels = 0.98 * 0.98 / (1.02 * 1.02);
    constexpr std::size_t few = 15;  // below eight points due to the largest node of a thousand candidates
    std::size_t next = 0;
    for (std::size_t size = 1; size < 600; ++size) {
        tree.choose(next);
        all.choose(next);
        next = tree.next();
        ASSERT_FALSE(all.is_point(next));
        const double least = size < few ? 1 - rounding : two_levels - rounding;
        ASSERT_GE(all.key(next), all.largest_key() * least) << size << " points";
    }
}

TEST(FarthestTree, AllCandidatesComeOnce) {
    for (const std::size_t count : {1u, 15u, 16u, 17u, 128u, 129u, 1500u}) {
        Candidates candidates = clumps(count, 7);
        const std::uint32_t first = static_cast<std::uint32_t>(count / 2);
        const pointsample::FarthestOrder order = pointsample::farthest_order(candidates, count, {&first, 1}, {}, {});
        std::set<std::uint32_t> seen(order.candidates.begin(), order.candidates.end());
        EXPECT_EQ(seen.size(), count);
        EXPECT_LT(*seen.rbegin(), count);
        EXPECT_EQ(order.candidates.front(), first);
        pointsample::FarthestTree<true> tree(candidates);
        for (std::size_t i = 0; i < count; ++i) tree.choose(i);
        EXPECT_LT(tree.farthest(), 0);  // nobody is left, though the last leaf is filled up
    }
}

TEST(FarthestOrder, TellsSpacingAndRadiusOfEveryPrefix) {
    Candidates candidates = clumps(many, 8);
    const std::vector<std::uint32_t> first{7, 1200}, marks{1, 2, 3, 16, 100, 300};
    const pointsample::FarthestOrder order = pointsample::farthest_order(candidates, 300, first, marks);
    Everything all(candidates);
    double spacing = infinity;
    std::size_t mark = 0;
    for (std::size_t i = 0; i < order.candidates.size(); ++i) {
        spacing = std::min(spacing, std::sqrt(all.key(order.candidates[i])));
        if (i > 0) {
            ASSERT_NEAR(static_cast<double>(order.spacing[i]), spacing, rounding * spacing) << i;
        }
        all.choose(order.candidates[i]);
        if (i + 1 != marks[mark]) continue;
        EXPECT_NEAR(static_cast<double>(order.radius[mark]), std::sqrt(all.farthest()), rounding) << i;
        ++mark;
    }
    EXPECT_EQ(order.spacing[0], std::numeric_limits<float>::infinity());
    EXPECT_EQ(order.candidates[1], first[1]);
    EXPECT_EQ(mark, marks.size());
}

TEST(MakeEven, RaisesTheLeastKeyOverAStretchedSurface) {
    Candidates candidates = clumps(6000, 9);
    constexpr std::size_t count = 250;
    const std::uint32_t first = 0;
    std::vector<std::uint32_t> points = pointsample::farthest_order(candidates, count, {&first, 1}, {}, {}).candidates;
    const auto least_distance = [&] {
        Everything all(candidates);
        for (const std::uint32_t point : points) all.choose(point);
        double least = infinity;
        for (const std::uint32_t point : points) least = std::min(least, all.key_among_others(point));
        return std::sqrt(least);
    };
    const double before = least_distance();
    const auto wanted = static_cast<float>(1.08 * before);
    points = pointsample::make_even(candidates, points, wanted);
    EXPECT_EQ(std::set<std::uint32_t>(points.begin(), points.end()).size(), count);
    EXPECT_GE(least_distance(), static_cast<double>(wanted) * (1 - rounding));
}

TEST(Opening, KeepsItsPointsApartByTheirStretch) {
    const Candidates candidates = clumps(3000, 10);
    for (const float apart : {0.05f, 0.2f, 0.4f}) {
        const std::vector<std::uint32_t> points = pointsample::opening(candidates, 16, apart, 1);
        ASSERT_GE(points.size(), 1u);
        // A point's key is its own, among those before it.
        for (std::size_t i = 1; i < points.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                EXPECT_GE(std::sqrt(squared(candidates.place(points[i]), candidates.place(points[k])) *
                                    static_cast<double>(candidates.stretch(points[i]))),
                          static_cast<double>(apart) * (1 - rounding));
    }
    EXPECT_EQ(pointsample::opening(candidates, 16, 0, 1).size(), 16u);
    EXPECT_EQ(pointsample::opening(candidates, 16, 100, 1).size(), 1u);
}

double mean_distance(const Candidates& candidates, const std::vector<std::uint32_t>& points) {
    Everything all(candidates);
    for (const std::uint32_t point : points) all.choose(point);
    double sum = 0;
    for (std::size_t i = 0; i < candidates.count; ++i) sum += all.distance(i);
    return sum / static_cast<double>(candidates.count);
}

// Greedy over all candidates, not over 512 of them.
TEST(Opening, StandsForTheSurfaceNearlyAsWellAsTheBestOfAllCandidates) {
    const Candidates candidates = clumps(1500, 11);
    std::vector<std::uint32_t> best;
    for (int size = 1; size <= 4; ++size) {
        std::pair<double, std::uint32_t> least{infinity, 0};
        for (std::uint32_t i = 0; i < candidates.count; i += 3) {
            std::vector<std::uint32_t> with = best;
            with.push_back(i);
            least = std::min(least, {mean_distance(candidates, with), i});
        }
        best.push_back(least.second);
    }
    for (const std::uint64_t seed : {1u, 2u, 3u})
        EXPECT_LT(mean_distance(candidates, pointsample::opening(candidates, 4, 0, seed)),
                  1.1 * mean_distance(candidates, best));
}

// Of up to 512 candidates all are looked at.
TEST(Opening, TakesWhatLowersTheMeanDistanceMostAndIsFarEnoughByItsStretch) {
    const Candidates candidates = clumps(400, 14);
    for (const float apart : {0.0f, 0.3f, 0.5f}) {
        std::vector<std::uint32_t> best;
        Everything all(candidates);
        while (best.size() < 16) {
            std::pair<double, std::uint32_t> least{infinity, 0};
            for (std::uint32_t i = 0; i < candidates.count; ++i) {
                if (all.is_point(i) || all.key(i) < static_cast<double>(apart * apart)) continue;
                double sum = 0;
                for (std::size_t k = 0; k < candidates.count; ++k)
                    sum += std::min(all.distance(k), squared(candidates.place(i), candidates.place(k)));
                least = std::min(least, {sum, i});
            }
            if (least.first == infinity) break;
            best.push_back(least.second);
            all.choose(least.second);
        }
        EXPECT_EQ(pointsample::opening(candidates, 16, apart, 5), best) << apart;
    }
}

TEST(Candidates, StayInOrderWhenSomeAreDropped) {
    Candidates candidates = clumps(100, 12);
    const Candidates before = candidates;
    std::vector<char> kept(70);
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < 100; ++i) {
        if (i >= 30) kept[i - 30] = i % 3 == 0;
        if (i < 30 || i % 3 == 0) left.push_back(i);
    }
    candidates.keep(30, kept);
    candidates.pad();
    ASSERT_EQ(candidates.count, left.size());
    for (std::size_t i = 0; i < candidates.leaves.size() * pointsample::leaf_size; ++i) {
        const std::size_t from = left[std::min(i, left.size() - 1)];  // the last is repeated
        EXPECT_EQ(candidates.place(i).position, before.place(from).position) << i;
        EXPECT_EQ(candidates.place(i).normal, before.place(from).normal);
        EXPECT_EQ(candidates.stretch(i), before.stretch(from));
        EXPECT_EQ(candidates.surface[i].triangle, from);
    }
}

}  // namespace
