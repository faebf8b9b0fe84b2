// Pictures out of the renderer.
#pragma once

#include <cstdint>
#include <vector>

namespace render {

// Rows from the top, three bytes a pixel: sRGB.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;
};

// As a PNG file's bytes.
std::vector<std::uint8_t> encode_png(const Image& image);

}  // namespace render
