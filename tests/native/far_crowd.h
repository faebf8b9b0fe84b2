// Crowds that tests place person by person, to be drawn block by block (render/native/far_people.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "figures/splats.h"
#include "pointsample/sample.h"
#include "render/frame.h"
#include "scene/cast.h"
#include "scene/light.h"
#include "scene/person.h"

namespace tests {

// Daylight before a black sky.
inline scene::Light before_black() {
    scene::Light light;
    light.glare = light.haze = light.zenith = glm::vec3(0);
    return light;
}

// The same from everywhere.
inline scene::Light even_before_black() {
    scene::Light light = before_black();
    light.sun = glm::vec3(0);
    light.from_above = light.from_below = glm::vec3(1);
    return light;
}

// The built-in person, as a figure.
struct FarFigure {
    model::Character character = scene::make_person();
    pointsample::PointModel points;
    motion::PoseTable poses;
    figures::SplatKeys keys;

    // `color`: of all of them, and no own colours of people's; null: as they are.
    explicit FarFigure(std::span<const int> clips, const glm::u8vec4* color = nullptr) {
        if (color) {
            std::ranges::fill(character.mesh.colors, *color);
            std::ranges::fill(character.mesh.slots, model::no_slot);
        }
        pointsample::SampleOptions options;
        options.count = 2000;
        points = pointsample::sample(character.mesh, pointsample::spread_poses(character, {}, 1), options);
        poses = motion::bake_poses(character, clips, points.surface, std::size_t{1} << 26);
        keys = figures::splat_keys(poses);
    }
    FarFigure(const FarFigure&) = delete;
    FarFigure& operator=(const FarFigure&) = delete;

    figures::Figure figure() const { return {&character.mesh, &poses, &points}; }
    // As tall as in the mesh: one metre is one model unit.
    float height() const { return poses.rest_height; }
};

struct FarPerson {
    glm::vec3 at{0.0f};  // [m] of the model's origin
    float yaw = 0;       // [rad]
    float height = 1.75f;
    std::uint8_t character = 0, key = 0;
    scene::Palette palette{};
    scene::Role role = scene::Role::spectator;
};

// Must stay where it is while frames of it are drawn.
struct FarGathering {
    scene::Crowd crowd;
    std::vector<render::Turn> turns;
    std::vector<std::uint8_t> keys;
    std::span<const figures::Figure> figures;

    explicit FarGathering(std::span<const figures::Figure> of) : figures(of) {}
    FarGathering(const FarGathering&) = delete;
    FarGathering& operator=(const FarGathering&) = delete;

    void add_block(std::span<const FarPerson> people) {
        scene::CrowdBlock block{static_cast<std::uint32_t>(crowd.size()),
                                static_cast<std::uint32_t>(people.size()),
                                {glm::vec3(INFINITY), glm::vec3(-INFINITY)}};
        for (const FarPerson& person : people) {
            const motion::PoseTable& poses = *figures[person.character].poses;
            const float scale = person.height / poses.rest_height;
            const glm::vec3 reach = glm::max(glm::abs(poses.box.min), glm::abs(poses.box.max));
            const float around = std::hypot(reach.x, reach.z);
            block.box.min = glm::min(block.box.min, person.at + scale * glm::vec3(-around, poses.box.min.y, -around));
            block.box.max = glm::max(block.box.max, person.at + scale * glm::vec3(around, poses.box.max.y, around));
            crowd.position.push_back(person.at);
            crowd.yaw.push_back(person.yaw);
            crowd.height.push_back(person.height);
            crowd.character.push_back(person.character);
            crowd.role.push_back(person.role);
            crowd.around.push_back(0);
            crowd.hash.push_back(2654435761u * static_cast<std::uint32_t>(crowd.size()));
            crowd.palette.push_back(person.palette);
            const auto snorm = [](float value) { return static_cast<std::int16_t>(std::lround(value * 32767.0f)); };
            turns.push_back({snorm(std::sin(person.yaw)), snorm(std::cos(person.yaw))});
            keys.push_back(person.key);
        }
        crowd.blocks.push_back(block);
    }

    // So many people whom no test draws, that the crowd is large enough.
    void add_others(std::size_t count = render::fewest_far_people) { add_block(std::vector<FarPerson>(count)); }

    render::FarBlock far_block(const render::View& view, std::size_t block, std::int64_t tick = 0) const {
        const glm::vec3 middle = view.relative(crowd.blocks[block].box.center());
        return {static_cast<std::uint32_t>(block), std::max(view.depth(middle), render::near_plane), tick};
    }

    // Only these blocks.
    render::Frame frame(const render::View& view, std::span<const std::size_t> blocks, double splat_size = 1) const {
        render::Frame frame;
        frame.view = view;
        frame.splat_size = splat_size;
        for (const std::size_t block : blocks) frame.far_blocks.push_back(far_block(view, block));
        frame.far_people = {&crowd, turns.data(), keys.data()};
        return frame;
    }
};

}  // namespace tests
