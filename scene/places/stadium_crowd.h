// What the parts of the stadium's crowd share. Internal to the stadium.
#pragma once

#include "scene/gathering.h"
#include "scene/places/stadium.h"

namespace scene {

// Crowd::around of somebody in the stands: from the start of the straight at +z, evenly along straights and nearly so
// in bends.
float lap_fraction(const Oval& oval, glm::vec3 position);

// Whose colours spectators at x, z wear.
Fans fans_at(const Oval& oval, glm::vec2 xz);

// Those who have no seat: on the pitch, from the middle outward, then around the stadium.
void add_standing(Gathering& gathering, const StadiumPlan& plan, std::int64_t wanted);

}  // namespace scene
