#include "tests/precision/setting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace precision {

namespace {

constexpr double person_height = 1.75, nearest = 2;  // [m]

double tangent(double degrees) {
    return std::tan(degrees * std::numbers::pi / 360);
}

}  // namespace

glm::dvec3 Setting::place() const {
    return origin * glm::normalize(glm::dvec3(0.83, 0.05, -0.57));
}

double Setting::distance() const {
    return std::max(nearest, 1.5 * person_height / tangent(fov));
}

double Setting::pixels_per_metre(double depth) const {
    return 0.5 * height / (tangent(fov) * depth);
}

scene::CameraPose aim(const Setting& setting, const glm::dvec3& target, int number) {
    const double azimuth = 2.399963 * number, elevation = 0.03 * (number % 11);
    const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                          std::cos(azimuth) * std::cos(elevation));
    return {target + setting.distance() * back, target, setting.fov * std::numbers::pi / 180};
}

Eye::Eye(const scene::CameraPose& pose, int width_px, int height_px)
    : position(pose.position),
      forward(glm::normalize(pose.target - pose.position)),
      tan_y(std::tan(pose.fov_y / 2)),
      width(width_px),
      height(height_px) {
    right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    up = glm::cross(right, forward);
    tan_x = tan_y * width / height;
}

glm::dvec2 Eye::pixel(const glm::dvec3& from_eye) const {
    const double along = depth(from_eye);
    return {0.5 * width * (1 + glm::dot(right, from_eye) / (along * tan_x)),
            0.5 * height * (1 - glm::dot(up, from_eye) / (along * tan_y))};
}

bool Eye::shows(const glm::dvec2& pixel) const {
    return pixel.x >= 0 && pixel.x <= width && pixel.y >= 0 && pixel.y <= height;
}

void Errors::add(double px) {
    worst = std::max(worst, px);
    sum += px;
    ++count;
}

void Errors::include(const Errors& other) {
    worst = std::max(worst, other.worst);
    sum += other.sum;
    count += other.count;
}

}  // namespace precision
