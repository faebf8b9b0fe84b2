// Meshes of any format people have: .glb and .gltf (gltf.h), .obj and .ply. By the file's extension, in any case.
#pragma once

#include <filesystem>

#include "model/character.h"

namespace model {

// Wavefront OBJ: v (with vertex colours where there are any), vn, vt, f of any number of corners, usemtl with the
// material's Kd and map_Kd (PNG or JPEG) from mtllib; everything else is skipped, and a material or texture that is not
// there is plain white. PLY: ascii and binary of both byte orders; vertices with x y z, normals and colours where there
// are any, faces of any number of corners. Both: polygons become fans; faces of fewer than three corners and vertices
// of no face are dropped; missing normals are computed, area-weighted, across the seams of an OBJ's looks too; surfaces
// count as open. A character of one node, without clips. Memory is bounded by the file's own size: about 120 bytes a
// vertex and 25 a triangle (10 million triangles, an OBJ of 1.1 GB: 0.6 GB). Throws std::runtime_error: one line with
// the path, the line or element, what was found and what was expected; also for a number that is not finite, a file
// without triangles or with over 2^31 corners.
Character load_mesh(const std::filesystem::path& path);

}  // namespace model
