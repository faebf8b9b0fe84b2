#include "model/sides.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "model/cutout.h"

namespace model {
namespace {

constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

// Which vertex is each one's twin; those of them that have one, in their order.
struct Twins {
    std::vector<std::uint32_t> of;
    std::vector<std::uint32_t> originals;
};

std::size_t count_double_sided(const Mesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) count += material_of_triangle(mesh, t).double_sided;
    return count;
}

// Of the vertices of double-sided triangles.
Twins find_twins(const Mesh& mesh) {
    std::vector<char> has_two(mesh.vertex_count(), 0);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        if (material_of_triangle(mesh, t).double_sided)
            for (std::size_t k = 0; k < 3; ++k) has_two[mesh.indices[3 * t + k]] = 1;
    Twins twins{std::vector<std::uint32_t>(mesh.vertex_count(), no_twin), {}};
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!has_two[v]) continue;
        twins.of[v] = static_cast<std::uint32_t>(mesh.vertex_count() + twins.originals.size());
        twins.originals.push_back(v);
    }
    return twins;
}

template <typename T>
void repeat(std::vector<T>& values, const std::vector<std::uint32_t>& originals) {
    values.reserve(values.size() + originals.size());
    for (const std::uint32_t v : originals) values.push_back(values[v]);
}

// For the twins of the vertices that it moves.
MorphTarget twin_of(const MorphTarget& morph, const Twins& twins) {
    MorphTarget twin{morph.node, morph.weight, morph.rest_weight, 0, {}, {}};
    const std::uint32_t end = morph.first_vertex + static_cast<std::uint32_t>(morph.position_offsets.size());
    for (std::uint32_t v = morph.first_vertex; v < end; ++v) {
        if (twins.of[v] == no_twin) continue;
        if (twin.position_offsets.empty()) twin.first_vertex = twins.of[v];
        twin.position_offsets.push_back(morph.position_offsets[v - morph.first_vertex]);
        if (!morph.normal_offsets.empty()) twin.normal_offsets.push_back(-morph.normal_offsets[v - morph.first_vertex]);
    }
    return twin;
}

void add_vertices(Mesh& mesh, const Twins& twins) {
    repeat(mesh.positions, twins.originals);
    repeat(mesh.uvs, twins.originals);
    repeat(mesh.colors, twins.originals);
    repeat(mesh.slots, twins.originals);
    repeat(mesh.material_ids, twins.originals);
    repeat(mesh.joints, twins.originals);
    repeat(mesh.weights, twins.originals);
    if (!mesh.more_joints.empty()) {
        repeat(mesh.more_joints, twins.originals);
        repeat(mesh.more_weights, twins.originals);
    }
    for (const std::uint32_t v : twins.originals) mesh.normals.push_back(-mesh.normals[v]);
    std::vector<MorphTarget> added;
    for (const MorphTarget& morph : mesh.morphs) {
        MorphTarget twin = twin_of(morph, twins);
        if (!twin.position_offsets.empty()) added.push_back(std::move(twin));
    }
    std::ranges::move(added, std::back_inserter(mesh.morphs));
}

void add_triangles(Mesh& mesh, const Twins& twins) {
    const std::size_t count = mesh.triangle_count();
    for (std::size_t t = 0; t < count; ++t) {
        if (!material_of_triangle(mesh, t).double_sided) continue;
        const std::uint32_t* corner = &mesh.indices[3 * t];
        // The last corner stays the last: it says which material.
        const std::uint32_t turned[] = {twins.of[corner[1]], twins.of[corner[0]], twins.of[corner[2]]};
        mesh.indices.insert(mesh.indices.end(), std::begin(turned), std::end(turned));
    }
}

}  // namespace

void split_sides(Mesh& mesh) {
    const std::size_t double_sided = count_double_sided(mesh);
    if (double_sided == mesh.triangle_count()) return;
    if (double_sided > 0) {
        const Twins twins = find_twins(mesh);
        add_vertices(mesh, twins);
        add_triangles(mesh, twins);
    }
    for (Material& material : mesh.materials) material.double_sided = false;
}

}  // namespace model
