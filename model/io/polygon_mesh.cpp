#include "model/io/polygon_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/input_file.h"
#include "model/io/materials.h"
#include "model/io/mesh_readers.h"
#include "model/io/normals.h"
#include "model/io/origin.h"

namespace model {

void PolygonMesh::add_face(const Face& face) {
    if (face.corners.size() < 3) return;
    polygon_.clear();
    vertices_.clear();
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const std::uint32_t vertex = face.corners[i];
        const glm::dvec3 position = positions[vertex];
        check_finite(position, vertex);
        polygon_.push_back(position);
        vertices_.push_back(looks_ == Looks::of_faces ? vertex_of(face, i) : vertex);
    }
    for (const auto& triangle : triangulator_.cut(polygon_)) {
        if (indices_.size() + 3 > most_corners) fail("more than 2^31 corners of triangles", "fewer");
        for (const std::uint32_t corner : triangle) indices_.push_back(vertices_[corner]);
    }
}

PolygonMesh::Look PolygonMesh::look_of(std::uint32_t vertex) const {
    Look look{uvs.empty() ? glm::vec2(0.0f) : uvs[vertex], glm::u8vec4(255), uvs.empty() ? no_texture : texture};
    if (look.texture == no_texture && !colors.empty()) look.color = colors[vertex];
    return look;
}

std::uint32_t PolygonMesh::vertex_of(const Face& face, std::size_t corner) {
    if (places_ < positions.size()) splits_.add_places(positions.size() - std::exchange(places_, positions.size()));
    if (splits_.vertices().size() >= most_corners) fail("more than 2^31 vertices", "fewer");
    Look look = look_of(face.corners[corner]);
    if (face.color && look.texture == no_texture) look.color = *face.color;
    if (!face.uvs.empty() && face.texture != no_texture) look = {face.uvs[corner], glm::u8vec4(255), face.texture};
    if (!std::isfinite(look.uv.x) || !std::isfinite(look.uv.y)) look.uv = glm::vec2(INFINITY);  // NaN is not itself
    return splits_.vertex_of(face.corners[corner], look);
}

// The file's vertex of each of the mesh's. Vertices of no triangle would count in the bounds.
std::vector<std::uint32_t> PolygonMesh::take_sources() {
    std::vector<std::uint32_t> sources;
    if (looks_ == Looks::of_faces) {
        sources.reserve(splits_.vertices().size());
        for (const auto& vertex : splits_.vertices()) sources.push_back(vertex.place);
        return sources;
    }
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(positions.size(), unused);
    for (const std::uint32_t vertex : indices_) places[vertex] = 0;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        if (places[i] == unused) continue;
        places[i] = static_cast<std::uint32_t>(sources.size());
        sources.push_back(i);
    }
    if (sources.size() < places.size())
        for (std::uint32_t& vertex : indices_) vertex = places[vertex];
    return sources;
}

void PolygonMesh::add_looks(const std::vector<std::uint32_t>& sources, Mesh& mesh, Warnings& warnings) {
    mesh.colors.reserve(sources.size());
    mesh.uvs.reserve(sources.size());
    mesh.material_ids.reserve(sources.size());
    Material material;
    std::uint16_t id = number_of(material, mesh.materials);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Look look = looks_ == Looks::of_faces ? splits_.vertices()[i].look : look_of(sources[i]);
        const bool finite = std::isfinite(look.uv.x) && std::isfinite(look.uv.y);
        if (!finite && look.texture != no_texture)
            warnings.add("texture coordinate is no number, set to 0", "vertex " + std::to_string(sources[i]));
        mesh.uvs.push_back(finite ? look.uv : glm::vec2(0.0f));
        mesh.colors.push_back(look.color);
        if (std::exchange(material.texture, look.texture) != look.texture) id = number_of(material, mesh.materials);
        mesh.material_ids.push_back(id);
    }
    uvs = {};
    colors = {};
}

void PolygonMesh::add_normals(const std::vector<std::uint32_t>& sources, Mesh& mesh, Warnings& warnings) {
    mesh.normals.reserve(sources.size());
    for (const std::uint32_t source : sources) {
        glm::vec3 normal = normals.empty() ? glm::vec3(0.0f) : normals[source];
        if (!std::isfinite(normal.x) || !std::isfinite(normal.y) || !std::isfinite(normal.z)) {
            warnings.add("normal is no number, computed", "vertex " + std::to_string(source));
            normal = glm::vec3(0.0f);
        }
        mesh.normals.push_back(normal);
    }
    normals = {};
    std::vector<std::uint32_t> places;  // a seam of looks is no crease
    if (looks_ == Looks::of_faces) places = splits_.alike([](const Look&, const Look&) { return true; });
    splits_ = VertexSplits<Look>();
    complete_normals(mesh.positions, mesh.indices, places, mesh.normals);
}

Mesh PolygonMesh::finish(Warnings& warnings) {
    Mesh mesh;
    const std::vector<std::uint32_t> sources = take_sources();
    mesh.indices = std::move(indices_);
    const auto position_of = [&](std::size_t i) { return positions[sources[i]]; };
    mesh.origin = origin_of(sources.size(), position_of);
    const bool as_they_are = mesh.origin == glm::dvec3(0.0) && sources.size() == positions.size();
    if (as_they_are && looks_ == Looks::of_vertices)
        mesh.positions = positions.take_rounded();
    else
        place(mesh, sources.size(), position_of);
    positions = {};
    add_looks(sources, mesh, warnings);
    add_normals(sources, mesh, warnings);
    return mesh;
}

}  // namespace model
