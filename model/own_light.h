// What a surface shows in any light and shade: all of its colour, or light beside it.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "model/mesh.h"

namespace model {

inline bool has_own_light(const Material& material) {
    return material.unlit;
}
inline bool has_own_light(const Mesh& mesh) {
    return std::ranges::any_of(mesh.materials, [](const Material& material) { return has_own_light(material); });
}

}  // namespace model
