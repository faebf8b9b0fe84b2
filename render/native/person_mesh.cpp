#include "render/native/person_mesh.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <map>
#include <tuple>

#include "model/cutout.h"
#include "model/own_light.h"
#include "render/native/vertices.h"
#include "render/texture_layers.h"

namespace render::native {

namespace {

std::vector<glm::u8vec4> halved(const std::vector<glm::u8vec4>& texels, int side) {
    const int half = side / 2;
    std::vector<glm::u8vec4> out;
    out.reserve(static_cast<std::size_t>(half) * half);
    for (int y = 0; y < half; ++y) {
        for (int x = 0; x < half; ++x) {
            const glm::u8vec4* at = &texels[static_cast<std::size_t>(2 * y) * side + 2 * x];
            const glm::uvec4 sum =
                glm::uvec4(at[0]) + glm::uvec4(at[1]) + glm::uvec4(at[side]) + glm::uvec4(at[side + 1]);
            out.emplace_back((sum + 2u) / 4u);
        }
    }
    return out;
}

std::vector<std::uint32_t> paint_numbers(const model::Mesh& mesh, std::vector<Paint>& paints) {
    std::map<std::tuple<int, int, int, int>, std::uint32_t> known;
    std::vector<std::uint32_t> numbers;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::u8vec4 color = mesh.colors[v];
        const auto [place, added] =
            known.try_emplace({color.r, color.g, color.b, mesh.slots[v]}, static_cast<std::uint32_t>(paints.size()));
        if (added) {
            const glm::vec3 srgb = glm::vec3(color) / 255.0f;
            paints.push_back({srgb * srgb, mesh.slots[v]});
        }
        numbers.push_back(place->second);
    }
    return numbers;
}

// Of a material, among those that are known; added if it isn't.
std::uint16_t number_of(const model::Material& material, std::vector<Texturing>& known) {
    Texturing wanted;
    wanted.alpha_cutoff = material.alpha_cutoff;
    if (material.texture != model::no_texture) {
        wanted.layer = material.texture;
        wanted.sampler = material.sampler;
    }
    if (model::emits(material)) {
        const glm::vec3 emission = model::emission_of(material);
        wanted.emission = emission * emission;
        if (material.emissive_texture != model::no_texture) {
            wanted.emissive_layer = material.emissive_texture;
            wanted.sampler = material.sampler;
        }
    }
    const auto place = std::ranges::find(known, wanted);
    const auto number = static_cast<std::uint16_t>(place - known.begin());
    if (place == known.end()) known.push_back(wanted);
    return number;
}

}  // namespace

TextureLayers::TextureLayers(std::span<const model::Texture> textures) {
    if (textures.empty()) return;
    const int largest = layer_side(textures);
    for (int side = largest; side > 0; side /= 2) {
        first_.push_back(size_);
        size_ += static_cast<std::size_t>(side) * side;
    }
    texels_.resize(size_ * textures.size());
    std::uint32_t* to = texels_.data();
    for (const model::Texture& texture : textures) {
        std::vector<glm::u8vec4> texels = resample(texture, largest);
        for (int side = largest; side > 0; side /= 2) {
            std::memcpy(to, texels.data(), texels.size() * sizeof *to);
            to += texels.size();
            texels = halved(texels, side);
        }
    }
}

std::uint32_t PersonMesh::behind() const {
    return double_sided ? static_cast<std::uint32_t>(in_groups(vertex_count)) : 0;
}

PersonMesh::PersonMesh(const figures::Figure& figure)
    : poses(figure.poses),
      vertex_count(static_cast<std::uint32_t>(figure.mesh->vertex_count())),
      double_sided(figure.mesh->double_sided()),
      texturings(1),
      textures(figure.mesh->textures) {
    const model::Mesh& mesh = *figure.mesh;
    const std::vector<std::uint32_t> paint_of = paint_numbers(mesh, paints);
    std::vector<std::uint16_t> texturing_of;
    for (const model::Material& material : mesh.materials) texturing_of.push_back(number_of(material, texturings));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 2], c = mesh.indices[i + 1];
        const std::uint16_t texturing = texturing_of[mesh.material_ids[b]];  // the last corner in the file's order says
        const bool one_paint = paint_of[a] == paint_of[b] && paint_of[a] == paint_of[c];
        faces.push_back({{a, b, c}, {paint_of[a], paint_of[b], paint_of[c]}, texturing, one_paint && texturing == 0});
        for (int corner = 0; corner < 3; ++corner)
            corners[corner].push_back(static_cast<std::int32_t>(faces.back().corners[corner]));
    }
    for (auto& list : corners) list.resize(in_groups(list.size()));
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        if (mesh.material_of(v).unlit) unlit.push_back(v);
    if (model::has_cutouts(mesh))
        for (const glm::u8vec4& color : mesh.colors) alphas.push_back(static_cast<float>(color.a) / 255.0f);
    if (mesh.textures.empty()) return;
    for (const glm::vec2 uv : mesh.uvs) uvs.push_back(glm::unpackHalf2x16(glm::packHalf2x16(uv)));  // what GL is given
}

}  // namespace render::native
