#include "render/native/directions.h"

#include <algorithm>
#include <cmath>

namespace render::native {

float diamond_of(float x, float z) {
    const float size = std::abs(x) + std::abs(z);
    if (!(size > 0.0f)) return 0.0f;
    const float along = x / size;
    if (z >= 0.0f) return x >= 0.0f ? along : 4.0f + along;
    return 2.0f - along;
}

glm::vec2 on_diamond(float angle) {
    if (angle < 1.0f) return {angle, 1.0f - angle};
    if (angle < 3.0f) return {2.0f - angle, angle < 2.0f ? 1.0f - angle : angle - 3.0f};
    return {angle - 4.0f, angle - 3.0f};
}

glm::vec3 direction_of(int node) {
    const float height = 2.0f * static_cast<float>(node / ring_nodes) / (rings - 1) - 1.0f;
    const glm::vec2 around = glm::normalize(on_diamond(4.0f * static_cast<float>(node % ring_nodes) / ring_nodes));
    const float out = 1.0f - std::abs(height);
    return glm::normalize(glm::vec3(out * around.x, height, out * around.y));
}

Between between_nodes(glm::vec3 direction) {
    const float out = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const float height = direction.y / (std::abs(direction.y) + out);
    const float ring = 0.5f * (rings - 1) * (height + 1.0f);
    const float around = 0.25f * ring_nodes * diamond_of(direction.x, direction.z);
    const int r = std::clamp(static_cast<int>(ring), 0, rings - 2);
    const int a = std::clamp(static_cast<int>(around), 0, ring_nodes - 1);
    const float u = around - static_cast<float>(a), v = ring - static_cast<float>(r);
    const int next = (a + 1) % ring_nodes;
    return {{r * ring_nodes + a, r * ring_nodes + next, (r + 1) * ring_nodes + a, (r + 1) * ring_nodes + next},
            {(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v},
            u,
            v};
}

}  // namespace render::native
