// How far people's surfaces truly are from where they should be, and from what is drawn of them: vertex by vertex, in
// double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "figures/splats.h"
#include "scene/crowd.h"

namespace tests {

// A crowd of one character.
struct Watched {
    const scene::Crowd& crowd;
    const scene::CastMember& member;
    const motion::PoseTable& poses;
};

inline double scale_of(const Watched& of, std::size_t person) {
    return static_cast<double>(of.crowd.height[person]) / static_cast<double>(of.poses.rest_height);
}

inline glm::dvec3 position_of(const motion::PosedVertex& vertex, const motion::Bounds& box) {
    return glm::dvec3(box.min) + glm::dvec3(vertex.x, vertex.y, vertex.z) / 65535.0 * glm::dvec3(box.size());
}

// [m] A person's vertices at a tick, from their block's origin; with keys in the pose that far blocks show.
inline std::vector<glm::dvec3> surface_at(const Watched& of, std::size_t person, std::int64_t tick,
                                          const figures::SplatKeys* keys = nullptr) {
    const scene::Placement placement = scene::place(of.crowd, person, of.member, tick);
    const scene::Action action = scene::act(of.crowd, person, of.member, of.poses, tick);
    int pose = of.poses.clips[action.clip].pose_at(action.clip_tick);
    if (keys) pose = keys->poses[keys->of_pose[static_cast<std::size_t>(pose)]];
    const double scale = scale_of(of, person), yaw = static_cast<double>(placement.yaw);
    const double s = std::sin(yaw), c = std::cos(yaw);
    std::vector<glm::dvec3> surface;
    for (int vertex = 0; vertex < of.poses.vertex_count; ++vertex) {
        const std::int64_t index = std::int64_t{pose} * of.poses.vertex_count + vertex;
        const glm::dvec3 at = position_of(of.poses.vertices[static_cast<std::size_t>(index)], of.poses.box);
        surface.push_back(glm::dvec3(placement.position) +
                          scale * glm::dvec3(c * at.x + s * at.z, at.y, c * at.z - s * at.x));
    }
    return surface;
}

inline double farthest_apart(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 d = a[i] - b[i];
        most = std::max(most, glm::dot(d, d));
    }
    return std::sqrt(most);
}

// [model units] In one pose, by number of points: how far the farthest of many spots of every triangle, hidden ones
// too, is from the nearest of so many points.
inline std::vector<double> true_covering(const figures::Figure& figure, int pose, std::span<const int> counts) {
    constexpr int steps = 4;  // along a triangle's sides
    const motion::PoseTable& table = *figure.poses;
    const auto at = [&](const std::vector<motion::PosedVertex>& all, int count, std::int64_t index) {
        return position_of(all[static_cast<std::size_t>(std::int64_t{pose} * count + index)], table.box);
    };
    std::vector<glm::dvec3> points;
    for (int i = 0; i < table.point_count; ++i) points.push_back(at(table.points, table.point_count, i));
    std::vector<double> most(counts.size());
    const auto look = [&](const glm::dvec3& spot) {
        double least = std::numeric_limits<double>::infinity();
        std::size_t next = 0;
        for (int i = 0; i < table.point_count && next < counts.size(); ++i) {
            const glm::dvec3 d = points[static_cast<std::size_t>(i)] - spot;
            least = std::min(least, glm::dot(d, d));
            for (; next < counts.size() && counts[next] == i + 1; ++next) most[next] = std::max(most[next], least);
        }
    };
    for (std::size_t i = 0; i + 2 < figure.mesh->indices.size(); i += 3) {
        const std::uint32_t* corner = &figure.mesh->indices[i];
        const glm::dvec3 a = at(table.vertices, table.vertex_count, corner[0]);
        const glm::dvec3 b = at(table.vertices, table.vertex_count, corner[1]);
        const glm::dvec3 c = at(table.vertices, table.vertex_count, corner[2]);
        for (int u = 0; u <= steps; ++u)
            for (int v = 0; u + v <= steps; ++v)
                look((a * double(steps - u - v) + b * double(u) + c * double(v)) / double(steps));
    }
    for (double& squared : most) squared = std::sqrt(squared);
    return most;
}

}  // namespace tests
