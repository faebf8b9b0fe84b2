#include "model/texture_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/srgb.h"

namespace model {
namespace {

glm::vec4 linear(const glm::u8vec4& texel) {
    return {linear_of_srgb(texel.r), linear_of_srgb(texel.g), linear_of_srgb(texel.b),
            static_cast<float>(texel.a) / 255.0f};
}

}  // namespace

float wrapped(Wrap wrap, float coordinate) {
    // Between corners at the largest floats lie sums that overflow.
    if (!std::isfinite(coordinate)) return 0.0f;
    if (wrap == Wrap::clamp) return std::clamp(coordinate, 0.0f, 1.0f);
    if (wrap == Wrap::repeat) return coordinate - std::floor(coordinate);
    const float there_and_back = coordinate - 2.0f * std::floor(0.5f * coordinate);
    return there_and_back > 1.0f ? 2.0f - there_and_back : there_and_back;
}

glm::vec4 texture_at(const Texture& texture, const Sampler& sampler, const glm::vec2& uv) {
    const auto texel = [&](int x, int y) {
        x = wrapped_texel(sampler.across, x, texture.width);
        y = wrapped_texel(sampler.down, y, texture.height);
        return linear(texture.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                                     static_cast<std::size_t>(x)]);
    };
    const glm::vec2 size(texture.width, texture.height);
    const glm::vec2 at = glm::vec2(wrapped(sampler.across, uv.x), wrapped(sampler.down, uv.y)) * size;
    if (sampler.nearest)
        return texel(std::min(static_cast<int>(at.x), texture.width - 1),
                     std::min(static_cast<int>(at.y), texture.height - 1));
    const glm::vec2 from_centers = at - 0.5f, corner = glm::floor(from_centers), s = from_centers - corner;
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), s.x), glm::mix(texel(x, y + 1), texel(x + 1, y + 1), s.x),
                    s.y);
}

}  // namespace model
