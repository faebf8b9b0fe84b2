// How far on the screen people of a frame truly are from where they should be, and from what is drawn of them: vertex
// by vertex, in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "figures/splats.h"
#include "figures/way.h"
#include "render/frame.h"
#include "scene/crowd.h"
#include "tests/render/drawn_people.h"
#include "tests/render/true_errors.h"

namespace tests {

// [m] Some of a pose's vertices or points, camera-relative.
inline std::vector<glm::dvec3> placed(const std::vector<motion::PosedVertex>& all, int each, int count,
                                      const motion::PoseTable& poses, std::uint32_t pose,
                                      const render::Instance& instance) {
    const double s = instance.turn.sin_yaw / 32767.0, c = instance.turn.cos_yaw / 32767.0;
    std::vector<glm::dvec3> spots;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 at = position_of(all[std::size_t{pose} * static_cast<std::size_t>(each) + i], poses.box);
        spots.push_back(glm::dvec3(instance.position) + static_cast<double>(instance.scale) *
                                                            glm::dvec3(c * at.x + s * at.z, at.y, c * at.z - s * at.x));
    }
    return spots;
}

inline double depth_of(const render::View& view, const glm::dvec3& at) {
    return glm::dot(glm::dvec3(view.forward), at);
}

inline glm::dvec2 on_screen(const render::View& view, const glm::dvec3& at) {
    const double pixels = 0.5 * view.height / static_cast<double>(view.tan_half_y) / depth_of(view, at);
    return pixels * glm::dvec2(glm::dot(glm::dvec3(view.right), at), glm::dot(glm::dvec3(view.up), at));
}

// Whether it can be seen in the picture: beyond the near plane and between its sides.
inline bool in_picture(const render::View& view, const glm::dvec3& at) {
    if (depth_of(view, at) < static_cast<double>(render::near_plane)) return false;
    const glm::dvec2 spot = glm::abs(on_screen(view, at));
    return spot.x <= 0.5 * view.width && spot.y <= 0.5 * view.height;
}

// [px] At most.
struct Off {
    double motion_px = 0, splat_px = 0;
};

// Of every `stride`-th person. `exact`: everybody of that view and tick, with their numbers; `poses`: by character.
inline Off farthest_off(const render::Frame& frame, const render::Frame& exact,
                        const std::vector<std::uint32_t>& numbers, const scene::Crowd& crowd,
                        std::span<const motion::PoseTable> poses, const figures::Way& way, std::size_t stride) {
    Off off;
    for_each_drawn(frame, numbers, crowd, [&](std::size_t i, std::uint32_t number, const render::Person* alone) {
        if (i % stride != 0) return;
        const render::Person& right = exact.people[i];
        const motion::PoseTable& table = poses[right.character];
        const figures::SplatKeys keys = alone ? figures::SplatKeys{} : figures::splat_keys(table);
        const std::uint32_t pose =
            alone ? alone->pose : static_cast<std::uint32_t>(keys.poses[frame.far_people.keys[number]]);
        const render::Instance& instance = alone ? alone->instance : right.instance;
        const int count = table.vertex_count;
        const auto is = placed(table.vertices, count, count, table, right.pose, right.instance);
        const auto drawn = placed(table.vertices, count, count, table, pose, instance);
        const bool as_points = alone && !way.representations[alone->representation].is_mesh;
        const auto points = placed(table.points, table.point_count, as_points ? static_cast<int>(alone->count) : 0,
                                   table, pose, instance);
        for (std::size_t vertex = 0; vertex < is.size(); ++vertex) {
            if (!in_picture(frame.view, is[vertex]) || !in_picture(frame.view, drawn[vertex])) continue;
            const glm::dvec2 at = on_screen(frame.view, drawn[vertex]);
            off.motion_px = std::max(off.motion_px, glm::distance(on_screen(frame.view, is[vertex]), at));
            double least = std::numeric_limits<double>::infinity();
            for (const glm::dvec3& point : points)
                if (depth_of(frame.view, point) >= static_cast<double>(render::near_plane))
                    least = std::min(least, glm::distance(on_screen(frame.view, point), at));
            if (as_points) off.splat_px = std::max(off.splat_px, least);
        }
    });
    return off;
}

}  // namespace tests
