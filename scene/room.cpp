#include "scene/room.h"

#include <algorithm>
#include <cstdint>

namespace scene {

Room room_for(std::span<const CastMember> cast, std::span<const motion::PoseTable> poses) {
    constexpr float height = 1.7f;                  // [m] of people on average
    constexpr float widest = 1.5f, deepest = 2.4f;  // [m] beyond, neighbours overlap: stands must stay stands
    Room room;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        if (cast[i].sits) continue;
        room.seats = false;
        const std::uint8_t clip = cast[i].acts[static_cast<int>(Role::spectator)].calm.front();
        const glm::vec3 size = height / poses[i].rest_height * poses[i].clip_boxes[clip].size();
        room.width = std::clamp(size.x, room.width, widest);
        room.depth = std::clamp(size.z, room.depth, deepest);
    }
    return room;
}

}  // namespace scene
