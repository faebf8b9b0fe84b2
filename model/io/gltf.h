// glTF 2.0 / GLB files into characters. The one place that knows tinygltf (with gltf_*, its parts).
#pragma once

#include <filesystem>

#include "model/character.h"

namespace model {

// All triangles of the file's default scene, and all clips.
// - Read: parts, skins, rigid parts on nodes, morph targets, and of materials: base colours, samplers, alpha, sides and
//   light of their own (KHR_materials_unlit, _emissive_strength, _pbrSpecularGlossiness, KHR_texture_transform).
// - Alpha MASK cuts out; BLEND does at one half, and is said. OPAQUE alpha means nothing.
// - Read compressed: EXT_meshopt_compression (KHR_meshopt_compression as far as it is the same),
//   KHR_draco_mesh_compression and quantised attributes (KHR_mesh_quantization). It may unfold to 16 MiB and a hundred bytes for every byte of the buffers.
// - Strips and fans become triangles. Without normals triangles are flat, and vertices between them part.
// - Skinned vertices ignore their node's transform, as glTF 2.0 says. Units and axes stay the file's (y up).
// - Left out and said (Character::warnings): textures that can't be had, clips that can't be played, channels that
//   move no node, extensions of clips, emissive textures that are read unlike the base colour's.
// - Refused by name: glTF 1.0, and required extensions that change the shape or can't be read. Those of looks and
//   lights alone are accepted.
// - Data URIs of any type; names in any case, with either slash, percent-encoded or not (file_finder.h). Buffers may be
//   longer than they say, and GLB may have chunks of others, or none but JSON.
// - Memory is bounded by the file's size and a few hundred megabytes: at most 2 GiB of buffers and as much unpacked,
//   2^26 texels, and a million vertices, indices and keys more than there are bytes of buffer.
// Throws std::runtime_error with one line: the file, what was found and what was expected.
Character load_gltf(const std::filesystem::path& path);

}  // namespace model
