// A character's textures as layers of one size, as every way of drawing reads them. No device.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "model/mesh.h"

namespace render {

// [texels] The side that all layers get: a power of two in [1, 1024], as long as the longest side of any texture.
int layer_side(std::span<const model::Texture> textures);

// `texture` stretched to size x size by the mean of the texels under each new one (or the nearest, when it grows).
std::vector<glm::u8vec4> resample(const model::Texture& texture, int size);

}  // namespace render
