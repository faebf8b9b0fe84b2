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

// The keys around key `i` whose chord is its velocity; a closed path's ends have neighbours across the seam.
struct Neighbours {
    const CameraKey& before;
    const CameraKey& after;
    double span;  // [s] between them
};

Neighbours neighbours(const CameraPath& path, std::size_t i) {
    const std::vector<CameraKey>& keys = path.keys;
    const std::size_t last = keys.size() - 1;
    if (path.closed && (i == 0 || i == last)) {
        return {keys[last - 1], keys[1], keys[last].time - keys[last - 1].time + keys[1].time - keys[0].time};
    }
    const CameraKey& before = keys[i == 0 ? 0 : i - 1];
    const CameraKey& after = keys[i == last ? last : i + 1];
    return {before, after, after.time - before.time};
}

// The key from which `time` leads to the next.
std::size_t key_before(const std::vector<CameraKey>& keys, double time) {
    const auto after =
        std::upper_bound(keys.begin(), keys.end(), time, [](double t, const CameraKey& key) { return t < key.time; });
    const std::ptrdiff_t index = after - keys.begin() - 1;
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, std::ssize(keys) - 2));
}

}  // namespace

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
    const Neighbours a = neighbours(*this, i), b = neighbours(*this, i + 1);
    const auto blend = [&](auto CameraPose::*field) {
        return hermite(from.pose.*field, (a.after.pose.*field - a.before.pose.*field) / a.span, to.pose.*field,
                       (b.after.pose.*field - b.before.pose.*field) / b.span, u, span);
    };
    CameraPose pose{blend(&CameraPose::position), blend(&CameraPose::target), blend(&CameraPose::fov_y)};
    pose.fov_y =
        std::clamp(pose.fov_y, std::min(from.pose.fov_y, to.pose.fov_y), std::max(from.pose.fov_y, to.pose.fov_y));
    constexpr double least_distance = 1e-6;  // [m] nearer targets give no direction
    if (glm::distance(pose.position, pose.target) < least_distance) pose.target = pose.position + glm::dvec3(0, 0, 1);
    return pose;
}

}  // namespace scene
