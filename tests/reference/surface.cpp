#include "tests/reference/surface.h"

#include <cstddef>
#include <glm/gtc/matrix_inverse.hpp>

#include "tests/motion/reference.h"

namespace reference {

namespace {

// Where a node takes its own space's origin and axes.
glm::dmat4 world_matrix(const tests::reference::Figure& posed, std::int32_t node) {
    glm::dmat4 matrix(1);
    const glm::dvec3 origin = posed.place(node, glm::dvec3(0));
    matrix[3] = glm::dvec4(origin, 1);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 unit(0);
        unit[axis] = 1;
        matrix[axis] = glm::dvec4(posed.place(node, unit) - origin, 0);
    }
    return matrix;
}

}  // namespace

Surface surface_at(const model::Character& character, int clip, double seconds) {
    using Posed = tests::reference::Figure;
    const Posed posed =
        clip < 0 ? Posed(character) : Posed(character, character.clips[static_cast<std::size_t>(clip)], seconds);
    const model::Mesh& mesh = character.mesh;
    Surface surface;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        surface.positions.emplace_back(mesh.positions[v]);
        surface.normals.emplace_back(mesh.normals[v]);
    }
    for (std::size_t m = 0; m < mesh.morphs.size(); ++m) {
        const model::MorphTarget& morph = mesh.morphs[m];
        const double weight = posed.morph_weights[m];
        for (std::size_t i = 0; i < morph.position_offsets.size(); ++i)
            surface.positions[morph.first_vertex + i] += weight * glm::dvec3(morph.position_offsets[i]);
        for (std::size_t i = 0; i < morph.normal_offsets.size(); ++i)
            surface.normals[morph.first_vertex + i] += weight * glm::dvec3(morph.normal_offsets[i]);
    }
    std::vector<glm::dmat4> bones;
    for (const model::PaletteEntry& entry : character.skeleton.palette)
        bones.push_back(world_matrix(posed, entry.node) * glm::dmat4(entry.inverse_bind));
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        glm::dmat4 blend(0);
        for (int i = 0; i < 4; ++i)
            if (mesh.weights[v][i] > 0) blend += static_cast<double>(mesh.weights[v][i]) * bones[mesh.joints[v][i]];
        surface.positions[v] = glm::dvec3(blend * glm::dvec4(surface.positions[v], 1));
        surface.normals[v] = glm::normalize(glm::inverseTranspose(glm::dmat3(blend)) * surface.normals[v]);
    }
    return surface;
}

double area_of(const model::Mesh& mesh, const Surface& surface) {
    double area = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = surface.positions[mesh.indices[i]], b = surface.positions[mesh.indices[i + 1]],
                         c = surface.positions[mesh.indices[i + 2]];
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

}  // namespace reference
