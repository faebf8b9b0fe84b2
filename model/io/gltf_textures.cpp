#include <stdexcept>
#include <utility>

#include "model/io/data_uri.h"
#include "model/io/gltf_file.h"
#include "model/io/uv_map.h"

namespace model {
namespace {

Wrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

// WebP where there is some, as its plain source is a fallback for others.
int image_of(const tinygltf::Texture& texture) {
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp != texture.extensions.end() && webp->second.Has("source") && webp->second.Get("source").IsInt())
        return webp->second.Get("source").GetNumberAsInt();
    return texture.source;
}

std::string name_of(const tinygltf::Image& image, int index) {
    return image.name.empty() ? "image " + std::to_string(index) : image.name;
}

}  // namespace

TextureSet::TextureSet(const GltfFile& file, Warnings& warnings)
    : file_(file), warnings_(warnings), textures_(file.folder, warnings) {}

std::uint8_t TextureSet::id_of(int texture) {
    if (texture < 0) return no_texture;
    if (static_cast<std::size_t>(texture) >= file_.model.textures.size()) {
        warnings_.add("texture that doesn't exist, left out", "texture " + std::to_string(texture));
        return no_texture;
    }
    const tinygltf::Texture& found = file_.model.textures[static_cast<std::size_t>(texture)];
    const int image = image_of(found);
    if (image < 0 || static_cast<std::size_t>(image) >= file_.model.images.size()) {
        warnings_.add(
            "texture of an unknown format or without an image, left out",
            found.extensions.empty() ? "texture " + std::to_string(texture) : found.extensions.begin()->first);
        return no_texture;
    }
    const auto [at, added] = id_of_image_.try_emplace(image, no_texture);
    if (added) at->second = decode(image);
    return at->second;
}

std::uint8_t TextureSet::decode(int index) {
    const tinygltf::Image& image = file_.model.images[static_cast<std::size_t>(index)];
    const std::string name = name_of(image, index);
    try {
        if (image.bufferView >= 0) return textures_.of_bytes(bytes_of_view(file_, image.bufferView, name), name);
        if (is_data_uri(image.uri)) return textures_.of_bytes(data_of_uri(image.uri), name);
    } catch (const std::runtime_error&) {
        warnings_.add("texture whose bytes aren't in the file, left out", name);
        return no_texture;
    }
    return textures_.of_file(percent_decoded(image.uri));
}

std::uint8_t TextureSet::resampled_id(std::uint8_t id, const Sampler& sampler, const glm::mat3& map) {
    constexpr std::size_t most_texels = std::size_t{1} << 24;  // of all, for what it takes: a second
    const auto is_alike = [&](const glm::mat3& other) {
        const glm::mat3 off = other - map;
        return glm::dot(off[0], off[0]) + glm::dot(off[1], off[1]) + glm::dot(off[2], off[2]) < 1e-8f;
    };
    if (is_alike(glm::mat3(1.0f))) return id;
    for (const Resampled& other : resampled_)
        if (other.from == id && other.sampler == sampler && is_alike(other.map)) return other.id;
    if (id == no_texture || resampled_texels_ > most_texels) return no_texture;
    Texture texture = resampled(textures_[id], sampler, map);
    resampled_texels_ += texture.texels.size();
    resampled_.push_back({id, textures_.add(std::move(texture), "a resampled one"), sampler, map});
    return resampled_.back().id;
}

Sampler TextureSet::sampler_of(int texture) const {
    if (texture < 0 || static_cast<std::size_t>(texture) >= file_.model.textures.size()) return {};
    const int index = file_.model.textures[static_cast<std::size_t>(texture)].sampler;
    if (index < 0 || static_cast<std::size_t>(index) >= file_.model.samplers.size()) return {};
    const tinygltf::Sampler& sampler = file_.model.samplers[static_cast<std::size_t>(index)];
    return {wrap_of(sampler.wrapS), wrap_of(sampler.wrapT), sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST};
}

}  // namespace model
