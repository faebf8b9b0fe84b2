// A camera flown by its user: each key and each way to drag moves what is seen the way its user means.
#include "apps/free_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace apps {
namespace {

constexpr double rounding = 1e-9;
const glm::dvec3 up{0, 1, 0};

// Half a kilometre from everything, looking level in that direction [rad from +z towards +x].
FreeCamera at(double heading, double height = 50) {
    const glm::dvec3 position{20, height, -30};
    return FreeCamera({position, position + glm::dvec3(std::sin(heading), 0, std::cos(heading)), 0.9});
}

glm::dvec3 look(const FreeCamera& camera) {
    return glm::normalize(camera.pose().target - camera.pose().position);
}

// How far it goes in a second.
glm::dvec3 moved(FreeCamera camera, const render::Input& input, double seconds = 1) {
    const glm::dvec3 before = camera.pose().position;
    camera.move(input, seconds);
    return camera.pose().position - before;
}

FreeCamera dragged(FreeCamera camera, double right, double down) {
    render::Input input;
    input.look_x = right;
    input.look_y = down;
    camera.move(input, 0);
    return camera;
}

// Held keys, each in [-1, 1].
render::Input held(float forward, float right, float up_or_down, bool hurry = false) {
    render::Input input;
    input.forward = forward;
    input.right = right;
    input.up = up_or_down;
    input.hurry = hurry;
    return input;
}

const double headings[] = {0, 0.7, 1.6, 2.5, 3.1, -0.4, -1.6, -3};

TEST(FreeCamera, BeginsWithTheViewItIsGiven) {
    const scene::CameraPose start{{3, 20, -7}, {40, 2, 90}, 0.7};
    const scene::CameraPose pose = FreeCamera(start).pose();
    EXPECT_EQ(pose.position, start.position);
    EXPECT_EQ(pose.fov_y, start.fov_y);
    EXPECT_LT(glm::distance(glm::normalize(pose.target - pose.position), glm::normalize(start.target - start.position)),
              rounding);
}

TEST(FreeCamera, KeysMoveItTheirWay) {
    for (const double heading : headings) {
        const FreeCamera camera = at(heading);
        const glm::dvec3 forward = look(camera), right = glm::cross(forward, up);
        EXPECT_LT(glm::distance(moved(camera, held(1, 0, 0)), 8.0 * forward), rounding) << heading;
        EXPECT_LT(glm::distance(moved(camera, held(-1, 0, 0)), -8.0 * forward), rounding) << heading;
        EXPECT_LT(glm::distance(moved(camera, held(0, 1, 0)), 8.0 * right), rounding) << heading;
        EXPECT_LT(glm::distance(moved(camera, held(0, -1, 0)), -8.0 * right), rounding) << heading;
        EXPECT_LT(glm::distance(moved(camera, held(0, 0, 1)), 8.0 * up), rounding) << heading;
        EXPECT_LT(glm::distance(moved(camera, held(0, 0, -1)), -8.0 * up), rounding) << heading;
    }
}

TEST(FreeCamera, GoesAsFarAsTheTimeAndFiveTimesThatInAHurry) {
    const FreeCamera camera = at(0.3);
    const render::Input walk = held(1, 0, 0), hurry = held(1, 0, 0, true);
    EXPECT_NEAR(glm::length(moved(camera, walk, 0.25)), 2, rounding);
    EXPECT_NEAR(glm::length(moved(camera, hurry, 0.25)), 10, rounding);
    EXPECT_EQ(glm::length(moved(camera, hurry, 0)), 0);
    EXPECT_NEAR(glm::length(moved(camera, held(0.5f, 0, 0))), 4, rounding);
}

TEST(FreeCamera, FliesWhereItLooks) {
    const FreeCamera camera = dragged(at(0.7), 0, -150);
    const glm::dvec3 step = moved(camera, held(1, 0, 0));
    EXPECT_GT(step.y, 1);
    EXPECT_LT(glm::distance(step, 8.0 * look(camera)), rounding);
    EXPECT_NEAR(moved(camera, held(0, 1, 0)).y, 0, rounding) << "sideways is level";
}

TEST(FreeCamera, DraggingTurnsTowardsWhereTheMouseGoes) {
    for (const double heading : headings) {
        const FreeCamera camera = at(heading);
        const glm::dvec3 right = glm::cross(look(camera), up);
        EXPECT_GT(glm::dot(look(dragged(camera, 10, 0)), right), 0) << heading;
        EXPECT_LT(glm::dot(look(dragged(camera, -10, 0)), right), 0) << heading;
        EXPECT_LT(look(dragged(camera, 0, 10)).y, 0) << heading;
        EXPECT_GT(look(dragged(camera, 0, -10)).y, 0) << heading;
        constexpr double per_pixel = 0.003;  // [rad]
        EXPECT_NEAR(std::acos(glm::dot(look(dragged(camera, 100, 0)), look(camera))), 100 * per_pixel, 1e-7);
        EXPECT_NEAR(std::acos(glm::dot(look(dragged(camera, 0, 100)), look(camera))), 100 * per_pixel, 1e-7);
    }
}

TEST(FreeCamera, NeverTurnsOverItsHead) {
    for (const double way : {-1e6, 1e6}) {
        const FreeCamera camera = dragged(at(0.4), 0, way);
        EXPECT_LT(std::abs(look(camera).y), 1);
        EXPECT_EQ(look(camera).y<0, way> 0);
        EXPECT_GT(std::abs(look(camera).y), 0.99);
        const FreeCamera back = dragged(camera, 0, -way / 1e6 * 500);
        EXPECT_LT(std::abs(look(back).y), 0.1) << "what was dragged beyond is not owed";
    }
}

TEST(FreeCamera, StaysAboveTheGroundAndWithinAKilometre) {
    for (const render::Input& input : {held(0, 0, -1), held(0, 0, 1), held(1, 0, 0), held(0, 1, 0), held(0, -1, 0)}) {
        for (const double heading : {0.0, 1.5707963, 3.1415926, -1.5707963}) {
            FreeCamera camera = at(heading);
            camera.move(input, 1e5);
            const glm::dvec3 position = camera.pose().position;
            EXPECT_GE(position.y, 0.3);
            for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(position[axis]), 1000);
        }
    }
    FreeCamera camera = at(0);
    camera.move(held(0, 0, -1), 1e5);
    EXPECT_EQ(camera.pose().position.y, 0.3);
    camera.move(held(0, 0, 1), 1e5);
    EXPECT_EQ(camera.pose().position.y, 1000);
    camera.move(held(1, 0, 0), 1e5);
    EXPECT_EQ(camera.pose().position.z, 1000);
    camera.move(held(-1, 0, 0), 1e5);
    EXPECT_EQ(camera.pose().position.z, -1000);
}

TEST(FreeCamera, EveryWayToSteerIsSteering) {
    EXPECT_FALSE(FreeCamera::steers({}));
    EXPECT_FALSE(FreeCamera::steers(held(0, 0, 0, true))) << "shift alone";
    render::Input command;
    command.commands = {render::Command::pause};
    EXPECT_FALSE(FreeCamera::steers(command));
    for (const float sign : {-1.0f, 1.0f}) {
        EXPECT_TRUE(FreeCamera::steers(held(sign, 0, 0)));
        EXPECT_TRUE(FreeCamera::steers(held(0, sign, 0)));
        EXPECT_TRUE(FreeCamera::steers(held(0, 0, sign)));
        render::Input right, down;
        right.look_x = down.look_y = sign;
        EXPECT_TRUE(FreeCamera::steers(right));
        EXPECT_TRUE(FreeCamera::steers(down));
    }
}

}  // namespace
}  // namespace apps
