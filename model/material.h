// What a material says of the surface that wears it: the one place where samplers and drawers read it.
#pragma once

#include <cstdint>

namespace model {

inline constexpr std::uint8_t no_texture = 255;

struct Material {
    std::uint8_t texture = no_texture;  // into Mesh::textures; multiplies the vertices' colours
    bool double_sided = false;          // open surfaces, seen from behind too

    bool operator==(const Material&) const = default;
};

}  // namespace model
