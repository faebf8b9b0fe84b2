// What the ground of a place looks like.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

namespace scene {

// [m] from the middle to the nearest edge: farther than the Earth's curvature lets anybody see from an aeroplane.
inline constexpr float ground_reach = 1'024'000;

struct Ground {
    std::string shader;  // a file of shaders/grounds/, which paints Surface::ground; none if nothing of a place is that
    std::array<glm::vec4, 2> parameters{};  // for that shader, whose file says what they mean
};

}  // namespace scene
