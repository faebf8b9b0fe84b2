#include "model/io/image.h"

#include <stb_image.h>
#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "model/srgb.h"

namespace model {
namespace {

// Decoded it is four bytes a texel. Before decoding: a few hundred bytes can claim any size.
constexpr std::size_t most_texels = std::size_t{1} << 28;
constexpr std::size_t most_unproven_texels = std::size_t{1} << 26;
constexpr std::size_t most_texels_a_byte = 1024;  // deflate's best

void check_size(std::size_t width, std::size_t height, std::size_t bytes) {
    if (width == 0 || height == 0) throw ImageError("has no texels");
    if (width > most_texels / height) throw ImageError("has over 2^28 texels");
    const std::size_t texels = width * height;
    if (texels > most_unproven_texels && texels / most_texels_a_byte > bytes)
        throw ImageError("claims more texels than its bytes hold");
}

bool begins_with(std::span<const unsigned char> bytes, std::string_view magic, std::size_t at = 0) {
    return bytes.size() >= at + magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

// Formats that people have and that are not read, by their first bytes.
const char* name_of_unread(std::span<const unsigned char> bytes) {
    using namespace std::string_view_literals;
    static constexpr std::array<std::pair<std::string_view, const char*>, 7> magics{
        {{"II*\0"sv, "is a TIFF"},
         {"MM\0*"sv, "is a TIFF"},
         {"\xABKTX 20"sv, "is a KTX2"},
         {"\xABKTX 11"sv, "is a KTX"},
         {"DDS "sv, "is a DDS"},
         {"\x76\x2f\x31\x01"sv, "is an EXR"},
         {"\0\0\0\x0cjP  "sv, "is a JPEG 2000"}}};
    for (const auto& [magic, name] : magics)
        if (begins_with(bytes, magic)) return name;
    return nullptr;
}

// A chunk of a PNG that its file has not all of: stb_image would ask for as much memory as the chunk claims.
bool has_cut_chunk(std::span<const unsigned char> bytes) {
    using namespace std::string_view_literals;
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n"sv;
    constexpr std::size_t head = 8, checksum = 4;  // [bytes] before a chunk's data and behind
    if (!begins_with(bytes, signature)) return false;
    std::size_t at = signature.size();
    while (bytes.size() - at >= head && !begins_with(bytes, "IEND", at + 4)) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | bytes[at + i];
        if (length > bytes.size() - at - head) return true;
        at = std::min(at + head + length + checksum, bytes.size());
    }
    return false;
}

using Pixels = std::unique_ptr<unsigned char, void (*)(void*)>;

Pixels decode_webp(std::span<const unsigned char> bytes, int& width, int& height) {
    if (!WebPGetInfo(bytes.data(), bytes.size(), &width, &height)) throw ImageError("is damaged");
    check_size(static_cast<std::size_t>(width), static_cast<std::size_t>(height), bytes.size());
    return {WebPDecodeRGBA(bytes.data(), bytes.size(), &width, &height), WebPFree};
}

Pixels decode_others(std::span<const unsigned char> bytes, int& width, int& height) {
    if (const char* name = name_of_unread(bytes)) throw ImageError(name);
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw ImageError("has over 2 GiB");
    const int size = static_cast<int>(bytes.size());
    int channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width < 0 || height < 0)
        throw ImageError("is in an unknown format");
    check_size(static_cast<std::size_t>(width), static_cast<std::size_t>(height), bytes.size());
    if (has_cut_chunk(bytes)) throw ImageError("is damaged");
    return {stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free};
}

}  // namespace

Texture decode_image(std::span<const unsigned char> bytes) {
    int width = 0, height = 0;
    const bool webp = begins_with(bytes, "RIFF") && begins_with(bytes, "WEBP", 8);
    const Pixels pixels = webp ? decode_webp(bytes, width, height) : decode_others(bytes, width, height);
    if (!pixels) throw ImageError("is damaged");
    Texture texture{width, height, {}};
    texture.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
        const unsigned char* texel = pixels.get() + 4 * i;
        texture.texels[i] = {texel[0], texel[1], texel[2], texel[3]};
    }
    return texture;
}

Texture halved(const Texture& texture) {
    Texture half{std::max(texture.width / 2, 1), std::max(texture.height / 2, 1), {}};
    half.texels.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    const auto at = [&](int x, int y) {
        const auto column = static_cast<std::size_t>(std::min(x, texture.width - 1));
        const auto row = static_cast<std::size_t>(std::min(y, texture.height - 1));
        return texture.texels[row * static_cast<std::size_t>(texture.width) + column];
    };
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            glm::vec4 sum(0.0f);
            for (const glm::u8vec4& texel :
                 {at(2 * x, 2 * y), at(2 * x + 1, 2 * y), at(2 * x, 2 * y + 1), at(2 * x + 1, 2 * y + 1)})
                sum += glm::vec4(linear_of_srgb(texel.r), linear_of_srgb(texel.g), linear_of_srgb(texel.b),
                                 static_cast<float>(texel.a) / 255.0f);
            sum /= 4.0f;
            half.texels.emplace_back(srgb_of_linear(sum.r), srgb_of_linear(sum.g), srgb_of_linear(sum.b),
                                     unit_byte(sum.a));
        }
    }
    return half;
}

}  // namespace model
