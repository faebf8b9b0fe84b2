#include "tests/reference/surface.h"

#include <algorithm>
#include <cmath>
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
        mesh.visit_influences(v, [&](std::uint16_t joint, float weight) {
            if (weight > 0) blend += static_cast<double>(weight) * bones[joint];
        });
        surface.positions[v] = glm::dvec3(blend * glm::dvec4(surface.positions[v], 1));
        surface.normals[v] = glm::normalize(glm::inverseTranspose(glm::dmat3(blend)) * surface.normals[v]);
    }
    return surface;
}

namespace {

// Of the triangle at index `i`, how much alpha leaves: looked at by nearest texels, evenly.
double share_there(const model::Mesh& mesh, std::size_t i) {
    const model::Material& material = mesh.material_of(mesh.indices[i + 2]);
    if (!(material.alpha_cutoff > 0)) return 1;
    constexpr int along = 64;
    int looked = 0, there = 0;
    for (int u = 0; u < along; ++u) {
        for (int v = 0; u + v < along; ++v) {
            const double second = (u + 1.0 / 3) / along, third = (v + 1.0 / 3) / along;
            const double share[] = {1 - second - third, second, third};
            double alpha = 0;
            glm::dvec2 uv(0);
            for (std::size_t k = 0; k < 3; ++k) {
                alpha += share[k] * mesh.colors[mesh.indices[i + k]].a / 255.0;
                uv += share[k] * glm::dvec2(mesh.uvs[mesh.indices[i + k]]);
            }
            if (material.texture != model::no_texture) {
                const model::Texture& texture = mesh.textures[material.texture];
                const auto texel = [](model::Wrap wrap, double at, int size) {
                    if (wrap == model::Wrap::clamp) at = std::clamp(at, 0.0, 1.0);
                    if (wrap == model::Wrap::mirror) at = 1 - std::abs(std::fmod(std::abs(at), 2.0) - 1);
                    at -= std::floor(at) - (at == 1.0);
                    return std::min(static_cast<int>(at * size), size - 1);
                };
                const int x = texel(material.sampler.across, uv.x, texture.width);
                const int y = texel(material.sampler.down, uv.y, texture.height);
                alpha *= texture.texels[static_cast<std::size_t>(y) * texture.width + x].a / 255.0;
            }
            ++looked;
            there += alpha >= static_cast<double>(material.alpha_cutoff);
        }
    }
    return 1.0 * there / looked;
}

}  // namespace

double area_of(const model::Mesh& mesh, const Surface& surface) {
    double area = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = surface.positions[mesh.indices[i]], b = surface.positions[mesh.indices[i + 1]],
                         c = surface.positions[mesh.indices[i + 2]];
        area += share_there(mesh, i) * glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

}  // namespace reference
