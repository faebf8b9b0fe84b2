// One person whom a test places, of a character that it makes: a crowd in which everything can be said in closed form.
#pragma once

#include <memory>
#include <vector>

#include "motion/pose_table.h"
#include "render/select.h"
#include "scene/crowd.h"
#include "scene/places/oval.h"
#include "tests/render/stiff_mesh.h"

namespace tests {

// A tall box, `half_width` to each side and 1.8 m tall, that goes up at `rise` [m/s] for half of its only clip and down
// for the other half. Its surface is cut into `cells` x `cells` squares a side.
inline model::Character make_lift(float half_width, float rise, double seconds, int cells) {
    model::Character lift;
    lift.name = "lift";
    model::Mesh& mesh = lift.mesh;
    mesh.materials.resize(1);
    const glm::vec3 half(half_width, 0.9f, half_width), center(0, 0.9f, 0);
    for (int face = 0; face < 6; ++face) {
        glm::vec3 normal(0), right(0);
        normal[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
        right[(face / 2 + 1) % 3] = 1;
        const glm::vec3 up = glm::cross(normal, right);
        const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const float u = 2 * static_cast<float>(i) / static_cast<float>(cells) - 1;
                const float v = 2 * static_cast<float>(j) / static_cast<float>(cells) - 1;
                add_vertex(mesh, center + half * (normal + u * right + v * up), normal);
                mesh.colors.back() = {200, 200, 200, 255};
            }
        }
        const auto row = static_cast<std::uint32_t>(cells + 1);
        for (std::uint32_t j = 0; j + 1 < row; ++j)
            for (std::uint32_t i = 0; i + 1 < row; ++i)
                for (const std::uint32_t corner : {0u, 1u, row + 1, 0u, row + 1, row})
                    mesh.indices.push_back(first + j * row + i + corner);
    }
    add_only_joint(lift);
    model::Channel rising{0, model::Path::translation, model::Interpolation::linear, {}, {}};
    const auto end = static_cast<float>(seconds);
    rising.times = {0, end / 2, end};
    rising.values = {0, 0, 0, 0, rise * end / 2, 0, 0, 0, 0};
    lift.clips.push_back({"rise", seconds, {rising}});
    return lift;
}

struct LonePeople {
    model::Character character;
    std::vector<scene::CastMember> cast;
    std::vector<motion::PoseTable> poses;
    scene::Crowd crowd;

    // Everybody of `of`, at `places` [m], facing +z; one block each. Who is made a walker goes around an oval.
    LonePeople(model::Character of, std::span<const glm::vec3> places, std::size_t point_count = 0)
        : character(std::move(of)) {
        std::vector<motion::SurfacePoint> surface;
        for (std::size_t i = 0; i < point_count; ++i)
            surface.push_back({static_cast<std::uint32_t>(i % character.mesh.triangle_count()), 0.3f, 0.3f});
        poses.push_back(motion::bake_poses(character, std::vector{0}, surface, std::size_t{1} << 28));
        scene::CastMember member;
        for (scene::Acts& acts : member.acts) acts.calm = {0};
        member.gait_speed[static_cast<int>(scene::Role::walker)] = 1.4f;
        cast.push_back(member);
        crowd.path = std::make_shared<scene::Oval>();
        for (const glm::vec3& place : places) {
            const auto number = static_cast<std::uint32_t>(crowd.size());
            const float scale = 1.8f / poses[0].rest_height;
            crowd.blocks.push_back({number, 1, {place + scale * poses[0].box.min, place + scale * poses[0].box.max}});
            crowd.position.push_back(place);
            crowd.yaw.push_back(0);
            crowd.height.push_back(1.8f);
            crowd.character.push_back(0);
            crowd.role.push_back(scene::Role::standing);
            crowd.around.push_back(0);
            crowd.hash.push_back(2654435761u * (number + 1));
            crowd.palette.emplace_back();
        }
    }

    std::vector<figures::Figure> figures() const { return {{&character.mesh, &poses[0], nullptr}}; }
};

}  // namespace tests
