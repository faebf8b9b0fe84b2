// The readers behind load_mesh. Internal to it.
#pragma once

#include <cstddef>
#include <filesystem>

#include "model/mesh.h"
#include "model/warnings.h"

namespace model {

// More corners or vertices than 2^31 are refused.
inline constexpr std::size_t most_corners = std::size_t{1} << 31;

// Positions, unit normals, colours, indices; of an OBJ also uvs, materials and textures. The rest is left empty.
// Throw what with_name takes.
Mesh read_obj(const std::filesystem::path& path, Warnings& warnings);
Mesh read_ply(const std::filesystem::path& path, Warnings& warnings);

}  // namespace model
