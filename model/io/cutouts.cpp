#include "model/io/cutouts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace model {
namespace {

constexpr int depth = 16;  // [texels] mipmaps reach farther than a bilinear filter

// Rings of texels around what has a colour take the mean of the neighbours that have one.
void fill(Texture& texture, float cutoff) {
    const auto width = static_cast<std::size_t>(texture.width), height = static_cast<std::size_t>(texture.height);
    const float least = 255 * cutoff;
    std::vector<std::uint8_t> has_color(texture.texels.size());
    std::ranges::transform(texture.texels, has_color.begin(),
                           [&](const glm::u8vec4& texel) { return static_cast<float>(texel.a) >= least; });
    std::vector<std::size_t> ring;
    for (int step = 0; step < depth; ++step) {
        ring.clear();
        for (std::size_t at = 0; at < texture.texels.size(); ++at) {
            if (has_color[at]) continue;
            const std::size_t x = at % width, y = at / width;
            // A texture may repeat: the other edge is a neighbour.
            const std::array beside = {y * width + (x + 1) % width, y * width + (x + width - 1) % width,
                                       (y + 1) % height * width + x, (y + height - 1) % height * width + x};
            glm::ivec3 sum(0);
            int count = 0;
            for (const std::size_t other : beside) {
                if (!has_color[other]) continue;
                sum += glm::ivec3(texture.texels[other]);
                ++count;
            }
            if (count == 0) continue;
            texture.texels[at] = glm::u8vec4(sum / count, texture.texels[at].a);
            ring.push_back(at);
        }
        if (ring.empty()) return;
        for (const std::size_t at : ring) has_color[at] = true;
    }
}

}  // namespace

void fill_cutouts(Mesh& mesh) {
    for (std::size_t id = 0; id < mesh.textures.size(); ++id) {
        float cutoff = 1;
        bool is_worn = false, is_whole = false;
        for (const Material& material : mesh.materials) {
            if (material.texture != id) continue;
            is_worn = true;
            is_whole |= !(material.alpha_cutoff > 0);
            cutoff = std::min(cutoff, material.alpha_cutoff);
        }
        if (is_worn && !is_whole) fill(mesh.textures[id], cutoff);
    }
}

}  // namespace model
