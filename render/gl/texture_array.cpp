#include "render/gl/texture_array.h"

#include <bit>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/texture_layers.h"
#include "shaders/layout.h"

namespace render::gl {

TextureObject make_texture_array(std::span<const model::Texture> textures) {
    if (textures.size() > no_layer)
        throw std::runtime_error("character: found " + std::to_string(textures.size()) +
                                 " textures, expected at most " + std::to_string(no_layer));
    const int size = layer_side(textures);
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
