#include "model/io/gltf_file.h"
#include "model/io/image.h"

namespace model {
TextureSet::TextureSet(const GltfFile& file, std::vector<Texture>& textures)
    : file_(file), textures_(textures), id_of_image_(file.model.images.size(), no_texture) {}

std::uint8_t TextureSet::id_of(int texture) {
    if (texture < 0) return no_texture;
    if (static_cast<std::size_t>(texture) >= file_.model.textures.size())
        fail("texture " + std::to_string(texture), "one of " + std::to_string(file_.model.textures.size()));
    const int image = file_.model.textures[static_cast<std::size_t>(texture)].source;
    if (image < 0) return no_texture;  // an extension's image format, with no fallback
    const std::span<const unsigned char> bytes = file_.image_bytes(image);
    std::uint8_t& id = id_of_image_[static_cast<std::size_t>(image)];
    if (id != no_texture) return id;
    if (textures_.size() >= no_texture) fail("more than 255 textures", "at most 255");
    textures_.push_back(decode_image(bytes, texels_, "image " + std::to_string(image)));
    id = static_cast<std::uint8_t>(textures_.size() - 1);
    return id;
}

}  // namespace model
