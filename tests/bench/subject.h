// Whom the evidence about point models is of: a character in one pose, dressed.
#pragma once

#include <array>
#include <span>
#include <string>

#include "model/character.h"
#include "motion/pose.h"
#include "pointsample/sample.h"

namespace bench {

struct Subject {
    model::Character character;
    pointsample::PosedMesh pose;
    motion::Bounds bounds;                                     // of the pose: [character's units]
    std::array<glm::u8vec4, 1 + model::slot_count> palette{};  // by slot, no_slot white; sRGB-encoded

    float height() const { return bounds.size().y; }
};

// Of `arguments` = [FILE [CLIP SECONDS]]: a mesh file at rest, or at a time of the clip of that name. Without any, the
// built-in person, walking. Throws std::runtime_error, also for any other number of arguments.
Subject load_subject(std::span<const std::string> arguments);

}  // namespace bench
