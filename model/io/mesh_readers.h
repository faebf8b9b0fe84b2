// The readers behind load_mesh. Internal to it.
#pragma once

#include <cstddef>
#include <filesystem>

#include "model/input_file.h"
#include "model/mesh.h"
#include "model/warnings.h"

namespace model {

// More corners or vertices than 2^31 are refused.
inline constexpr std::size_t most_corners = std::size_t{1} << 31;

// Of one face. What is cut into triangles takes a hundred bytes a corner.
inline constexpr std::size_t most_face_corners = std::size_t{1} << 19;
inline void check_face_corners(std::size_t count) {
    if (count > most_face_corners) fail("a face of over 2^19 corners", "fewer");
}

// Positions, unit normals, uvs, colours, materials, textures, indices. The rest is left empty.
// Throw what with_name takes.
Mesh read_obj(const std::filesystem::path& path, Warnings& warnings);
Mesh read_ply(const std::filesystem::path& path, Warnings& warnings);
Mesh read_stl(const std::filesystem::path& path, Warnings& warnings);
Mesh read_off(const std::filesystem::path& path, Warnings& warnings);

}  // namespace model
