// A character's textures as the layers of one GL array, so that all its parts are one draw.
#pragma once

#include <span>

#include "model/mesh.h"
#include "render/gl/objects.h"

namespace render::gl {

// Layers are square powers of two with mipmaps, as large as the largest texture, at most 1024 texels; smaller ones are
// stretched. Throws std::runtime_error beyond 31 textures, which is what a vertex can name.
TextureObject make_texture_array(std::span<const model::Texture> textures);

}  // namespace render::gl
