#include "render/texture_layers.h"

#include <algorithm>
#include <bit>

namespace render {

int layer_side(std::span<const model::Texture> textures) {
    constexpr unsigned largest_side = 1024;
    unsigned side = 1;
    for (const model::Texture& texture : textures)
        side = std::max({side, static_cast<unsigned>(texture.width), static_cast<unsigned>(texture.height)});
    return static_cast<int>(std::min(std::bit_ceil(side), largest_side));
}

std::vector<glm::u8vec4> resample(const model::Texture& texture, int size) {
    std::vector<glm::u8vec4> out(static_cast<std::size_t>(size) * size);
    for (int y = 0; y < size; ++y) {
        const int y0 = y * texture.height / size;
        const int y1 = std::max(y0 + 1, (y + 1) * texture.height / size);
        for (int x = 0; x < size; ++x) {
            const int x0 = x * texture.width / size;
            const int x1 = std::max(x0 + 1, (x + 1) * texture.width / size);
            glm::uvec4 sum(0);
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u) sum += glm::uvec4(texture.texels[v * texture.width + u]);
            out[y * size + x] = glm::u8vec4(sum / static_cast<unsigned>((y1 - y0) * (x1 - x0)));
        }
    }
    return out;
}

}  // namespace render
