// Materials of OBJ files: .mtl libraries and their textures. Internal to the OBJ reader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/io/mesh_textures.h"
#include "model/io/words.h"
#include "model/mesh.h"
#include "model/warnings.h"

namespace model {

// Kd and map_Kd of one material.
struct ObjLook {
    glm::u8vec3 color{255};  // sRGB-encoded
    std::uint8_t texture = no_texture;
};

class ObjMaterials {
public:
    // Names in the file are of files in `folder` (file_finder.h).
    ObjMaterials(const std::filesystem::path& folder, Warnings& warnings)
        : warnings_(warnings), finder_(folder), textures_(folder, warnings) {}

    // Reads the libraries that a line `mtllib NAMES` names. One that is missing, which is said, has no materials.
    void add_libraries(std::string_view names);

    // White without texture if there is no such material, which is said. A texture is decoded when it is first asked
    // for (mesh_textures.h).
    ObjLook look_of(std::string_view name);

    std::vector<Texture> take_textures() { return textures_.take(); }

private:
    struct Material {
        glm::vec3 diffuse{1.0f};  // sRGB-encoded, [0, 1]
        std::string map;
    };

    bool add_library(std::string_view name);
    void read_library(const std::filesystem::path& path);
    void read_diffuse(Words words, Material& material);

    Warnings& warnings_;
    FileFinder finder_;
    std::set<std::string> libraries_;
    std::map<std::string, Material, std::less<>> materials_;
    MeshTextures textures_;
};

}  // namespace model
