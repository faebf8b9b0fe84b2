// Meshes of any format people have: .glb, .gltf and .vrm (gltf.h), .obj, .ply, .stl and .off. By the file's extension, in
// any case; the latter four may be packed by gzip, and end in .gz then or not.
#pragma once

#include <filesystem>

#include "model/character.h"

namespace model {

//   OBJ   v (with vertex colours if there are any), vn, vt; f of any number of corners; s; usemtl with Kd and map_Kd out
//         of the mtllib. Anything else is skipped.
//   PLY   ascii, and binary of both byte orders: vertices with x y z, normals, colours (also as diffuse_red ...) and
//         texture coordinates (texture_u texture_v, s t or u v) if there are any; faces, with colours or texcoord lists
//         and texnumber, and tristrips. Textures are those of `comment TextureFile NAME`, and stand instead of colours.
//   STL   text, and binary with the colours that VisCAM and Magics write.
//   OFF   text; COFF, NOFF, STOFF and mixtures, colours on faces.
// Of all: a character of one node, without clips, seen from both sides.
// - Lines end in LF, CR LF or CR.
// - Polygons are cut into triangles, concave ones and bridged holes too (triangulate.h). Faces of fewer than three
//   corners are dropped, and vertices of no face.
// - Missing normals are computed, weighted by area, also across the seams of looks; not across the smoothing groups of
//   an OBJ. Faces after `s off`, and facets of an STL, are flat.
// - Coordinates are read in double, and kept relative to Mesh::origin where the mesh is far from 0 (origin.h).
// - What can't be had and what is no number, positions of faces aside, is left out and said in Character::warnings:
//   materials, textures (mesh_textures.h), normals, texture coordinates, colours.
// - Memory is bounded by the file's size: about 120 bytes a vertex and 25 a triangle (an OBJ of 1.1 GB: 0.6 GB). What is
//   packed may unfold to 16 MiB and a hundred times its size.
// Throws std::runtime_error with one line: the path, the line or element, what was found and what was expected. So it
// does for a face at a place that is not finite, one of over 2^19 corners, and a file without triangles or with over 2^31
// corners.
Character load_mesh(const std::filesystem::path& path);

}  // namespace model
