#include "scene/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace scene {

namespace {

// Hermite's cubic between two keys, u in [0, 1] of `span` seconds, with velocities a second.
template <typename T>
T hermite(const T& from, const T& from_velocity, const T& to, const T& to_velocity, double u, double span) {
    const double u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * from + (u3 - 2 * u2 + u) * span * from_velocity + (3 * u2 - 2 * u3) * to +
           (u3 - u2) * span * to_velocity;
}

// Velocity of a field at key `i` [1/s]: the chord between its neighbours in the same shot. A closed path's ends have
// neighbours across the seam.
template <typename T>
T velocity(const CameraPath& path, std::size_t i, T CameraPose::*field) {
    const std::vector<CameraKey>& keys = path.keys;
    const std::size_t last = keys.size() - 1;
    const bool at_seam = path.closed && (i == 0 || i == last);
    const bool begins = at_seam ? keys[last].cut : i == 0 || keys[i].cut;
    const bool ends = at_seam ? keys[1].cut : i == last || keys[i + 1].cut;
    const std::size_t arrives = at_seam ? last : i, leaves = at_seam ? 0 : i;
    const std::size_t before = begins ? arrives : arrives - 1, after = ends ? leaves : leaves + 1;
    const double span = keys[arrives].time - keys[before].time + keys[after].time - keys[leaves].time;
    return span > 0 ? (keys[after].pose.*field - keys[before].pose.*field) / span : T(0);
}

// The key from which `time` leads to the next.
std::size_t key_before(const std::vector<CameraKey>& keys, double time) {
    const auto after =
        std::upper_bound(keys.begin(), keys.end(), time, [](double t, const CameraKey& key) { return t < key.time; });
    const std::ptrdiff_t index = after - keys.begin() - 1;
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, std::ssize(keys) - 2));
}

}  // namespace

glm::dvec3 CameraPose::forward() const {
    assert(position != target);
    const glm::dvec3 look = target - position, size = glm::abs(look);
    return glm::normalize(look / std::max({size.x, size.y, size.z}));  // the squares of tiny numbers are 0
}

CameraPose CameraPath::at(double time) const {
    assert(!keys.empty());
    if (keys.size() == 1) return keys.front().pose;
    const double first = keys.front().time, period = keys.back().time - first;
    if (closed) {
        time = first + std::fmod(time - first, period);
        if (time < first) time += period;
    }
    time = std::clamp(time, first, first + period);
    const std::size_t i = key_before(keys, time);
    const CameraKey &from = keys[i], &to = keys[i + 1];
    const double span = to.time - from.time, u = (time - from.time) / span;
    if (to.cut) return u < 1 ? from.pose : to.pose;
    const auto blend = [&](auto CameraPose::*field) {
        return hermite(from.pose.*field, velocity(*this, i, field), to.pose.*field, velocity(*this, i + 1, field), u,
                       span);
    };
    CameraPose pose{blend(&CameraPose::position), blend(&CameraPose::target), blend(&CameraPose::fov_y)};
    pose.fov_y =
        std::clamp(pose.fov_y, std::min(from.pose.fov_y, to.pose.fov_y), std::max(from.pose.fov_y, to.pose.fov_y));
    if (pose.position == pose.target) pose.target += glm::dvec3(0, 0, 1);
    return pose;
}

}  // namespace scene
