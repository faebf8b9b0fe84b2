// A mesh as PLY, STL and OFF have it: vertices with looks of their own, and faces that may have others. Internal to the
// loaders.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "model/io/positions.h"
#include "model/io/triangulate.h"
#include "model/io/vertex_splits.h"
#include "model/mesh.h"
#include "model/warnings.h"

namespace model {

class PolygonMesh {
public:
    enum class Looks {
        of_vertices,
        of_faces
    };  // the latter: faces have colours or uvs, and vertices are split for them

    explicit PolygonMesh(Looks looks) : looks_(looks) {}

    // One element a vertex. All but the positions may be empty instead, and none needs to be finite.
    Positions positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::u8vec4> colors;  // white where there is a texture
    std::uint8_t texture = no_texture;

    struct Face {
        std::span<const std::uint32_t> corners;  // below positions.size()
        std::optional<glm::u8vec4> color;        // instead of its vertices'
        std::span<const glm::vec2> uvs;          // one a corner, instead of its vertices'; or none
        std::uint8_t texture = no_texture;       // that these uvs are of
    };

    void reserve_corners(std::size_t of_triangles) { indices_.reserve(of_triangles); }

    // Any number of corners; fewer than three are no face. Throws std::runtime_error if a corner is at no finite place.
    void add_face(const Face& face);

    // Positions, normals, uvs, colours, materials, indices: of the vertices that faces use. Says what was no number.
    // The mesh's textures are for its reader to add.
    Mesh finish(Warnings& warnings);

private:
    struct Look {
        glm::vec2 uv;
        glm::u8vec4 color;
        std::uint8_t texture;

        bool operator==(const Look&) const = default;
    };

    Look look_of(std::uint32_t vertex) const;
    std::uint32_t vertex_of(const Face& face, std::size_t corner);
    std::vector<std::uint32_t> take_sources();
    void add_looks(const std::vector<std::uint32_t>& sources, Mesh& mesh, Warnings& warnings);
    void add_normals(const std::vector<std::uint32_t>& sources, Mesh& mesh, Warnings& warnings);

    Looks looks_;
    VertexSplits<Look> splits_;  // of faces' looks alone
    std::size_t places_ = 0;
    Triangulator triangulator_;
    std::vector<glm::dvec3> polygon_;
    std::vector<std::uint32_t> vertices_;
    std::vector<std::uint32_t> indices_;
};

}  // namespace model
