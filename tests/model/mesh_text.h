// Meshes as OBJ and PLY, written by the tests themselves, and what a mesh looks like from outside.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "motion/pose.h"

namespace tests {

// What is written: vertices of one index, triangles or larger faces.
struct PlainMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   // or none
    std::vector<glm::u8vec3> colors;  // or none
    std::vector<std::vector<std::uint32_t>> faces;
};

// The cube of side 2 about the origin, six squares facing outwards; each corner its own colour.
inline PlainMesh make_cube() {
    PlainMesh cube;
    for (std::uint32_t i = 0; i < 8; ++i) {
        cube.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        cube.colors.emplace_back(i & 1 ? 250 : 5, i & 2 ? 200 : 10, 30 * i);
    }
    cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return cube;
}

// A character as it stands at rest, its base colours without textures.
inline PlainMesh plain_of(const model::Character& character) {
    motion::Pose pose;
    PlainMesh plain;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, plain.positions, plain.normals);
    for (const glm::u8vec4& color : character.mesh.colors) plain.colors.emplace_back(color);
    const std::vector<std::uint32_t>& corners = character.mesh.indices;
    for (std::size_t i = 0; i < corners.size(); i += 3)
        plain.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return plain;
}

inline std::string obj_of(const PlainMesh& mesh) {
    std::ostringstream out;
    out << std::setprecision(9) << "# made by a test\n";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        out << "v " << p.x << ' ' << p.y << ' ' << p.z;
        if (!mesh.colors.empty())
            for (int k = 0; k < 3; ++k) out << ' ' << static_cast<float>(mesh.colors[i][k]) / 255.0f;
        out << '\n';
    }
    for (const glm::vec3& n : mesh.normals) out << "vn " << n.x << ' ' << n.y << ' ' << n.z << '\n';
    for (const std::vector<std::uint32_t>& face : mesh.faces) {
        out << 'f';
        for (const std::uint32_t corner : face) {
            out << ' ' << corner + 1;
            if (!mesh.normals.empty()) out << "//" << corner + 1;
        }
        out << '\n';
    }
    return out.str();
}

// How the numbers of a PLY are written, one after another.
class PlyValues {
public:
    explicit PlyValues(const std::string& format) : text_(format == "ascii"), swap_(format == "binary_big_endian") {
        out_ << std::setprecision(9);
    }

    template <typename Number>
    void put(Number number) {
        if (text_) {
            out_ << (first_ ? "" : " ") << +number;
            first_ = false;
            return;
        }
        std::array<char, sizeof number> bytes;
        std::memcpy(bytes.data(), &number, sizeof number);
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        out_.write(bytes.data(), sizeof number);
    }
    void end_record() {
        if (text_) out_ << '\n';
        first_ = true;
    }
    std::string str() const { return out_.str(); }

private:
    bool text_, swap_, first_ = true;
    std::ostringstream out_;
};

inline constexpr const char* ply_formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

inline std::string ply_of(const PlainMesh& mesh, const std::string& format) {
    std::ostringstream header;
    header << "ply\nformat " << format << " 1.0\ncomment made by a test\nelement vertex " << mesh.positions.size()
           << "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!mesh.normals.empty()) header << "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.colors.empty()) header << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    header << "element face " << mesh.faces.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    PlyValues values(format);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (int k = 0; k < 3; ++k) values.put(mesh.positions[i][k]);
        for (int k = 0; k < 3 && !mesh.normals.empty(); ++k) values.put(mesh.normals[i][k]);
        for (int k = 0; k < 3 && !mesh.colors.empty(); ++k) values.put(mesh.colors[i][k]);
        values.end_record();
    }
    for (const std::vector<std::uint32_t>& face : mesh.faces) {
        values.put(static_cast<std::uint8_t>(face.size()));
        for (const std::uint32_t corner : face) values.put(static_cast<std::int32_t>(corner));
        values.end_record();
    }
    return header.str() + values.str();
}

inline double area_of(const model::Mesh& mesh) {
    double twice = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                         c = mesh.positions[mesh.indices[i + 2]];
        twice += glm::length(glm::cross(b - a, c - a));
    }
    return twice / 2;
}

// What was said of a file's losses.
inline std::vector<std::string> texts(const model::Warnings& warnings) {
    std::vector<std::string> out;
    for (const model::Warning& warning : warnings) out.push_back(model::text_of(warning));
    return out;
}

}  // namespace tests
