// What a texture shows at a place: the one rule that points, and whatever draws, are to follow.
#pragma once

#include <glm/glm.hpp>

#include "model/mesh.h"

namespace model {

// The texel in [0, size) that number `texel` stands for, `texel` at most one beside [0, size).
inline int wrapped_texel(Wrap wrap, int texel, int size) {
    if (wrap == Wrap::repeat) return texel < 0 ? texel + size : texel >= size ? texel - size : texel;
    return texel < 0 ? 0 : texel >= size ? size - 1 : texel;
}

// In [0, 1], where the texture shows the same. What isn't finite is 0.
float wrapped(Wrap wrap, float coordinate);

// Linear red, green and blue, and alpha in [0, 1]. Between texels (or of the nearest, exactly) as the sampler says.
glm::vec4 texture_at(const Texture& texture, const Sampler& sampler, const glm::vec2& uv);

}  // namespace model
