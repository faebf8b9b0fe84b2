#include "tests/reference/scene.h"

#include <algorithm>
#include <cmath>

namespace reference {

namespace {

constexpr int ticks_per_second = 60;

// Lowest and highest y.
glm::dvec2 extent_y(const Surface& surface) {
    glm::dvec2 extent(INFINITY, -INFINITY);
    for (const glm::dvec3& position : surface.positions)
        extent = {std::min(extent.x, position.y), std::max(extent.y, position.y)};
    return extent;
}

}  // namespace

Camera::Camera(const scene::CameraPose& pose, int width_px, int height_px)
    : position(pose.position),
      forward(glm::normalize(pose.target - pose.position)),
      tan_y(std::tan(pose.fov_y / 2)),
      width(width_px),
      height(height_px) {
    // Straight up or down any heading will do: the product takes -z for up.
    const glm::dvec3 zenith = std::abs(forward.y) > 0.9999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    right = glm::normalize(glm::cross(forward, zenith));
    up = glm::cross(right, forward);
    tan_x = tan_y * width / height;
}

glm::dvec3 Camera::ray(double x, double y) const {
    return forward + (2 * x / width - 1) * tan_x * right + (1 - 2 * y / height) * tan_y * up;
}

Figure::Figure(const model::Character& character, std::vector<int> clips, const pointsample::PointModel* points)
    : character_(character), mesh_(&character.mesh), points_(points), clips_(std::move(clips)) {
    glm::dvec2 reach = extent_y(struck(0, 0));
    height_ = reach.y - reach.x;
    for (int slot = 0; slot < std::max<int>(1, static_cast<int>(clips_.size())); ++slot) {
        const double seconds = clips_.empty() ? 0 : character.clips[static_cast<std::size_t>(clips_[slot])].duration;
        const std::int64_t ticks = std::max<std::int64_t>(1, std::llround(seconds * ticks_per_second));
        for (std::int64_t tick = 0; tick < ticks; ++tick) {
            const Surface surface = struck(slot, tick);
            const glm::dvec2 extent = extent_y(surface);
            reach = {std::min(reach.x, extent.x), std::max(reach.y, extent.y)};
            area_ = std::max(area_, area_of(*mesh_, surface));
        }
    }
    middle_ = (reach.x + reach.y) / 2;
}

Surface Figure::struck(int slot, std::int64_t tick) const {
    const int clip = clips_.empty() ? -1 : clips_[static_cast<std::size_t>(slot)];
    return surface_at(character_, clip, static_cast<double>(tick) / ticks_per_second);
}

const Surface& Figure::pose(int slot, std::int64_t tick) const {
    const auto known = poses_.find({slot, tick});
    return known != poses_.end() ? known->second : poses_[{slot, tick}] = struck(slot, tick);
}

const std::vector<Figure::Look>& Figure::looks(std::size_t count) const {
    const auto known = looks_.find(count);
    if (known != looks_.end()) return known->second;
    constexpr std::size_t longest_averaged = 32;  // more points show the spots they stand on
    const std::size_t all = count > longest_averaged ? count : points_->size();
    std::vector<Look> sums(count, Look{});
    std::vector<double> members(count, 0.0);
    for (std::size_t p = 0; p < all; ++p) {
        std::size_t owner = 0;
        double closest = INFINITY;
        for (std::size_t q = 0; q < count && p >= count; ++q) {
            const glm::dvec3 apart = glm::dvec3(points_->positions[q]) - glm::dvec3(points_->positions[p]);
            const bool opposed = glm::dot(points_->normals[q], points_->normals[p]) < 0;
            const double distance = (opposed ? 2 : 1) * glm::length(apart);
            if (distance < closest) {
                closest = distance;
                owner = q;
            }
        }
        if (p < count) owner = p;
        const glm::dvec3 code = glm::dvec3(points_->colors[p]) / 255.0;
        sums[owner].albedo += code * code;
        const std::uint32_t corner = mesh_->indices[3 * std::size_t{points_->surface[p].triangle} + 2];
        if (mesh_->materials[mesh_->material_ids[corner]].unlit) sums[owner].unlit += glm::dot(code, code);
        sums[owner].slots[points_->slots[p]] += 1;
        if (!points_->own_lights.empty()) {
            const glm::dvec3 own = glm::dvec3(points_->own_lights[p]) / 255.0;
            sums[owner].emitted += own * own;
        }
        ++members[owner];
    }
    for (std::size_t p = 0; p < count; ++p) {
        const double light = sums[p].albedo.r + sums[p].albedo.g + sums[p].albedo.b;
        if (light > 0) sums[p].unlit /= light;
        sums[p].albedo /= members[p];
        sums[p].emitted /= members[p];
        for (double& share : sums[p].slots) share /= members[p];
    }
    return looks_[count] = sums;
}

namespace {

// Every f-th frame beyond D (equation 1), each at ticks of their own: the last of them that is not in the future.
std::int64_t last_move(std::int64_t tick, double depth, const sfsm::Decision& decision, std::uint32_t own) {
    constexpr double theta = 0.075;  // [1/m]
    constexpr std::int64_t longest = 32;
    if (decision.state == sfsm::State::original) return tick;
    const double frames = std::floor((depth - decision.motion_distance) * theta);
    const auto period = static_cast<std::int64_t>(std::clamp(frames, 1.0, static_cast<double>(longest)));
    std::int64_t due = tick;
    while ((due - static_cast<std::int64_t>(own % static_cast<std::uint64_t>(period))) % period != 0) --due;
    return due;
}

// 1.2 for each splat-sized square of the surface, rounded up to 2, 3, 4, 6, 8, 12 ...; 0 where a point costs more than
// two triangles, or where there are not so many points.
std::size_t points_for(const Figure& figure, double pixels_per_unit, const sfsm::Decision& decision) {
    if (decision.state != sfsm::State::points || !(decision.splat_size > 0)) return 0;
    const double squares = figure.area() * std::pow(pixels_per_unit / decision.splat_size, 2);
    std::size_t points = 2;
    for (std::size_t power = 2; static_cast<double>(points) < 1.2 * squares; power *= 2) {
        points = 3 * power / 2;
        if (static_cast<double>(points) < 1.2 * squares) points = 2 * power;
        if (points > figure.points().size()) return 0;
    }
    const bool worth_it = 2 * points <= figure.mesh().indices.size() / 3 && points <= figure.points().size();
    return worth_it ? points : 0;
}

}  // namespace

std::vector<Person> people_of(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                              std::span<const motion::PoseTable> tables, std::span<const Figure> figures,
                              const Camera& camera, const sfsm::Decision& decision, std::int64_t tick) {
    std::vector<Person> people;
    std::size_t block = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        while (i >= std::size_t{crowd.blocks[block].first} + crowd.blocks[block].count) ++block;
        const glm::dvec3 origin = crowd.blocks[block].origin;
        const std::size_t character = crowd.character[i];
        const Figure& figure = figures[character];
        const double scale = crowd.height[i] / figure.height();
        // How often they move and how many points they need follow from the depth of their middle now.
        const glm::dvec3 middle = origin + glm::dvec3(scene::place(crowd, i, cast[character], tick).position) +
                                  glm::dvec3(0, scale * figure.middle(), 0);
        const double depth = std::max(glm::dot(middle - camera.position, camera.forward), Camera::near);
        const std::int64_t due = last_move(tick, depth, decision, crowd.hash[i]);
        const scene::Placement placement = scene::place(crowd, i, cast[character], due);
        const scene::Action action = scene::act(crowd, i, cast[character], tables[character], due);
        Person person;
        person.figure = &figure;
        person.slot = action.clip;
        person.tick = action.clip_tick;
        person.origin = origin + glm::dvec3(placement.position);
        person.yaw = placement.yaw;
        person.scale = scale;
        person.palette = crowd.palette[i];
        const bool sits = crowd.role[i] == scene::Role::spectator && cast[character].sits;
        person.shade = sits ? 0 : 0.27 * crowd.height[i];
        person.points = points_for(figure, scale * camera.pixels_per_metre(depth), decision);
        people.push_back(person);
    }
    return people;
}

}  // namespace reference
