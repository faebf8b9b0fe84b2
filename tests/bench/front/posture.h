// Where somebody's surface is drawn.
#pragma once

#include "motion/pose_table.h"
#include "render/frame.h"

namespace bench::front {

struct Posture {
    glm::vec3 position;  // [m] camera-relative
    float scale;
    render::Turn turn;
    std::uint32_t pose;

    static Posture of(const render::Person& person) {
        return {person.instance.position, person.instance.scale, person.instance.turn, person.pose};
    }
    bool is(const Posture& other) const {
        return position == other.position && scale == other.scale && turn.sin_yaw == other.turn.sin_yaw &&
               turn.cos_yaw == other.turn.cos_yaw && pose == other.pose;
    }
    glm::vec3 at(const motion::PoseTable& poses, int vertex) const {
        const std::size_t index = std::size_t{pose} * poses.vertex_count + vertex;
        const glm::vec3 model = motion::unpack_position(poses.vertices[index], poses.box);
        const float s = static_cast<float>(turn.sin_yaw) / 32767, c = static_cast<float>(turn.cos_yaw) / 32767;
        return position + scale * glm::vec3(c * model.x + s * model.z, model.y, c * model.z - s * model.x);
    }
};

}  // namespace bench::front
