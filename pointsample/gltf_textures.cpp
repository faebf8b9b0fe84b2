#include <stb_image.h>

#include <memory>

#include "pointsample/gltf_file.h"

namespace pointsample {
namespace {

constexpr int longest_side = 16384;                        // [texels]
constexpr std::size_t most_texels = std::size_t{1} << 26;  // over all of a file's textures: 256 MiB decoded

motion::Texture decode(std::span<const unsigned char> bytes, std::size_t& texels, int image) {
    const int size = static_cast<int>(bytes.size());
    const std::string name = "image " + std::to_string(image);
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width < 1 || height < 1)
        fail(name + " in an unknown format", "PNG or JPEG");
    // Before decoding: a few hundred bytes can claim any size.
    if (width > longest_side || height > longest_side)
        fail(name + " of " + std::to_string(width) + "x" + std::to_string(height), "at most 16384 a side");
    texels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (texels > most_texels) fail("more than " + std::to_string(most_texels) + " texels in all", "fewer");
    const std::unique_ptr<stbi_uc, void (*)(void*)> data(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!data) fail(name + " damaged (" + stbi_failure_reason() + ")", "a whole PNG or JPEG");
    motion::Texture texture{width, height, {}};
    texture.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
        const stbi_uc* texel = data.get() + 4 * i;
        texture.texels[i] = {texel[0], texel[1], texel[2], texel[3]};
    }
    return texture;
}

}  // namespace

TextureSet::TextureSet(const GltfFile& file, std::vector<motion::Texture>& textures)
    : file_(file), textures_(textures), id_of_image_(file.model.images.size(), motion::no_texture) {}

std::uint8_t TextureSet::id_of(int texture) {
    if (texture < 0) return motion::no_texture;
    if (static_cast<std::size_t>(texture) >= file_.model.textures.size())
        fail("texture " + std::to_string(texture), "one of " + std::to_string(file_.model.textures.size()));
    const int image = file_.model.textures[static_cast<std::size_t>(texture)].source;
    if (image < 0) return motion::no_texture;  // an extension's image format, with no fallback
    const std::span<const unsigned char> bytes = file_.image_bytes(image);
    std::uint8_t& id = id_of_image_[static_cast<std::size_t>(image)];
    if (id != motion::no_texture) return id;
    if (textures_.size() >= motion::no_texture) fail("more than 255 textures", "at most 255");
    textures_.push_back(decode(bytes, texels_, image));
    id = static_cast<std::uint8_t>(textures_.size() - 1);
    return id;
}

}  // namespace pointsample
