#include "tests/bench/frame_change.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/bench/fidelity.h"
#include "tests/bench/shooter.h"

namespace bench {

namespace {

constexpr int width = 640, height = 360;  // [px]
constexpr std::int64_t first_tick = 100;

struct Shots {
    render::Image reference, triangles, native[std::size(change_splat_sizes)];
};

Shots shoot(Shooting& here, Present present, const scene::CameraPose& pose, std::int64_t tick) {
    const bool empty = present == Present::nobody;
    Shooter& gl = empty ? here.gl_nobody : here.gl;
    Shooter& native = empty ? here.native_nobody : here.native;
    const render::View view = render::make_view(pose, width, height);
    Shots shots{reference(gl, pose, width, height, tick), gl.picture(view, triangles(), tick), {}};
    for (std::size_t i = 0; i < std::size(change_splat_sizes); ++i)
        shots.native[i] = native.picture(view, points_of(change_splat_sizes[i]), tick);
    return shots;
}

Change follow(Shooting& here, Present present, int frames, const std::function<scene::CameraPose(int frame)>& camera) {
    Change change;
    Shots before;
    const double share = 1.0 / (frames - 1);
    for (int frame = 0; frame < frames; ++frame) {
        Shots now = shoot(here, present, camera(frame), first_tick + frame);
        if (frame > 0) {
            const auto off = [&](const render::Image& last, const render::Image& current) {
                return change_error(last, current, before.reference, now.reference);
            };
            change.reference += share * change_error(before.reference, now.reference, now.reference, now.reference);
            const double triangles = off(before.triangles, now.triangles);
            change.triangles += share * triangles;
            change.worst_triangles = std::max(change.worst_triangles, triangles);
            for (std::size_t i = 0; i < std::size(change_splat_sizes); ++i) {
                const double native = off(before.native[i], now.native[i]);
                change.native[i] += share * native;
                if (native <= change.worst[i]) continue;
                change.worst[i] = native;
                change.worst_frame[i] = frame;
            }
        }
        before = std::move(now);
    }
    return change;
}

// The middle of a picture, at its scale.
scene::CameraPose middle_of(scene::CameraPose pose) {
    pose.fov_y = 2 * std::atan(std::tan(0.5 * pose.fov_y) * height / frame_height);
    return pose;
}

constexpr int preset_frames = 8;

}  // namespace

Change change_backing(const std::string& name, Present present) {
    constexpr double step = 0.05;  // [m]
    const scene::CameraPose start = middle_of(preset(name));
    const glm::dvec3 ahead = glm::normalize(start.target - start.position);
    return follow(stadium(), present, preset_frames, [&](int frame) {
        scene::CameraPose pose = start;
        pose.position -= step * frame * ahead;
        return pose;
    });
}

Change change_panning(const std::string& name, Present present) {
    constexpr double step = 1.5;  // [px]
    const scene::CameraPose start = middle_of(preset(name));
    return follow(stadium(), present, preset_frames, [&](int frame) { return panned(start, step * frame, height); });
}

Change change_of_group() {
    constexpr std::uint32_t people = 48;
    constexpr int frames = 120;
    constexpr double tallest = 150, smallest = 15;  // [px]
    constexpr double fov = 0.9, person = 1.75, elevation = 0.15;
    const apps::Stage& stage = stadium().stage;
    const scene::CrowdBlock block = seated_block(stage.place.crowd);
    const scene::Crowd crowd = some_of(stage.place.crowd, block.first, std::min(people, block.count));
    Shooting here(stage, crowd, {}, {}, stage.place.light);
    glm::dvec3 middle(0), facing(0);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        middle += glm::dvec3(crowd.position[i]) / static_cast<double>(crowd.size());
        facing += glm::dvec3(std::sin(crowd.yaw[i]), 0, std::cos(crowd.yaw[i]));
    }
    const glm::dvec3 away = std::cos(elevation) * glm::normalize(facing) + std::sin(elevation) * glm::dvec3(0, 1, 0);
    return follow(here, Present::everybody, frames, [&](int frame) {
        const double pixels = tallest * std::pow(smallest / tallest, static_cast<double>(frame) / (frames - 1));
        scene::CameraPose pose;
        pose.target = middle;
        pose.position = middle + away * (0.5 * frame_height * person / (std::tan(0.5 * fov) * pixels));
        pose.fov_y = fov;
        return middle_of(pose);
    });
}

}  // namespace bench
