// How open a piece of a long structure lies to the light that comes from everywhere. Internal to scene.
//
// Stands are a section swept along a line that is hardly bent, so that this is a question about the section alone: of
// what a surface gets from all around, the share
//   (sin b - sin a) / 2
// comes from between the angles a and b to its normal (Hottel's crossed strings, 1954). The sun has no part in it.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace scene {

// A line of the section: x outward, y up [m]. What is behind it is hidden, whichever side one looks from.
struct SectionLine {
    glm::vec2 from, to;
    float stops = 1;  // of the light that meets it, (0, 1]: people stop less than all
};

// Of the light from around that a surface between two points would get in the open, how much it gets, [0, 1]: the mean
// over it. It faces the side that is to the left on the way from the one to the other. What hides the sky sends some
// light of its own; what is near sends less than what is far. Lines may begin or end at the surface, or be it.
// Costs 200 times the lines.
float openness(glm::vec2 from, glm::vec2 to, std::span<const SectionLine> lines);

}  // namespace scene
