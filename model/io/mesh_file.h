// Meshes of any format people have: .glb and .gltf (gltf.h), .obj and .ply. By the file's extension, in any case.
#pragma once

#include <filesystem>

#include "model/character.h"

namespace model {

//   OBJ   v (with vertex colours if there are any), vn, vt; f of any number of corners; usemtl with Kd and map_Kd
//         (PNG or JPEG) out of the mtllib. Anything else is skipped. A missing material or texture is plain white.
//   PLY   ascii, and binary of both byte orders: vertices with x y z, normals and colours if there are any; faces
//         of any number of corners.
// Of both: a character of one node, without clips, seen from both sides.
// - Polygons become fans. Faces of fewer than three corners are dropped, and vertices of no face.
// - Missing normals are computed, weighted by area, also across the seams of an OBJ's looks.
// - Memory is bounded by the file's size: about 120 bytes a vertex and 25 a triangle (an OBJ of 1.1 GB: 0.6 GB).
// Throws std::runtime_error with one line: the path, the line or element, what was found and what was expected. So is a
// number that is not finite, and a file without triangles or with over 2^31 corners.
Character load_mesh(const std::filesystem::path& path);

}  // namespace model
