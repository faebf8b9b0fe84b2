// Slots: what a person colours for themselves. A vertex names one, a person has a colour for each, and the two are
// multiplied. Which slot is the shirt is for the character's maker to say (scene/person.h).
#pragma once

#include <cstdint>

namespace model {

using Slot = std::uint8_t;  // 1 to slot_count, or no_slot

inline constexpr Slot no_slot = 0;    // the vertex' own colour, whoever it is
inline constexpr int slot_count = 4;  // shaders/layout.h says it too

}  // namespace model
