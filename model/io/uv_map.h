// How two sets of texture coordinates of one surface lie to each other. Internal to the loaders.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "model/mesh.h"

namespace model {

// The affine map that takes each of `from` to that of `to`, which has as many, to 1e-4; nothing if there is none.
// triangles: of both.
std::optional<glm::mat3> uv_map(std::span<const glm::vec2> from, std::span<const glm::vec2> to,
                                std::span<const std::uint32_t> triangles);

// What is seen of `texture` by `sampler` at map * uv, as a texture of its own over uv in [0, 1], with texels as dense
// on the surface; a side is 4096 at most.
Texture resampled(const Texture& texture, const Sampler& sampler, const glm::mat3& map);

// Whether a resampled texture that `by` reads shows the right thing at all of `uvs`: they are in [0, 1], or both repeat
// alike.
bool shows_all(std::span<const glm::vec2> uvs, const Sampler& by, const Sampler& sampler, const glm::mat3& map);

}  // namespace model
