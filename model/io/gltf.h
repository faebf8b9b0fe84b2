// glTF 2.0 / GLB files into characters. The one place that knows tinygltf (with gltf_*, its parts).
#pragma once

#include <filesystem>

#include "model/character.h"

namespace model {

// All triangles of the file's default scene, and all clips.
// - Read: parts, skins, rigid parts on nodes, morph targets, base colour factors and textures. Alpha means nothing.
// - Strips and fans become triangles. Missing normals are computed, weighted by area.
// - Skinned vertices ignore their node's transform, as glTF 2.0 says. Units and axes stay the file's (y up).
// - Refused: required extensions, but for KHR_texture_transform, KHR_materials_unlit and KHR_mesh_quantization.
// - Memory is bounded by the file's size and a few hundred megabytes: at most 2 GiB of buffers, 2^26 texels, and a
//   million vertices, indices and keys more than there are bytes of buffer.
// Throws std::runtime_error with one line: the file, what was found and what was expected.
Character load_gltf(const std::filesystem::path& path);

}  // namespace model
