#include "model/io/mesh_textures.h"

#include <algorithm>
#include <utility>

#include "model/input_file.h"
#include "model/io/image.h"

namespace model {
namespace {

constexpr std::size_t most_texels = std::size_t{1} << 26;  // 256 MiB
constexpr int longest_side = 16384;                        // [texels] what devices take
constexpr std::uint64_t most_image_bytes = std::uint64_t{1} << 30;

}  // namespace

std::uint8_t MeshTextures::of_file(std::string_view name) {
    if (const auto known = id_of_name_.find(name); known != id_of_name_.end()) return known->second;
    const std::filesystem::path path = finder_.find(name);
    const std::uint8_t id = path.empty() ? left_out("texture not found, left out", name) : of_path(path, name);
    id_of_name_.emplace(name, id);
    return id;
}

std::uint8_t MeshTextures::of_path(const std::filesystem::path& path, std::string_view name) {
    const std::string key = path.lexically_normal().string();
    if (const auto known = id_of_path_.find(key); known != id_of_path_.end()) return known->second;
    std::vector<unsigned char> bytes;
    try {
        bytes = read_file(path, "a texture", most_image_bytes);
    } catch (const std::runtime_error&) {
        return left_out("texture can't be opened, left out", name);
    }
    return id_of_path_.emplace(key, of_bytes(bytes, name)).first->second;
}

std::uint8_t MeshTextures::of_bytes(std::span<const unsigned char> bytes, std::string_view name) {
    try {
        return add(decode_image(bytes), name);
    } catch (const ImageError& error) {
        return left_out(std::string("texture ") + error.what() + ", left out", name);
    }
}

std::uint8_t MeshTextures::add(Texture texture, std::string_view name) {
    if (textures_.size() == no_texture) return left_out("texture beyond the 255th, left out", name);
    textures_.push_back(std::move(texture));
    names_.emplace_back(name);
    fit();
    return static_cast<std::uint8_t>(textures_.size() - 1);
}

std::uint8_t MeshTextures::left_out(const std::string& why, std::string_view name) {
    warnings_.add(why, name);
    return no_texture;
}

void MeshTextures::halve(std::size_t id) {
    textures_[id] = halved(textures_[id]);
    if (!names_[id].empty()) warnings_.add("texture too large, scaled down", names_[id]);
    names_[id].clear();
}

void MeshTextures::fit() {
    const Texture& newest = textures_.back();
    while (std::max(newest.width, newest.height) > longest_side) halve(textures_.size() - 1);
    while (true) {
        std::size_t all = 0, largest = 0;
        for (std::size_t i = 0; i < textures_.size(); ++i) {
            all += textures_[i].texels.size();
            if (textures_[i].texels.size() > textures_[largest].texels.size()) largest = i;
        }
        if (all <= most_texels) return;
        halve(largest);
    }
}

}  // namespace model
