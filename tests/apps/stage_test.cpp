// A stage of several characters: what is known of each belongs together.
#include "apps/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "tests/command.h"

namespace {

constexpr std::int64_t people = 300;

// A tower of `floors` boxes one above the other, in an OBJ file.
std::string tower(const tests::Directory& directory, int floors) {
    const std::string path = directory / ("tower" + std::to_string(floors) + ".obj");
    std::ofstream file(path);
    for (int floor = 0; floor < floors; ++floor) {
        for (int corner = 0; corner < 8; ++corner)
            file << "v " << (corner & 1) << ' ' << floor + 0.9 * (corner >> 1 & 1) << ' ' << (corner >> 2) << '\n';
        for (const auto& [a, b, c, d] :
             {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5}, {3, 7, 8, 4}})
            file << "f " << a + 8 * floor << ' ' << b + 8 * floor << ' ' << c + 8 * floor << ' ' << d + 8 * floor
                 << '\n';
    }
    return path;
}

void expect_belongs_together(const apps::Stage& stage) {
    const std::vector<figures::Figure> figures = stage.figures();
    ASSERT_EQ(figures.size(), stage.meshes.size());
    for (std::size_t i = 0; i < figures.size(); ++i) {
        EXPECT_EQ(figures[i].poses, &stage.poses[i]);
        EXPECT_EQ(figures[i].mesh, &stage.meshes[i]);
        EXPECT_EQ(figures[i].points, &stage.points[i]);
        EXPECT_EQ(static_cast<std::size_t>(stage.poses[i].vertex_count), stage.meshes[i].vertex_count());
        EXPECT_EQ(static_cast<std::size_t>(stage.poses[i].point_count), stage.points[i].size());
        EXPECT_TRUE(std::ranges::count(stage.place.crowd.character, i) > 0) << "nobody is " << i;
    }
    EXPECT_EQ(stage.place.crowd.size(), static_cast<std::size_t>(people));
}

TEST(Stage, KnowsEachOfItsCharacters) {
    const tests::Directory directory;
    const auto stage = apps::build_stage({{tower(directory, 1)}, {tower(directory, 20)}, {tower(directory, 3)}}, people,
                                         1, apps::PointCache(""), figures::by_opengl());
    ASSERT_EQ(stage->meshes.size(), 3u);
    EXPECT_EQ(stage->meshes[1].triangle_count(), 240u);
    expect_belongs_together(*stage);
    // A point to two triangles, as many as are ever drawn, but enough for who is far.
    EXPECT_EQ(stage->points[0].size(), 64u);
    EXPECT_EQ(stage->points[1].size(), 120u);
}

TEST(Stage, HasMorePointsWhereTheyCostLess) {
    const tests::Directory directory;
    const auto stage =
        apps::build_stage({{tower(directory, 20)}}, people, 1, apps::PointCache(""), figures::natively());
    EXPECT_EQ(stage->points[0].size(), figures::points_worth(240, figures::natively()));
    EXPECT_GT(stage->points[0].size(), 240u);
}

TEST(Stage, HasTheBuiltInPersonWhereNoFileIsNamed) {
    const auto stage = apps::build_stage({}, people, 1, apps::PointCache(""), figures::by_opengl());
    ASSERT_EQ(stage->meshes.size(), 1u);
    expect_belongs_together(*stage);
    EXPECT_TRUE(stage->cast[0].sits);
    EXPECT_GT(stage->place.structure.indices.size(), 0u);
}

}  // namespace
