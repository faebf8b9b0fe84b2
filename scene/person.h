// The built-in person: a skinned humanoid made by code, the same everywhere.
#pragma once

#include "model/character.h"

namespace scene {

// A closed humanoid of just under 1,300 triangles and 19 joints: 1.75 m tall standing, feet at y = 0, facing +z.
// Its clips:
//   sit, clap, cheer, wave   4 s each, of spectators. All begin and end in one seated pose, so that any can follow any.
//                            The seat is at y = seat_height, the hips are over the origin, the feet 0.37 m before it:
//                            there "cheer" stands up.
//   stand                    4 s
//   walk, run                1 s and 0.7 s, on the spot: one cycle is two steps, at the speeds below.
// Shoes and eyes are in no slot.
model::Character make_person();

// What its slots are (model/slot.h).
inline constexpr model::Slot skin_slot = 1, hair_slot = 2, shirt_slot = 3, trousers_slot = 4;
static_assert(trousers_slot <= model::slot_count);

inline constexpr float seat_height = 0.45f;  // [m]
inline constexpr float walk_speed = 1.4f;    // [m/s] at 1.75 m: feet don't slide
inline constexpr float run_speed = 4.5f;     // [m/s]

}  // namespace scene
