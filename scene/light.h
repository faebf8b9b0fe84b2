// What lights a place, and the sky that is seen above it.
#pragma once

#include <glm/glm.hpp>

namespace scene {

// A clear afternoon, unless a place says otherwise. Light is linear, chosen so that a white shirt in the sun stays just
// below white.
struct Light {
    glm::vec3 to_sun = glm::normalize(glm::vec3(0.45f, 0.72f, 0.38f));  // unit, world
    glm::vec3 sun{0.72f, 0.66f, 0.55f};                                 // on what faces the sun
    glm::vec3 from_above{0.32f, 0.37f, 0.45f};
    glm::vec3 from_below{0.14f, 0.14f, 0.12f};

    // The sky's colours, sRGB.
    glm::vec3 haze{0.62f, 0.76f, 0.88f};  // at the horizon
    glm::vec3 zenith{0.13f, 0.31f, 0.63f};
    glm::vec3 glare{1.0f, 0.93f, 0.75f};  // of the sun and around it; black: no sun is seen
};

}  // namespace scene
