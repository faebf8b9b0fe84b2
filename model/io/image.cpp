#include "model/io/image.h"

#include <stb_image.h>

#include <limits>
#include <memory>

#include "model/input_file.h"

namespace model {
namespace {

constexpr int longest_side = 16384;                        // [texels]
constexpr std::size_t most_texels = std::size_t{1} << 26;  // 256 MiB decoded

}  // namespace

Texture decode_image(std::span<const unsigned char> bytes, std::size_t& texels, const std::string& name) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        fail(name + " of " + std::to_string(bytes.size()) + " bytes", "less than 2 GiB");
    const int size = static_cast<int>(bytes.size());
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
    Texture texture{width, height, {}};
    texture.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
        const stbi_uc* texel = data.get() + 4 * i;
        texture.texels[i] = {texel[0], texel[1], texel[2], texel[3]};
    }
    return texture;
}

}  // namespace model
