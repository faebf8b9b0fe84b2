// Whole frames of the stadium, chosen by the selector and drawn by the renderer: who is where, how old their motion is,
// by how many points they are drawn, and what stands around them.
#include <memory>
#include <string>

#include "tests/reference/stadium.h"
#include "tests/render/drawn_points.h"
#include "tests/render/gl_test.h"

namespace {

using reference::Comparison;
using sfsm::Decision;
using sfsm::State;

constexpr const char* presets[] = {"still", "close", "medium", "remote"};

class StadiumPicture : public tests::GlTest {
protected:
    static constexpr std::int64_t tick = 1234;

    void SetUp() override {
        tests::GlTest::SetUp();
        if (IsSkipped()) return;
        draw_at(320, 180);
    }
    void draw_at(int width, int height) {
        static const tests::SmallScene scene(600);
        // The reference knows everybody by name.
        static const figures::Way one_by_one = tests::without_blocks(figures::by_opengl());
        stadium_ = std::make_unique<reference::Stadium>(scene, width, height, one_by_one);
    }
    void TearDown() override { stadium_.reset(); }

    void expect_alike(const scene::CameraPose& pose, const Decision& decision, const std::string& what) {
        const reference::Frame frame = stadium_->shoot(pose, decision, tick);
        const Comparison found = reference::compare(frame.drawn, frame.expected);
        // Slivers thinner than the places that the reference looks at are left.
        EXPECT_LE(found.wrong_plain, 1) << what << ": " << found.text();
        EXPECT_LE(found.wrong, found.pixels / 4000) << what << ": " << found.text();
        EXPECT_GT(found.plain, found.pixels / 12) << what << ": " << found.text();
    }

    std::unique_ptr<reference::Stadium> stadium_;
};

TEST_F(StadiumPicture, IsTheReferencesInEveryPreset) {
    for (const char* preset : presets) expect_alike(stadium_->preset(preset), {}, preset);
}

TEST_F(StadiumPicture, IsTheReferencesWhenSomeMoveLess) {
    for (const char* preset : presets)
        for (const double distance : {1.0, 30.0})
            expect_alike(stadium_->preset(preset), {State::slowed, distance, 0}, preset);
}

TEST_F(StadiumPicture, IsTheReferencesByPointsOfAnySize) {
    for (const char* preset : presets)
        for (const double size : {0.7, 1.0, 2.0, 3.4, 8.0, 20.0})
            expect_alike(stadium_->preset(preset), {State::points, 40, size},
                         std::string(preset) + ", S = " + std::to_string(size));
}

TEST_F(StadiumPicture, IsTheReferencesAllAlongTheTour) {
    for (double seconds = 2.5; seconds < 60; seconds += 6)
        expect_alike(stadium_->preset("roam", seconds), {}, "roam at " + std::to_string(seconds));
}

TEST_F(StadiumPicture, IsRightOnAverageWhereLinesAreFinerThanPixels) {
    const auto expect_right = [&](const scene::CameraPose& pose, const std::string& what) {
        constexpr int side = 20;            // [px] of the squares that are averaged
        constexpr double fading_error = 5;  // [of 255] lines beside each other in one pixel, corners
        const reference::Frame frame = stadium_->shoot(pose, {}, tick);
        EXPECT_LT(reference::worst_mean(frame.drawn, frame.expected, side), fading_error) << what;
    };
    expect_right(stadium_->preset("medium"), "medium");
    expect_right(stadium_->preset("remote"), "remote");
    for (const double seconds : {12.0, 20.0, 36.0})
        expect_right(stadium_->preset("roam", seconds), "roam at " + std::to_string(seconds));
    expect_right({{0, 40, 0}, {0, 0, 0}, glm::radians(60.0)}, "the pitch from above");
    expect_right({{44, 1.7, 40}, {20, 0, 36}, glm::radians(40.0)}, "along the lanes");
}

// Markings from a man's height, where they are pixels wide: marks, boxes, the finish, lanes and slabs.
TEST_F(StadiumPicture, IsTheReferencesWhereTheGroundIsNear) {
    draw_at(160, 90);
    const scene::Oval oval;
    const double track = oval.radius + 3.66, end = oval.half_straight;
    for (const glm::dvec2 spot : {glm::dvec2(41.5, 0),
                                  {-41.5, 0},
                                  {-52.5, -34},
                                  {47, 9.16},
                                  {36, -20.16},
                                  {end, track},
                                  {-end, track},
                                  {end, -track},
                                  {69.73, -27.53},
                                  {152, 104},
                                  {0, 0},
                                  {9.15, 0},
                                  {-32.4, 1},     // the arc, and where its ring would go on
                                  {-41.5, 9.15},  // within the penalty area
                                  {21, 30}}) {
        const glm::dvec3 eye(spot.x + 0.3, 1.8, spot.y + 0.4);
        expect_alike({eye, {spot.x, 0, spot.y}, glm::radians(25.0)}, {},
                     "the ground at " + std::to_string(spot.x) + ", " + std::to_string(spot.y));
    }
}

// Where athletes stand on it, their shade and all.
TEST_F(StadiumPicture, IsTheReferencesAroundFeet) {
    for (const scene::CameraPose& pose : stadium_->at_feet(tick)) {
        expect_alike(pose, {}, "feet at " + std::to_string(pose.target.x));
        const reference::Frame without = stadium_->shoot(pose, {}, tick, false);
        EXPECT_GT(reference::compare(without.drawn, without.expected).wrong, 200) << "nothing is shown";
    }
}

// Up to the sun, down to the ground, along it, and from a pixel's width of field to nearly all that is in front.
TEST_F(StadiumPicture, IsTheReferencesWhereverTheCameraLooks) {
    const glm::dvec3 pitch(3, 1.7, 9), above(-20, 120, 10);
    const auto looking = [](glm::dvec3 from, glm::dvec3 along, double degrees) {
        return scene::CameraPose{from, from + along, glm::radians(degrees)};
    };
    expect_alike(looking(pitch, {0.45, 0.72, 0.38}, 40), {}, "at the sun");
    expect_alike(looking(above, {0, -1, 0}, 60), {}, "straight down");
    expect_alike(looking(pitch, {0, 1, 0}, 60), {}, "straight up");
    expect_alike(looking(pitch, {1, -0.2, 0.3}, 20), {}, "along the pitch");
    expect_alike(looking(pitch, {0.2, 0.1, 1}, 140), {}, "wide");
    expect_alike(looking({-60, 300, 1500}, {0.04, -0.19, -1}, 4), {}, "from afar");
}

}  // namespace
