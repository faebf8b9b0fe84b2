// What a surface shows in any light and shade: all of its colour, or light beside it. Of the unlit their emission is
// nothing; slots tint colours, and not what is emitted.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "model/mesh.h"

namespace model {

inline bool emits(const Material& material) {
    return !material.unlit && material.emissive != glm::vec3(0);
}
inline bool has_own_light(const Material& material) {
    return material.unlit || emits(material);
}
inline bool has_own_light(const Mesh& mesh) {
    return std::ranges::any_of(mesh.materials, [](const Material& material) { return has_own_light(material); });
}

// What a material emits, sRGB-encoded but not cut off at 1; nothing of the unlit.
glm::vec3 emission_of(const Material& material);

}  // namespace model
