// What a material says of the surface that wears it: the one place where samplers and drawers read it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace model {

inline constexpr std::uint8_t no_texture = 255;

// What a texture shows outside [0, 1].
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

// How a texture is read, in both directions; bilinear in linear light unless nearest.
struct Sampler {
    Wrap across = Wrap::repeat, down = Wrap::repeat;
    bool nearest = false;

    bool operator==(const Sampler&) const = default;
};

struct Material {
    std::uint8_t texture = no_texture;           // into Mesh::textures; multiplies the vertices' colours
    std::uint8_t emissive_texture = no_texture;  // multiplies `emissive`; read by the same coordinates and sampler
    Sampler sampler;
    glm::vec3 emissive{0.0f};   // linear light, >= 0, that the surface gives in any light and shade
    float alpha_cutoff = 0;     // where alpha of vertex x texture is less there is no surface; 0: there is everywhere
    bool unlit = false;         // its colour is what is seen, in any light and shade
    bool double_sided = false;  // open surfaces, seen from behind too

    bool operator==(const Material&) const = default;
};

}  // namespace model
