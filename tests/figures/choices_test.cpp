// The choice among levels, held against trying all of them.
#include "figures/choices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "figures/splats.h"
#include "tests/figures/counted_character.h"

namespace {

using figures::Choices;
using figures::Level;
using Character = tests::CountedFigure;

double cost_of(const sfsm::Work& work, const figures::Way& way) {
    double cost = 0;
    for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind)
        cost += way.pieces[kind] * static_cast<double>(work.counts[kind]);
    return cost;
}

figures::Way at_price(double of_a_point) {
    figures::Way way = figures::by_opengl();
    way.pieces[sfsm::index_of(sfsm::WorkKind::point)] = of_a_point;
    return way;
}

const figures::Way* const ways[] = {&figures::by_opengl(), &figures::natively()};

TEST(Choices, AreTheCheapestThatServe) {
    for (const auto& [triangles, points] : {std::pair{1300, 650}, {12, 6}, {4, 64}, {1, 0}, {20000, 300}}) {
        const Character character(static_cast<std::size_t>(triangles), points);
        for (const double price : {0.5, 1.0, 2.0, 7.0}) {
            const figures::Way way = at_price(price);
            const Choices choices(character.figure(), way);
            for (float demand = 0.01f; demand < 1e6f; demand *= 1.07f) {
                double least = std::numeric_limits<double>::infinity();
                for (const figures::Representation& representation : way.representations)
                    for (const Level& level : representation.levels(character.figure()))
                        if (demand <= level.reach && !representation.is_by_block)
                            least = std::min(least, cost_of(level.work, way));
                const Level& chosen = choices.all()[choices.at(demand)].level;
                EXPECT_GE(chosen.reach, demand);
                EXPECT_EQ(cost_of(chosen.work, way), least) << triangles << " triangles, demand " << demand;
            }
        }
    }
}

TEST(Choices, ServeExactlyAsMuchAsTheyReach) {
    const Character character(5000, 2500);
    const Choices choices(character.figure(), figures::by_opengl());
    for (std::uint32_t i = 0; i < choices.all().size(); ++i) {
        const float reach = choices.all()[i].level.reach;
        const bool is_by_block = figures::by_opengl().representations[choices.all()[i].representation].is_by_block;
        EXPECT_EQ(is_by_block ? choices.in_block_at(reach) : choices.at(reach), i) << "reach " << reach;
        if (!std::isinf(reach)) {
            EXPECT_NE(choices.in_block_at(std::nextafter(reach, 2 * reach)), i) << "reach " << reach;
        }
    }
}

TEST(Choices, OfEqualCostAreTheLaterRepresentations) {
    const Character character(64, 64);  // 32 points cost what the triangles do
    const Choices choices(character.figure(), at_price(2));
    EXPECT_EQ(choices.all()[choices.at(30)].level.count, 32u);
    EXPECT_TRUE(figures::by_opengl().representations[choices.all()[choices.at(33)].representation].is_mesh);
}

TEST(Choices, ServeAnyDemandByTheArtistsOwnShape) {
    const Character character(100, 64);
    const Choices choices(character.figure(), figures::by_opengl());
    for (const float demand : {1e9f, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(choices.at(demand), choices.exact());
    const figures::Choice& exact = choices.all()[choices.exact()];
    EXPECT_TRUE(figures::by_opengl().representations[exact.representation].is_mesh);
    EXPECT_EQ(exact.level.count, 300u);
}

TEST(Choices, AreInDrawingOrderAndEachIsOfUse) {
    const Character character(5000, 2500);
    const Choices choices(character.figure(), figures::by_opengl());
    std::set<std::uint32_t> used;
    for (float demand = 0.5f; demand < 1e5f; demand *= 1.01f) {
        used.insert(choices.at(demand));
        used.insert(choices.in_block_at(demand));
    }
    EXPECT_EQ(used.size(), choices.all().size());
    for (std::size_t i = 1; i < choices.all().size(); ++i)
        EXPECT_LE(choices.all()[i - 1].representation, choices.all()[i].representation);
}

TEST(Choices, OfBlocksAreSplatsWhereOneServes) {
    const Character character(5000, 2500);
    for (const figures::Way* way : ways) {
        const Choices choices(character.figure(), *way);
        EXPECT_EQ(choices.block_reach(), figures::splat_reach);
        const auto is_by_block = [&](std::uint32_t choice) {
            return way->representations[choices.all()[choice].representation].is_by_block;
        };
        for (float demand = 0.01f; demand < 1e5f; demand *= 1.07f) {
            EXPECT_FALSE(is_by_block(choices.at(demand))) << "nobody alone is";
            EXPECT_EQ(is_by_block(choices.in_block_at(demand)), demand <= figures::splat_reach) << demand;
        }
        const Choices without(Character(5000, 0).figure(), *way);
        EXPECT_EQ(without.in_block_at(0.1f), without.at(0.1f)) << "who has no points has no splat";
    }
}

// By rate it is asked for samples: none of them is a mesh, and a mesh only where there is nothing else.
TEST(Choices, OfSamplesAreTheCheapestPointsThatHaveAsMany) {
    for (const figures::Way* way : ways) {
        for (const auto& [triangles, points] : {std::pair{1300, 650}, {12, 64}, {50'000, 4096}, {1300, 0}}) {
            const Character character(static_cast<std::size_t>(triangles), points);
            const Choices choices(character.figure(), *way);
            const double as_mesh = cost_of(choices.all()[choices.exact()].level.work, *way);
            float most = 0;
            for (const figures::Representation& representation : way->representations)
                for (const Level& level : representation.levels(character.figure()))
                    if (!representation.is_mesh && !representation.is_by_block && cost_of(level.work, *way) <= as_mesh)
                        most = std::max(most, level.reach);
            EXPECT_EQ(choices.most_samples(), most) << triangles << " triangles, " << points << " points";
            for (float samples = 0.1f; samples < 1e5f; samples *= 1.07f) {
                const figures::Choice& chosen = choices.all()[choices.samples_at(samples)];
                EXPECT_EQ(way->representations[chosen.representation].is_mesh, most == 0);
                if (most == 0) continue;
                EXPECT_GE(chosen.level.reach, std::min(samples, most));
                for (const figures::Representation& representation : way->representations)
                    for (const Level& level : representation.levels(character.figure()))
                        if (!representation.is_mesh && !representation.is_by_block &&
                            level.reach >= std::min(samples, most)) {
                            EXPECT_LE(cost_of(chosen.level.work, *way), cost_of(level.work, *way)) << samples;
                        }
            }
        }
    }
}

TEST(Choices, OfABlockIsASplatIfItCanBe) {
    for (const figures::Way* way : ways)
        for (const int points : {0, 64}) {
            const Choices choices(Character(1300, points).figure(), *way);
            const std::uint32_t chosen = choices.in_block_at(1.0f);
            EXPECT_EQ(way->representations[choices.all()[chosen].representation].is_by_block, points > 0);
            if (points == 0) {
                EXPECT_EQ(chosen, choices.exact());
            }
        }
}

TEST(Representations, LevelsRiseInReachAndInWork) {
    const Character character(5000, 2500);
    for (const figures::Way* way : ways) {
        bool some_exact = false;
        for (const figures::Representation& representation : way->representations) {
            const std::vector<Level> levels = representation.levels(character.figure());
            ASSERT_FALSE(levels.empty()) << sfsm::name_of(way->drawing) << ' ' << representation.name;
            for (std::size_t i = 1; i < levels.size(); ++i) {
                EXPECT_GT(levels[i].reach, levels[i - 1].reach)
                    << sfsm::name_of(way->drawing) << ' ' << representation.name;
                EXPECT_GT(cost_of(levels[i].work, *way), cost_of(levels[i - 1].work, *way));
            }
            some_exact |= std::isinf(levels.back().reach);
        }
        EXPECT_TRUE(some_exact) << sfsm::name_of(way->drawing) << ": somebody may come as near as they like";
    }
}

TEST(Representations, LoseNoLessAsSGrowsAndNeverMoreThanHalfAPerson) {
    for (const figures::Way* way : ways) {
        for (const figures::Representation& representation : way->representations) {
            for (const double silhouette : {0.2, 0.5, 4.0, 60.0}) {
                double before = 0;
                for (double size = 0; size <= 32; size += 0.25) {
                    const double loss = representation.outline_px(size, silhouette);
                    EXPECT_GE(loss, before) << sfsm::name_of(way->drawing) << ' ' << representation.name;
                    EXPECT_LE(loss, silhouette / 2) << sfsm::name_of(way->drawing) << ' ' << representation.name;
                    before = loss;
                }
                if (representation.is_mesh) {
                    EXPECT_EQ(representation.outline_px(0, silhouette), 0)
                        << sfsm::name_of(way->drawing) << ' ' << representation.name;
                }
            }
        }
    }
}

// Natively any number of points is drawn.

// The points that a demand gets, the last in part; infinite for triangles.
double samples_at(const Choices& choices, float demand) {
    const figures::Choice& choice = choices.all()[choices.at(demand)];
    if (figures::natively().representations[choice.representation].is_mesh)
        return std::numeric_limits<double>::infinity();
    const figures::Part part = figures::part_of(choice.level, demand);
    return part.count - 1.0 + static_cast<double>(part.last_share);
}

TEST(Part, OfPointsByOnesIsAsManyAsAreAskedFor) {
    const Character character(5000, 2500);
    for (const Level& level : figures::natively().representations[1].levels(character.figure())) {
        for (float demand = 0.01f; demand < 4000; demand *= 1.03f) {
            const figures::Part part = figures::part_of(level, demand);
            const float asked = std::clamp(demand, 4.0f, static_cast<float>(level.count));
            EXPECT_FLOAT_EQ(static_cast<float>(part.count - 1) + part.last_share, asked);
            EXPECT_GT(part.last_share, 0);
            EXPECT_LE(part.last_share, 1);
            EXPECT_LE(part.count, level.count);
            sfsm::Work work;
            work[sfsm::WorkKind::point] = part.count;
            work[sfsm::WorkKind::single] = 1;
            EXPECT_EQ(part.work, work) << "demand " << demand;
        }
    }
}

TEST(Part, OfAnyOtherLevelIsAllOfIt) {
    const Character character(5000, 2500);
    for (const figures::Representation& representation : figures::by_opengl().representations) {
        for (const Level& level : representation.levels(character.figure())) {
            for (const float demand : {0.0f, 0.3f, 5.5f, 1e6f}) {
                const figures::Part part = figures::part_of(level, demand);
                EXPECT_EQ(part.count, level.count) << representation.name;
                EXPECT_EQ(part.last_share, 1) << representation.name;
                EXPECT_EQ(part.work, level.work) << representation.name;
            }
        }
    }
}

TEST(Part, GrowsWithDemandUpToTheWholeModelAndThenToTriangles) {
    for (const int points : {4, 7, 64, 100, 2500}) {
        const Character character(20000, points);
        const Choices choices(character.figure(), figures::natively());
        double before = 0;
        for (float demand = 0.01f; demand < 1e5f; demand *= 1.005f) {
            const double samples = samples_at(choices, demand);
            EXPECT_GE(samples, before) << points << " points, demand " << demand;
            before = samples;
        }
        EXPECT_EQ(samples_at(choices, static_cast<float>(points)), points);
        EXPECT_TRUE(std::isinf(before));
    }
}

// Where few points cost as much as few triangles, too.
TEST(Part, IsNeverDearerThanTriangles) {
    for (const std::size_t triangles : {1u, 12u, 100u, 1300u}) {
        const Character character(triangles, 4096);
        const Choices choices(character.figure(), figures::natively());
        const double price = cost_of(choices.all()[choices.exact()].level.work, figures::natively());
        for (float demand = 0.01f; demand < 1e5f; demand *= 1.05f) {
            const Level& level = choices.all()[choices.at(demand)].level;
            EXPECT_LE(cost_of(figures::part_of(level, demand).work, figures::natively()), price) << triangles;
        }
    }
}

}  // namespace
