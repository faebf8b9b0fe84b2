// How much light from around reaches a piece of a section, against what can be said in closed form.
#include "scene/openness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using scene::openness;
using scene::SectionLine;

constexpr float far = 1e5f;                      // [m] so far that nearness takes nothing
constexpr float cover = 0.3f;                    // what hides the sky sends so much of its light
constexpr float step = 1.0f / 24;                // directions are so far apart
const glm::vec2 here(-0.1f, 0), there(0.1f, 0);  // a floor, seen from above

// A line that hides the sky from the floor, straight up to so far [rad] outward.
SectionLine lid(float angle, float stops = 1) {
    return {{0, far}, {far * std::tan(angle), far}, stops};
}

TEST(Openness, OfWhatNothingHidesIsWhole) {
    const std::vector<SectionLine> floor{{{-far, 0}, {far, 0}}};
    EXPECT_FLOAT_EQ(openness(here, there, {}), 1);
    EXPECT_FLOAT_EQ(openness(here, there, floor), 1) << "it hides itself";
}

TEST(Openness, LosesHalfTheSineOfTheAngleThatIsHidden) {
    for (const float angle : {0.2f, 0.7f, 1.2f}) {
        const std::vector<SectionLine> lines{lid(angle)};
        EXPECT_NEAR(openness(here, there, lines), 1 - (1 - cover) * std::sin(angle) / 2, step / 2) << angle;
    }
}

TEST(Openness, LosesLessToWhatStopsLessAndAsMuchInAnyOrder) {
    const std::vector<SectionLine> whole{lid(1)}, half{lid(1, 0.5f)}, twice{lid(1, 0.5f), lid(0.5f, 0.5f)},
        twice_the_other_way{lid(0.5f, 0.5f), lid(1, 0.5f)};
    EXPECT_NEAR(1 - openness(here, there, half), (1 - openness(here, there, whole)) / 2, 1e-5);
    EXPECT_LT(openness(here, there, twice), openness(here, there, half));
    EXPECT_GT(openness(here, there, twice), openness(here, there, whole));
    EXPECT_FLOAT_EQ(openness(here, there, twice), openness(here, there, twice_the_other_way));
}

TEST(Openness, IsLessTheNearerItsCoverIs) {
    float last = 0;
    for (const float height : {0.05f, 0.2f, 1.0f, 5.0f, 100.0f}) {
        const std::vector<SectionLine> lines{{{-1000 * height, height}, {1000 * height, height}}};
        const float open = openness(here, there, lines);
        EXPECT_GT(open, last) << height;
        last = open;
    }
    EXPECT_NEAR(last, cover, 0.01);
}

// What lies below a wall is what lights it from below; only near it does it take light from it.
TEST(Openness, OfAWallIsLostAtItsFootAlone) {
    const std::vector<SectionLine> floor{{{-far, 0}, {far, 0}}};
    const float foot = openness({0, 0}, {0, 0.1f}, floor), top = openness({0, 20}, {0, 21}, floor);
    EXPECT_GT(top, 0.97f);
    EXPECT_LT(foot, top - 0.1f);
    // The side to the left of the way is meant: a wall beside it hides one side alone.
    const std::vector<SectionLine> beside{{{-1, -far}, {-1, far}}};
    EXPECT_LT(openness({0, 0}, {0, 1}, beside), 0.5f);
    EXPECT_FLOAT_EQ(openness({0, 1}, {0, 0}, beside), 1);
}

}  // namespace
