// Encoded images as textures. Internal to the loaders.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "model/mesh.h"

namespace model {

// PNG or JPEG, by its bytes. `texels` counts those of all of a file's textures, to at most 2^26. Throws
// std::runtime_error, which names the image `name`, also if a side is over 16384.
Texture decode_image(std::span<const unsigned char> bytes, std::size_t& texels, const std::string& name);

}  // namespace model
