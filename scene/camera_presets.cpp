// The presets, derived from a stadium's plan so that they fit it whatever its size.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "scene/camera_path.h"
#include "scene/layout.h"

namespace scene {

namespace {

constexpr std::array<std::string_view, 5> preset_names{"still", "close", "medium", "remote", "roam"};

constexpr double degrees(double angle) {
    return angle * std::numbers::pi / 180;
}

// The point at `height` above the outward line through the oval's centre line's point at angle: in the bends'
// directions (cos, sin) from a bend's centre, on the straights where x is given.
glm::dvec3 beside_straight(const StadiumPlan& plan, double x, double offset, double height) {
    return {x, height, plan.oval.radius + offset};
}

glm::dvec3 in_bend(const StadiumPlan& plan, double side, double angle, double offset, double height) {
    const double reach = plan.oval.radius + offset;
    return {side * (plan.oval.half_straight + reach * std::cos(angle)), height, reach * std::sin(angle)};
}

// The aisle whose spoke points most nearly in a direction.
const Spoke& aisle_towards(const StadiumPlan& plan, glm::vec2 direction) {
    return *std::max_element(plan.spokes.begin(), plan.spokes.end(), [&](const Spoke& a, const Spoke& b) {
        return glm::dot(a.outward, direction) < glm::dot(b.outward, direction);
    });
}

CameraPose still(const StadiumPlan& plan) {
    constexpr double share = 0.85;  // of the rows are below
    constexpr double eye = 1.9;     // [m] above the aisle: over the heads of who sits in front
    const Row& row = plan.rows[static_cast<std::size_t>(share * static_cast<double>(plan.rows.size() - 1))];
    const glm::vec2 xz = aisle_towards(plan, {-0.62f, 0.78f}).at(row.offset + row_depth / 2);
    return {{xz.x, row.floor + eye, xz.y}, {-5.0, 0.0, 12.0}, degrees(56)};
}

CameraPose close(const StadiumPlan& plan) {
    constexpr double over_wall = 2.1;  // [m] above the walkway, over the wall's coping
    return {beside_straight(plan, -4.0, wall_offset + 0.1, first_floor + over_wall),
            beside_straight(plan, 3.0, first_row_offset + 4.0, first_floor + 2.0), degrees(50)};
}

CameraPose medium(const StadiumPlan& plan) {
    const Row& middle = plan.rows[plan.rows.size() / 2];
    return {beside_straight(plan, -12.0, -18.0, 3.6), beside_straight(plan, 4.0, middle.offset, middle.floor * 0.8),
            degrees(42)};
}

// Looks at the centre spot from so far that everybody and the rim are in a picture of 16:9.
CameraPose remote_from(const StadiumPlan& plan, double azimuth, double elevation) {
    constexpr double fov = degrees(42), aspect = 16.0 / 9.0, margin = 1.03;
    constexpr int samples = 64;  // of the outlines of crowd and rim
    const glm::dvec3 back(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                          std::cos(elevation) * std::sin(azimuth));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right);
    const double slope = std::tan(fov / 2);
    double distance = 0;
    const auto include = [&](float arc, float offset, float height) {
        const glm::vec2 xz = plan.oval.position(arc, offset);
        const glm::dvec3 point(xz.x, height, xz.y);
        const double off_axis = std::max(std::abs(glm::dot(point, right)) / aspect, std::abs(glm::dot(point, up)));
        distance = std::max(distance, glm::dot(point, back) + margin * off_axis / slope);
    };
    for (int i = 0; i < samples; ++i) {
        const float share = static_cast<float>(i) / samples;
        include(share * plan.oval.length(plan.crowd_offset), plan.crowd_offset, 0);
        include(share * plan.oval.length(plan.outer_offset), plan.outer_offset, plan.rim_height);
    }
    return {distance * back, {0.0, 0.0, 0.0}, fov};
}

CameraPose remote(const StadiumPlan& plan) {
    return remote_from(plan, degrees(62), degrees(42));
}

// From outside over the rim, down to the infield, along the front row, up over a bend, and out again.
CameraPath roam(const StadiumPlan& plan) {
    const double over_rim = plan.rim_height + 14.0;
    const double faces = first_floor + 2.1, beside = wall_offset - 0.7;
    const double stand = plan.rows[plan.rows.size() / 3].floor;
    CameraPath path;
    path.closed = true;
    const auto add = [&](double time, glm::dvec3 position, glm::dvec3 target, double fov) {
        path.keys.push_back({time, {position, target, degrees(fov)}});
    };
    const CameraPose start = remote_from(plan, degrees(62), degrees(42));
    add(0, start.position, start.target, 42);
    add(8, in_bend(plan, 1, degrees(60), plan.outer_offset, over_rim), {-20, 0, 0}, 48);
    add(14, {40, 14, 16}, {-40, 6, 30}, 50);
    add(20, {20, 4.0, 14}, beside_straight(plan, 0, 20, 5), 50);
    add(26, beside_straight(plan, -14, -4, 4.2), beside_straight(plan, -4, 18, 4.5), 50);
    add(31, beside_straight(plan, -24, beside - 1.5, faces + 0.4),
        beside_straight(plan, -14, first_row_offset + 4, faces + 0.6), 50);
    add(38, beside_straight(plan, 6, beside, faces), beside_straight(plan, 16, first_row_offset + 4, faces + 0.6), 50);
    add(44, beside_straight(plan, 36, beside, faces + 0.6), in_bend(plan, 1, degrees(55), 18, stand + 1), 50);
    add(50, in_bend(plan, 1, degrees(20), 4, plan.rim_height * 0.7), {-30, 4, -30}, 55);
    add(55, in_bend(plan, 1, degrees(8), plan.outer_offset - 6, over_rim + 4), {-40, 0, 0}, 50);
    add(60, start.position, start.target, 42);
    return path;
}

}  // namespace

bool is_preset(const std::string& name) {
    return std::find(preset_names.begin(), preset_names.end(), name) != preset_names.end();
}

CameraPath preset_path(const std::string& name, const StadiumPlan& plan) {
    if (name == "still") return {{{0, still(plan)}}};
    if (name == "close") return {{{0, close(plan)}}};
    if (name == "medium") return {{{0, medium(plan)}}};
    if (name == "remote") return {{{0, remote(plan)}}};
    if (name == "roam") return roam(plan);
    std::string known;
    for (const std::string_view preset : preset_names) known += (known.empty() ? "" : ", ") + std::string(preset);
    throw std::runtime_error("no camera '" + name + "': expected one of " + known);
}

}  // namespace scene
