#include "scene/gathering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/person.h"
#include "sfsm/random.h"

namespace scene {

namespace {

using sfsm::below;
using sfsm::hash;
using sfsm::upper_unit;

// Room for rounding when a shader scales and turns a person in another order [m].
constexpr float box_margin = 0.01f;

void include(motion::Bounds& box, const motion::Bounds& other) {
    box.min = glm::min(box.min, other.min);
    box.max = glm::max(box.max, other.max);
}

// What somebody with this pose box touches who stands at the origin, turned by `yaw`.
motion::Bounds turned(const motion::Bounds& box, float scale, float yaw) {
    const float c = std::cos(yaw), s = std::sin(yaw);
    const glm::vec3 center = scale * box.center(), half = 0.5f * scale * box.size();
    const glm::vec3 middle(c * center.x + s * center.z, center.y, c * center.z - s * center.x);
    const glm::vec3 reach(std::fabs(c) * half.x + std::fabs(s) * half.z, half.y,
                          std::fabs(s) * half.x + std::fabs(c) * half.z);
    return {middle - reach - box_margin, middle + reach + box_margin};
}

// What somebody touches who may be turned any way.
motion::Bounds turned_any_way(const motion::Bounds& box, float scale) {
    const glm::vec3 far = glm::max(glm::abs(box.min), glm::abs(box.max));
    const float reach = scale * std::hypot(far.x, far.z) + box_margin;
    return {{-reach, scale * box.min.y - box_margin, -reach}, {reach, scale * box.max.y + box_margin, reach}};
}

motion::Bounds moved(const motion::Bounds& box, glm::vec3 by) {
    return {box.min + by, box.max + by};
}

void reserve(Crowd& crowd, std::size_t people) {
    crowd.position.reserve(people);
    crowd.yaw.reserve(people);
    crowd.height.reserve(people);
    crowd.character.reserve(people);
    crowd.role.reserve(people);
    crowd.around.reserve(people);
    crowd.hash.reserve(people);
    crowd.palette.reserve(people);
}

}  // namespace

Gathering::Gathering(const Audience& of, std::shared_ptr<const Path> path) : audience(of) {
    assert(of.people >= 1 && of.people <= 10'000'000);
    assert(!of.cast.empty() && of.cast.size() <= 256 && of.cast.size() == of.poses.size());
    assert(of.weights.empty() || of.weights.size() == of.cast.size());
    const auto differs = [&](double weight) { return weight != of.weights.front(); };
    if (std::ranges::any_of(of.weights, differs))
        std::partial_sum(of.weights.begin(), of.weights.end(), std::back_inserter(sums_));
    crowd.path = std::move(path);
    reserve(crowd, static_cast<std::size_t>(of.people));
}

std::uint64_t Gathering::bits(Salt salt, std::uint64_t which) const {
    return hash(hash(audience.seed, salt), which);
}

std::uint8_t Gathering::draw_character(std::uint64_t from) const {
    if (sums_.empty()) return static_cast<std::uint8_t>(below(from, static_cast<std::uint32_t>(audience.cast.size())));
    const double share = static_cast<double>(upper_unit(from)) * sums_.back();
    const auto found = std::ranges::upper_bound(sums_, share);
    return static_cast<std::uint8_t>(std::min(found - sums_.begin(), std::ssize(sums_) - 1));
}

float Gathering::seat_lift(std::uint8_t character, float height) const {
    if (!audience.cast[character].sits) return 0;
    return seat_height * (1.0f - height / audience.poses[character].rest_height);
}

void Gathering::open_block(const glm::dvec3& origin) {
    crowd.blocks.push_back({static_cast<std::uint32_t>(crowd.size()), 0, {}, origin});
}

void Gathering::add(const Spot& spot) {
    const std::uint64_t own = bits(salt_person, crowd.size());
    const motion::PoseTable& table = audience.poses[spot.character];
    glm::vec3 position = spot.position;
    position.y -= spot.height / table.rest_height * table.floor;
    crowd.position.push_back(position);
    crowd.yaw.push_back(spot.yaw);
    crowd.height.push_back(spot.height);
    crowd.character.push_back(spot.character);
    crowd.role.push_back(spot.role);
    crowd.around.push_back(spot.around);
    crowd.hash.push_back(static_cast<std::uint32_t>(own >> 32));
    crowd.palette.push_back(dress(spot.fans, hash(own, salt_looks)));
    ++crowd.blocks.back().count;
}

void Gathering::close_block() {
    CrowdBlock& block = crowd.blocks.back();
    if (block.count == 0) {
        crowd.blocks.pop_back();
        return;
    }
    for (std::size_t i = block.first; i < block.first + block.count; ++i) {
        const motion::Bounds reach = reach_of(i);
        if (i == block.first) block.box = reach;
        include(block.box, reach);
    }
    const glm::vec3 far = glm::max(glm::abs(block.box.min), glm::abs(block.box.max));
    if (!glm::all(glm::lessThanEqual(far, glm::vec3(widest_block))))
        throw std::invalid_argument("a block of people reaches " + std::to_string(std::max({far.x, far.y, far.z})) +
                                    " m from its origin, expected at most " + std::to_string(widest_block) + " m");
    if (audience.progress) audience.progress(static_cast<double>(crowd.size()) / static_cast<double>(audience.people));
}

motion::Bounds Gathering::reach_of(std::size_t person) const {
    const motion::PoseTable& table = audience.poses[crowd.character[person]];
    const float scale = crowd.height[person] / table.rest_height;
    const glm::vec3 position = crowd.position[person];
    if (!follows_path(crowd.role[person])) return moved(turned(table.box, scale, crowd.yaw[person]), position);
    const motion::Bounds way = crowd.path->bounds(position.x), reach = turned_any_way(table.box, scale);
    return moved({way.min + reach.min, way.max + reach.max}, {0, position.y, 0});
}

}  // namespace scene
