// What the ground of a place looks like.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

namespace scene {

struct Ground {
    std::string shader;  // a file of shaders/grounds/, which paints Surface::ground; none if nothing of a place is that
    std::array<glm::vec4, 2> parameters{};  // for that shader, whose file says what they mean
};

}  // namespace scene
