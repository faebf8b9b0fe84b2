#include "model/io/uv_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/srgb.h"
#include "model/texture_sample.h"

namespace model {
namespace {

constexpr float near_enough = 1e-4f;  // a tenth of a texel of a thousand

glm::dmat3 corners_of(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> triangle) {
    glm::dmat3 corners;
    for (int k = 0; k < 3; ++k) corners[k] = glm::dvec3(glm::dvec2(uvs[triangle[static_cast<std::size_t>(k)]]), 1.0);
    return corners;
}

// Where the texture is largest: what its corners say is said best.
std::size_t largest_triangle(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> triangles) {
    std::size_t largest = 0;
    double most = -1;
    for (std::size_t i = 0; i + 3 <= triangles.size(); i += 3) {
        const double area = std::abs(glm::determinant(corners_of(uvs, triangles.subspan(i, 3))));
        if (area > most) largest = i;
        most = std::max(most, area);
    }
    return largest;
}

int side_of(const glm::vec3& step, const glm::vec2& size) {
    constexpr float longest = 4096;
    return static_cast<int>(std::clamp(std::ceil(glm::length(glm::vec2(step) * size) - 1e-3f), 1.0f, longest));
}

}  // namespace

std::optional<glm::mat3> uv_map(std::span<const glm::vec2> from, std::span<const glm::vec2> to,
                                std::span<const std::uint32_t> triangles) {
    if (triangles.size() < 3) return std::nullopt;
    const auto triangle = triangles.subspan(largest_triangle(from, triangles), 3);
    const glm::mat3 map(corners_of(to, triangle) * glm::inverse(corners_of(from, triangle)));
    for (std::size_t i = 0; i < from.size(); ++i)
        if (!(glm::distance(glm::vec2(map * glm::vec3(from[i], 1)), to[i]) < near_enough)) return std::nullopt;
    return map;
}

Texture resampled(const Texture& texture, const Sampler& sampler, const glm::mat3& map) {
    const glm::vec2 size(texture.width, texture.height);
    Texture out{side_of(map[0], size), side_of(map[1], size), {}};
    out.texels.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(out.width, out.height);
            const glm::vec4 seen = texture_at(texture, sampler, glm::vec2(map * glm::vec3(uv, 1)));
            out.texels.emplace_back(srgb_of_linear(seen.r), srgb_of_linear(seen.g), srgb_of_linear(seen.b),
                                    unit_byte(seen.a));
        }
    }
    return out;
}

bool shows_all(std::span<const glm::vec2> uvs, const Sampler& by, const Sampler& sampler, const glm::mat3& map) {
    const auto repeats = [](const Sampler& s) { return s.across == Wrap::repeat && s.down == Wrap::repeat; };
    const auto is_whole = [](float number) { return std::abs(number - std::round(number)) < near_enough; };
    const glm::mat2 turn(map);
    if (repeats(by) && repeats(sampler) && is_whole(turn[0].x) && is_whole(turn[0].y) && is_whole(turn[1].x) &&
        is_whole(turn[1].y))
        return true;
    return std::ranges::all_of(uvs, [](const glm::vec2& uv) {
        return std::min(uv.x, uv.y) >= -near_enough && std::max(uv.x, uv.y) <= 1 + near_enough;
    });
}

}  // namespace model
