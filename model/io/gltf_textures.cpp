#include "model/io/gltf_file.h"

namespace model {

TextureSet::TextureSet(const GltfFile& file, Warnings& warnings) : file_(file), textures_({}, warnings) {}

std::uint8_t TextureSet::id_of(int texture) {
    if (texture < 0) return no_texture;
    if (static_cast<std::size_t>(texture) >= file_.model.textures.size())
        fail("texture " + std::to_string(texture), "one of " + std::to_string(file_.model.textures.size()));
    const int image = file_.model.textures[static_cast<std::size_t>(texture)].source;
    if (image < 0) return no_texture;  // an extension's image format, with no fallback
    const std::span<const unsigned char> bytes = file_.image_bytes(image);
    const auto [at, added] = id_of_image_.try_emplace(image, no_texture);
    if (added) at->second = textures_.of_bytes(bytes, "image " + std::to_string(image));
    return at->second;
}

}  // namespace model
