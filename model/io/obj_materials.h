// Materials of OBJ files: .mtl libraries and their textures. Internal to the OBJ reader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"

namespace model {

// Kd and map_Kd of one material.
struct ObjLook {
    glm::u8vec3 color{255};  // sRGB-encoded
    std::uint8_t texture = no_texture;
};

class ObjMaterials {
public:
    // Names in the file are relative to `folder`.
    explicit ObjMaterials(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Reads the libraries that a line `mtllib NAMES` names. One that is missing has no materials.
    void add_libraries(std::string_view names);

    // White without texture if there is no such material, without texture if its file is missing. A texture is decoded
    // when it is first asked for. Throws std::runtime_error if it is damaged, or the 256th.
    ObjLook look_of(std::string_view name);

    std::vector<Texture> take_textures() { return std::move(textures_); }

private:
    struct Material {
        glm::vec3 diffuse{1.0f};  // sRGB-encoded, [0, 1]
        std::string map;
    };

    std::filesystem::path place_of(std::string_view name) const;
    bool add_library(std::string_view name);
    void read_library(const std::filesystem::path& path);
    std::uint8_t texture_of(const std::string& name);

    std::filesystem::path folder_;
    std::set<std::string> libraries_;
    std::map<std::string, Material, std::less<>> materials_;
    std::map<std::string, std::uint8_t> texture_ids_;
    std::vector<Texture> textures_;
    std::size_t texels_ = 0;
};

}  // namespace model
