// What drawing a person's triangles needs of their mesh, beyond where its vertices are: made once a character.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "scene/palette.h"

namespace render::native {

// Square textures of one size, a power of two, with all their mipmaps. Four bytes a texel: sRGB, and alpha.
class TextureLayers {
public:
    TextureLayers() = default;
    explicit TextureLayers(std::span<const model::Texture> textures);

    int levels() const { return static_cast<int>(first_.size()); }
    int side(int level) const { return 1 << (levels() - 1 - level); }  // [texels]
    const std::uint32_t* texels(int layer, int level) const { return texels_.data() + layer * size_ + first_[level]; }

private:
    std::vector<std::uint32_t> texels_;
    std::vector<std::size_t> first_;  // of a level, within a layer
    std::size_t size_ = 0;            // [texels] of a layer with all levels
};

// A colour that vertices have, before the person's own is multiplied in.
struct Paint {
    glm::vec3 color;  // linear
    model::Slot slot;
};

inline constexpr std::uint8_t untextured = 255;

// What differs between triangles beyond their corners.
struct Texturing {
    std::uint8_t layer = untextured;
    model::Sampler sampler;
    float alpha_cutoff = 0;  // model::Material's
    // Light that is added, linear; times what a layer shows.
    glm::vec3 emission{0};
    std::uint8_t emissive_layer = untextured;

    bool operator==(const Texturing&) const = default;
};

struct Face {
    std::array<std::uint32_t, 3> corners;  // clockwise as seen from outside
    std::array<std::uint32_t, 3> paints;
    std::uint16_t texturing;  // into PersonMesh::texturings
    bool plain;               // of one paint, without texture
};

struct PersonMesh {
    const motion::PoseTable* poses;
    std::uint32_t vertex_count;
    bool double_sided;
    std::vector<Face> faces;
    std::array<std::vector<std::int32_t>, 3> corners;  // of faces; filled up with vertex 0 to whole groups
    std::vector<Paint> paints;                         // no two alike
    std::vector<std::uint32_t> unlit;                  // vertices whose colour is seen in any light and shade
    std::vector<glm::vec2> uvs;                        // one a vertex; none without textures
    std::vector<float> alphas;                         // [0, 1] one a vertex; none without cutouts
    std::vector<Texturing> texturings;                 // no two alike; the first is of nothing of it
    TextureLayers textures;

    explicit PersonMesh(const figures::Figure& figure);  // refers to the figure's poses

    // Lit vertices are followed by the same ones seen from behind; a vertex is so much farther on there. 0: there are
    // none.
    std::uint32_t behind() const;
};

}  // namespace render::native
