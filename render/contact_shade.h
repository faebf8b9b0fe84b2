// What holds people to the ground: around their feet little light gets to what they stand on.
//
// At a distance d [m] from a person's feet, of a colour as it is stored (the square root of light)
//   1 - strength * max(1 - d^2 / radius^2, 0)^2
// is left, and of several people the product. It is a function of where one looks in the world and of nothing else, so
// that all ways of drawing agree on it, and it darkens structure and ground alone: not people, nor the sky. A step that
// is higher than the radius has none of it. Of who is far it is too small to be drawn as such: natively it becomes a
// black spot under them of as much light, by OpenGL it fades.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

#include "figures/way.h"
#include "render/frame.h"

namespace render {

inline constexpr float contact_reach = 0.27f;     // the radius, of the person's height
inline constexpr float contact_strength = 0.55f;  // where they stand
// [px] Radii from where on it is drawn round by round, as strong as that, and below which it isn't at all.
inline constexpr float contact_whole_px = 4.0f, contact_least_px = 1.5f;
// How much of it is drawn so, for a radius [px].
inline float contact_share(float pixels) {
    return std::clamp((pixels - contact_least_px) / (contact_whole_px - contact_least_px), 0.0f, 1.0f);
}
// The area, in squares of the radius, of a black disc that takes as much light: the integral over a circle of what the
// round takes, 1 - (1 - strength (1 - x)^2)^2 with x = d^2 / radius^2.
inline constexpr float contact_area =
    3.14159265f * (2.0f / 3.0f * contact_strength - 0.2f * contact_strength * contact_strength);

// One person's; shaders/contact.glsl's numbers.
struct ContactShade {
    glm::vec3 feet;  // [m] camera-relative
    float radius;    // [m] > 0
    float peak;      // the square root of the strength, (0, 1)
    float fall;      // [1/m^2] peak / radius^2
};

// Of whom in the frame it is drawn, in their order; `out` keeps its memory. Natively that of people who are triangles
// is drawn however small it is: they are what pictures are held to.
void find_contact_shades(const Frame& frame, const figures::Way& way, std::vector<ContactShade>& out);

}  // namespace render
