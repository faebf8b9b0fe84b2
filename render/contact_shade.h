// What holds people to the ground: around their feet little light gets to what they stand on.
//
// At a distance d [m] from a person's feet, of a colour as it is stored (the square root of light)
//   1 - strength * max(1 - d^2 / radius^2, 0)^2
// is left, and of several people the product. It is a function of where one looks in the world and of nothing else, so
// that all ways of drawing agree on it, and it darkens structure and ground alone: not people, nor the sky. A step that
// is higher than the radius has none of it. Who is far loses it before it is too small to be seen.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/frame.h"

namespace render {

inline constexpr float contact_reach = 0.27f;     // the radius, of the person's height
inline constexpr float contact_strength = 0.55f;  // where they stand
// [px] Radii from where on it is as strong as that, and below which there is none.
inline constexpr float contact_whole_px = 4.0f, contact_least_px = 1.5f;

// One person's; shaders/contact.glsl's numbers.
struct ContactShade {
    glm::vec3 feet;  // [m] camera-relative
    float radius;    // [m] > 0
    float peak;      // the square root of the strength, (0, 1)
    float fall;      // [1/m^2] peak / radius^2
};

// Of whom in the frame it can be seen, in their order; `out` keeps its memory.
void find_contact_shades(const Frame& frame, std::vector<ContactShade>& out);

}  // namespace render
