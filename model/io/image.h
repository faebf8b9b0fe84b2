// Encoded images as textures. Internal to the loaders.
#pragma once

#include <span>
#include <stdexcept>

#include "model/mesh.h"

namespace model {

// Why an image can't be had: one of few texts, such as "is a TIFF" or "is damaged".
struct ImageError : std::runtime_error {
    using runtime_error::runtime_error;
};

// PNG, JPEG or WebP, and what else stb_image reads (TGA, BMP, GIF, PSD, PNM), by its bytes. Throws ImageError, also for
// one of over 2^28 texels, or of more than 2^26 whose few bytes hardly hold a picture of that size.
Texture decode_image(std::span<const unsigned char> bytes);

// Half as wide and high, at least 1 each: each texel the mean of four, in linear light.
Texture halved(const Texture& texture);

}  // namespace model
