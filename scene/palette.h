// The colours that tell people of one character apart.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "model/slot.h"

namespace scene {

struct Palette {
    std::array<glm::u8vec4, model::slot_count> colors{};  // sRGB; of slots 1 to slot_count

    // `slot`: any but no_slot.
    glm::u8vec4& operator[](model::Slot slot) { return colors[std::size_t{slot} - 1]; }
    const glm::u8vec4& operator[](model::Slot slot) const { return colors[std::size_t{slot} - 1]; }
};

}  // namespace scene
