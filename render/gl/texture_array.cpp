#include "render/gl/texture_array.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>
#include <vector>

#include "shaders/layout.h"

namespace render::gl {

namespace {

// `texture` stretched to size x size by the mean of the texels under each new one (or the nearest, when it grows).
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

}  // namespace

TextureObject make_texture_array(std::span<const model::Texture> textures) {
    if (textures.size() > no_layer)
        throw std::runtime_error("character: found " + std::to_string(textures.size()) +
                                 " textures, expected at most " + std::to_string(no_layer));
    constexpr unsigned largest_side = 1024;
    unsigned side = 1;
    for (const model::Texture& texture : textures)
        side = std::max({side, static_cast<unsigned>(texture.width), static_cast<unsigned>(texture.height)});
    const int size = static_cast<int>(std::min(std::bit_ceil(side), largest_side));

    TextureObject array = TextureObject::create(GL_TEXTURE_2D_ARRAY);
    const int levels = std::bit_width(static_cast<unsigned>(size));
    glTextureStorage3D(array.name(), levels, GL_RGBA8, size, size, static_cast<GLsizei>(textures.size()));
    for (std::size_t layer = 0; layer < textures.size(); ++layer) {
        const std::vector<glm::u8vec4> texels = resample(textures[layer], size);
        glTextureSubImage3D(array.name(), 0, 0, 0, static_cast<GLint>(layer), size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            texels.data());
    }
    glGenerateTextureMipmap(array.name());
    glTextureParameteri(array.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTextureParameteri(array.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(array.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(array.name(), GL_TEXTURE_WRAP_T, GL_REPEAT);
    return array;
}

}  // namespace render::gl
