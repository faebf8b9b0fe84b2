// Puts a character of a file where the scene expects one: on its feet, over its place, as large as a person.
#pragma once

#include "model/character.h"
#include "scene/cast.h"

namespace scene {

// What somebody who is settled is scaled by [m]: PoseTable::rest_height, whatever pose comes first; their floor is 0.
inline constexpr float settled_height = 1.75f;

// Adds a node above all others that puts the character, in each clip that `casting` bakes, as the built-in person is:
// - settled_height tall, as high as it is for most of its standing clip; of who lies, as long;
// - the lowest point that it has for most of a clip on y = 0, the middle of what it covers of the ground over the
//   origin, turned by `turn` [degrees], counter-clockwise from above: 90 takes what faces -x to face +z;
// - where it goes on in a clip it stays, and that is the gait's speed; of who stays already, how fast feet go that
//   touch the ground. Where neither says anything the speed is the built-in person's. A walk faster than 2.2 m/s is
//   slowed down to that, in a clip of its own;
// - on a seat at y = seat_height if it sits, its back where the built-in person's is; where it stands while others sit,
//   before the seat.
// Adds the casting's stills too. Throws std::runtime_error if all of its body is in one place.
void settle(model::Character& character, Casting& casting, double turn = 0);

}  // namespace scene
