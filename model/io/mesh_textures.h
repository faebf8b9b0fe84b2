// The textures of one mesh as its reader comes upon them. What can't be had is said, and the surface goes without it.
// Internal to the loaders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/io/file_finder.h"
#include "model/mesh.h"
#include "model/warnings.h"

namespace model {

// At most 255. All together have at most 2^26 texels, a side at most 16384: the largest are halved until they do.
class MeshTextures {
public:
    // Names are those of files in `folder` (file_finder.h).
    MeshTextures(const std::filesystem::path& folder, Warnings& warnings) : finder_(folder), warnings_(warnings) {}

    // The id of the texture in the file of this name, or no_texture. A file is read once.
    std::uint8_t of_file(std::string_view name);
    // Of an encoded image itself, called `name` in warnings: a new texture each time.
    std::uint8_t of_bytes(std::span<const unsigned char> bytes, std::string_view name);
    // Of what is already decoded, likewise.
    std::uint8_t add(Texture texture, std::string_view name);

    const Texture& operator[](std::uint8_t id) const { return textures_[id]; }

    std::vector<Texture> take() { return std::move(textures_); }

private:
    std::uint8_t left_out(const std::string& why, std::string_view name);
    std::uint8_t of_path(const std::filesystem::path& path, std::string_view name);
    void halve(std::size_t id);
    void fit();

    FileFinder finder_;
    Warnings& warnings_;
    std::map<std::string, std::uint8_t, std::less<>> id_of_name_, id_of_path_;
    std::vector<Texture> textures_;
    std::vector<std::string> names_;  // of those that are still whole, else empty
};

}  // namespace model
