// Small whole files with much of their formats in them, from which damaged ones are made.
#pragma once

#include <string>

#include "tests/model/mesh_text.h"

namespace tests {

// Its materials a and b are those of looks.mtl.
inline std::string whole_obj() {
    PlainMesh cube = make_cube();
    cube.normals = cube.positions;
    return "mtllib looks.mtl\nvt 0 0\nvt 1 1\n" + obj_of(cube) +
           "usemtl a\nf 1/1/1 2/2/2 3/1 4//4\nf -1 -2 -3\nusemtl b\nf 1/1 2/2 \\\n 3/1\n";
}

// All that a PLY can have at once.
inline std::string full_ply() {
    return "ply\nformat ascii 1.0\ncomment TextureFile a.png\nobj_info none\nelement vertex 6\nproperty float x\n"
           "property float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
           "property float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\n"
           "property list uchar float texcoord\nproperty int texnumber\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
           "2 0 0 0 0 1 0 0\n2 1 0 0 0 1 0 1\n1 1 0 0 0 1 1 1\n1 2 0 0 0 1 1 0\n0 2 0 0 nan 1 0 0\n0 0 0 0 0 1 0 0\n"
           "6 0 1 2 3 4 5 12 0 0 1 0 1 1 0 1 0 0 1 1 0 255 0 0\n3 0 1 2 6 0 0 1 0 1 1 0 0 0 255\n"
           "7 0 1 2 3 -1 4 5\n";
}

inline std::string whole_off() {
    return "COFF\n5 4 0\n# a comment\n0 0 0 255 0 0 255\n2 0 0 0 255 0 255\n2 2 0 0 0 255 255\n1 0.5 0 0.1 0.2 0.3\n"
           "0 2 0 9 9 9\n5 0 1 2 3 4\n3 0 1 2 255 0 0\n4 0 1 2 4 0.5 0.5 0.5 1\n3 2 1 0 3\n";
}

inline std::string binary_stl() {
    std::string bytes = "made by a test COLOR=rgba";
    bytes.resize(80, ' ');
    bytes += std::string("\x03\0\0\0", 4);
    for (int i = 0; i < 3; ++i) {
        const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(i)};
        bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
        bytes.append("\x1f\x80", 2);
    }
    return bytes;
}

inline std::string text_stl() {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    return "solid a\n" + facet + facet + "endsolid a\n";
}

}  // namespace tests
