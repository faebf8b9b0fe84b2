#include "model/cutout.h"

#include <algorithm>
#include <cmath>

#include "model/texture_sample.h"

namespace model {
namespace {

// Of the texture's square that a triangle shows.
double texels_of(const Mesh& mesh, std::size_t triangle, const Texture& texture) {
    const auto corner = [&](std::size_t k) {
        return glm::dvec2(mesh.uvs[mesh.indices[3 * triangle + k]]) * glm::dvec2(texture.width, texture.height);
    };
    const glm::dvec2 second = corner(1) - corner(0), third = corner(2) - corner(0);
    return 0.5 * std::abs(second.x * third.y - second.y * third.x);
}

}  // namespace

bool has_cutouts(const Mesh& mesh) {
    return std::ranges::any_of(mesh.materials, [](const Material& material) { return material.alpha_cutoff > 0; });
}

bool has_surface(const Mesh& mesh, std::size_t triangle, float u, float v) {
    const Material& material = material_of_triangle(mesh, triangle);
    if (!(material.alpha_cutoff > 0)) return true;
    const std::uint32_t* corner = &mesh.indices[3 * triangle];
    const float shares[] = {1.0f - u - v, u, v};
    float alpha = 0;
    glm::vec2 uv(0);
    for (std::size_t k = 0; k < 3; ++k) {
        alpha += shares[k] * static_cast<float>(mesh.colors[corner[k]].a) / 255.0f;
        uv += shares[k] * mesh.uvs[corner[k]];
    }
    if (material.texture != no_texture) alpha *= texture_at(mesh.textures[material.texture], material.sampler, uv).a;
    constexpr float rounding = 1e-5f;  // of sums of bytes
    return alpha >= material.alpha_cutoff - rounding;
}

double surface_share(const Mesh& mesh, std::size_t triangle, int most_places) {
    const Material& material = material_of_triangle(mesh, triangle);
    if (!(material.alpha_cutoff > 0)) return 1;
    constexpr double places_per_texel = 4, fewest = 16;
    const double wanted = material.texture == no_texture
                              ? 0
                              : places_per_texel * texels_of(mesh, triangle, mesh.textures[material.texture]);
    // Equal triangles, so many along each side; looked at in their middles.
    const double places =
        std::clamp(std::isfinite(wanted) ? wanted : 0.0, fewest, std::max<double>(fewest, most_places));
    const int along = static_cast<int>(std::sqrt(places));
    int there = 0;
    for (int i = 0; i < along; ++i) {
        for (int j = 0; i + j < along; ++j) {
            const auto looks_at = [&](double third) {
                return has_surface(mesh, triangle, static_cast<float>((i + third) / along),
                                   static_cast<float>((j + third) / along));
            };
            there += looks_at(1.0 / 3);
            if (i + j + 1 < along) there += looks_at(2.0 / 3);
        }
    }
    return static_cast<double>(there) / (along * along);
}

}  // namespace model
