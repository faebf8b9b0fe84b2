// Pictures as WebP's own encoder writes them.
#pragma once

#include <webp/encode.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tests {

// Without loss, or with the loss of quality 50.
inline std::string make_webp(int width, int height, const std::vector<std::uint8_t>& rgba, bool lossless = true) {
    std::uint8_t* bytes = nullptr;
    const std::size_t size = lossless ? WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &bytes)
                                      : WebPEncodeRGBA(rgba.data(), width, height, 4 * width, 50, &bytes);
    const std::string webp(reinterpret_cast<const char*>(bytes), size);
    WebPFree(bytes);
    return webp;
}

}  // namespace tests
