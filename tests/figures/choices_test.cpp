// The choice among levels, held against trying all of them.
#include "figures/choices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace {

using figures::Choices;
using figures::Level;

// A character of so many triangles and points; nobody looks at where they are.
struct Character {
    model::Mesh mesh;
    motion::PoseTable poses;

    Character(std::size_t triangles, int points) {
        mesh.indices.resize(3 * triangles);
        poses.point_count = points;
    }
    figures::Figure figure() const { return {&mesh, &poses, nullptr}; }
};

using Pieces = std::array<double, sfsm::work_kinds>;

double cost_of(const Level& level, const Pieces& pieces) {
    double cost = 0;
    for (std::size_t kind = 0; kind < pieces.size(); ++kind)
        cost += pieces[kind] * static_cast<double>(level.work.counts[kind]);
    return cost;
}

Pieces at_price(double of_a_point) {
    Pieces pieces = figures::believed_pieces;
    pieces[sfsm::index_of(sfsm::WorkKind::point)] = of_a_point;
    return pieces;
}

TEST(Choices, AreTheCheapestThatServe) {
    for (const auto& [triangles, points] : {std::pair{1300, 650}, {12, 6}, {4, 64}, {1, 0}, {20000, 300}}) {
        const Character character(static_cast<std::size_t>(triangles), points);
        for (const double price : {0.5, 1.0, 2.0, 7.0}) {
            const Pieces pieces = at_price(price);
            const Choices choices(character.figure(), pieces);
            for (float demand = 0.01f; demand < 1e6f; demand *= 1.07f) {
                double least = std::numeric_limits<double>::infinity();
                for (const figures::Representation& representation : figures::representations())
                    for (const Level& level : representation.levels(character.figure()))
                        if (demand <= level.reach) least = std::min(least, cost_of(level, pieces));
                const Level& chosen = choices.all()[choices.at(demand)].level;
                EXPECT_GE(chosen.reach, demand);
                EXPECT_EQ(cost_of(chosen, pieces), least) << triangles << " triangles, demand " << demand;
            }
        }
    }
}

TEST(Choices, ServeExactlyAsMuchAsTheyReach) {
    const Character character(5000, 2500);
    const Choices choices(character.figure(), figures::believed_pieces);
    for (std::uint32_t i = 0; i < choices.all().size(); ++i) {
        const float reach = choices.all()[i].level.reach;
        EXPECT_EQ(choices.at(reach), i) << "reach " << reach;
        if (!std::isinf(reach)) {
            EXPECT_NE(choices.at(std::nextafter(reach, 2 * reach)), i) << "reach " << reach;
        }
    }
}

TEST(Choices, OfEqualCostAreTheLaterRepresentations) {
    const Character character(64, 64);  // 32 points cost what the triangles do
    const Choices choices(character.figure(), at_price(2));
    EXPECT_EQ(choices.all()[choices.at(30)].level.count, 32u);
    EXPECT_TRUE(figures::representations()[choices.all()[choices.at(33)].representation].is_mesh);
}

TEST(Choices, ServeAnyDemandByTheArtistsOwnShape) {
    const Character character(100, 64);
    const Choices choices(character.figure(), figures::believed_pieces);
    for (const float demand : {1e9f, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(choices.at(demand), choices.exact());
    const figures::Choice& exact = choices.all()[choices.exact()];
    EXPECT_TRUE(figures::representations()[exact.representation].is_mesh);
    EXPECT_EQ(exact.level.count, 300u);
}

TEST(Choices, AreInDrawingOrderAndEachIsOfUse) {
    const Character character(5000, 2500);
    const Choices choices(character.figure(), figures::believed_pieces);
    std::set<std::uint32_t> used;
    for (float demand = 0.5f; demand < 1e5f; demand *= 1.01f) used.insert(choices.at(demand));
    EXPECT_EQ(used.size(), choices.all().size());
    for (std::size_t i = 1; i < choices.all().size(); ++i)
        EXPECT_LE(choices.all()[i - 1].representation, choices.all()[i].representation);
}

TEST(Representations, LevelsRiseInReachAndInWork) {
    const Character character(5000, 2500);
    bool some_exact = false;
    for (const figures::Representation& representation : figures::representations()) {
        const std::vector<Level> levels = representation.levels(character.figure());
        ASSERT_FALSE(levels.empty()) << representation.name;
        for (std::size_t i = 1; i < levels.size(); ++i) {
            EXPECT_GT(levels[i].reach, levels[i - 1].reach) << representation.name;
            EXPECT_GT(cost_of(levels[i], figures::believed_pieces), cost_of(levels[i - 1], figures::believed_pieces));
        }
        some_exact |= std::isinf(levels.back().reach);
    }
    EXPECT_TRUE(some_exact) << "somebody may come as near as they like";
}

TEST(Representations, LoseNoLessAsSGrowsAndNeverMoreThanHalfAPerson) {
    for (const figures::Representation& representation : figures::representations()) {
        for (const double silhouette : {0.5, 4.0, 60.0}) {
            double before = 0;
            for (double size = 0; size <= 32; size += 0.25) {
                const double loss = representation.outline_px(size, silhouette);
                EXPECT_GE(loss, before) << representation.name;
                EXPECT_LE(loss, silhouette / 2) << representation.name;
                before = loss;
            }
            if (representation.is_mesh) {
                EXPECT_EQ(representation.outline_px(0, silhouette), 0) << representation.name;
            }
        }
    }
}

}  // namespace
