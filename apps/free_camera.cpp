#include "apps/free_camera.h"

#include <algorithm>
#include <cmath>

namespace apps {

namespace {
constexpr double walk_speed = 8, hurry_speed = 40;  // [m/s]
constexpr double turn_per_pixel = 0.003;            // [rad/px]
constexpr double steepest = 1.5;                    // [rad]
constexpr double lowest = 0.3, farthest = 1000;     // [m]
}  // namespace

FreeCamera::FreeCamera(const scene::CameraPose& start) : position_(start.position), fov_y_(start.fov_y) {
    const glm::dvec3 look = start.forward();
    heading_ = std::atan2(look.x, look.z);
    pitch_ = std::asin(std::clamp(look.y, -1.0, 1.0));
}

glm::dvec3 FreeCamera::forward() const {
    return {std::sin(heading_) * std::cos(pitch_), std::sin(pitch_), std::cos(heading_) * std::cos(pitch_)};
}

void FreeCamera::move(const render::Input& input, double seconds) {
    heading_ -= turn_per_pixel * input.look_x;
    pitch_ = std::clamp(pitch_ - turn_per_pixel * input.look_y, -steepest, steepest);
    const glm::dvec3 right{-std::cos(heading_), 0, std::sin(heading_)};
    const double step = (input.hurry ? hurry_speed : walk_speed) * seconds;
    position_ +=
        step * (double(input.forward) * forward() + double(input.right) * right + glm::dvec3(0, double(input.up), 0));
    position_ = glm::clamp(position_, glm::dvec3(-farthest, lowest, -farthest), glm::dvec3(farthest));
}

scene::CameraPose FreeCamera::pose() const {
    return {position_, position_ + forward(), fov_y_};
}

bool FreeCamera::steers(const render::Input& input) {
    return input.forward != 0 || input.right != 0 || input.up != 0 || input.look_x != 0 || input.look_y != 0;
}

}  // namespace apps
