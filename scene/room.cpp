#include "scene/room.h"

#include <algorithm>
#include <cstdint>

namespace scene {

Room room_for(std::span<const CastMember> cast, std::span<const motion::PoseTable> poses) {
    constexpr float height = 1.7f;                  // [m] of people on average
    constexpr float widest = 1.5f, deepest = 2.4f;  // [m] beyond, neighbours overlap: stands must stay stands
    constexpr float elbows = 0.9f, knees = 1.1f;    // [m] of people on seats, who don't mind
    Room room;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const std::uint8_t clip = cast[i].acts[static_cast<int>(Role::spectator)].calm.front();
        const glm::vec3 size = height / poses[i].rest_height * poses[i].clip_boxes[clip].size();
        if (!cast[i].sits)
            room.seats = false;
        else if (size.x < elbows && size.z < knees)
            continue;
        room.width = std::clamp(size.x, room.width, widest);
        room.depth = std::clamp(size.z, room.depth, deepest);
    }
    return room;
}

}  // namespace scene
