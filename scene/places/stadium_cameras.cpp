// aim_cameras: derived from a stadium's plan so that they fit it whatever its size.
#include <algorithm>
#include <cmath>

#include "scene/places/stadium_layout.h"

namespace scene {

namespace {

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
    constexpr double eye = 2.3;     // [m] above the aisle: over most hands of who sits in front
    const Row& row = plan.rows[static_cast<std::size_t>(share * static_cast<double>(plan.rows.size() - 1))];
    const glm::vec2 xz = aisle_towards(plan, {-0.62f, 0.78f}).at(row.offset + plan.room.depth / 2);
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

// Keys a second apart that lead from `from` to `to`, slowly at both ends and slower where they near `to`: however far
// outside a tour begins, it doesn't shoot into the bowl. Without the last.
void add_approach(std::vector<CameraKey>& keys, const CameraKey& from, const CameraKey& to) {
    const int steps = static_cast<int>(std::lround(std::abs(to.time - from.time)));
    for (int i = 0; i < steps; ++i) {
        const double t = static_cast<double>(i) / steps, smooth = t * t * (3 - 2 * t);
        const double rest = (1 - smooth) * (1 - smooth);
        keys.push_back(
            {glm::mix(from.time, to.time, t),
             {glm::mix(to.pose.position, from.pose.position, rest), glm::mix(to.pose.target, from.pose.target, rest),
              glm::mix(to.pose.fov_y, from.pose.fov_y, rest)}});
    }
}

// From outside over the rim, down to the infield, along the front row, up over a bend, and out again.
CameraPath roam(const StadiumPlan& plan) {
    const double above = plan.rim_height + 14.0;  // [m] over roof and masts
    const double faces = first_floor + 2.1;       // [m] over the front row's raised hands
    const double beside = wall_offset - 0.7;      // [m] before the wall
    const double fov = degrees(50);
    const auto front_row = [&](double x) { return beside_straight(plan, x, first_row_offset + 4, faces + 0.6); };
    const CameraKey start{0, remote(plan)}, end{60, remote(plan)};
    const CameraKey over_rim{8, {in_bend(plan, 1, degrees(60), plan.outer_offset, above), {-20, 0, 0}, fov}};
    const CameraKey over_end{54, {in_bend(plan, 1, degrees(8), plan.outer_offset - 6, above + 4), {-40, 0, 0}, fov}};
    CameraPath path;
    path.closed = true;
    add_approach(path.keys, start, over_rim);
    path.keys.insert(
        path.keys.end(),
        {over_rim,
         {14, {{40, 14, 16}, {-40, 6, 30}, fov}},
         {20, {{20, 4.0, 14}, beside_straight(plan, 0, 20, 5), fov}},
         {25, {beside_straight(plan, -14, -4, 4.2), beside_straight(plan, -4, 18, 4.5), fov}},
         {29, {beside_straight(plan, -24, beside - 3, faces + 0.4), front_row(-14), fov}},
         {33, {beside_straight(plan, -14, beside, faces), front_row(-5), fov}},
         {38, {beside_straight(plan, 8, beside, faces), front_row(18), fov}},
         {42, {beside_straight(plan, 27, beside, faces + 0.3), front_row(38), fov}},
         {44, {beside_straight(plan, 36, beside - 1, faces + 1.2), in_bend(plan, 1, degrees(70), 18, 5), fov}},
         {46, {in_bend(plan, 1, degrees(76), 10, faces + 3.2), in_bend(plan, 1, degrees(35), 20, 6), fov}},
         {48, {in_bend(plan, 1, degrees(52), 9, faces + 7), in_bend(plan, 1, degrees(-20), 14, 5), fov}},
         {51, {in_bend(plan, 1, degrees(25), 8, faces + 11), {-20, 2, -40}, fov}}});
    std::vector<CameraKey> leave;
    add_approach(leave, end, over_end);
    path.keys.push_back(over_end);
    path.keys.insert(path.keys.end(), leave.rbegin(), leave.rend());
    return path;
}

}  // namespace

Cameras aim_cameras(const StadiumPlan& plan) {
    return {{{{0, still(plan)}}}, {{{0, close(plan)}}}, {{{0, medium(plan)}}}, {{{0, remote(plan)}}}, roam(plan)};
}

}  // namespace scene
