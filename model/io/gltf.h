// glTF 2.0 / GLB files into characters. The one place that knows tinygltf (with gltf_*, its parts).
#pragma once

#include <filesystem>

#include "model/character.h"

namespace model {

// Every triangle of the file's default scene: several parts, skins, rigid parts on nodes, morph targets, base colour
// factors and textures, all clips. Strips and fans become triangles; missing normals are computed (area-weighted);
// skinned vertices ignore their node's transform, as glTF 2.0 says. Units and axes stay the file's (y up).
// Required extensions other than KHR_texture_transform, KHR_materials_unlit and KHR_mesh_quantization are refused;
// alpha is kept but means nothing. Memory is bounded by the file's own size and a few hundred megabytes: at most 2 GiB
// of buffers, 2^26 texels, and a million vertices, indices and keys beyond one for every byte of buffer. Throws
// std::runtime_error with one line naming the file, what was found and what was expected.
Character load_gltf(const std::filesystem::path& path);

}  // namespace model
