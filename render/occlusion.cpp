#include "render/occlusion.h"

#include <algorithm>
#include <cmath>

namespace render {

bool Occlusion::hides(glm::vec2 low, glm::vec2 high, float nearest_depth, const View& view) const {
    const auto block = [](float ndc, float margin_px, int pixels, int blocks) {
        const float at = std::floor(((0.5f + 0.5f * ndc) * static_cast<float>(pixels) + margin_px) / block_side);
        return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(blocks - 1)));
    };
    const int x0 = block(low.x, -margin, view.width, columns), x1 = block(high.x, margin, view.width, columns);
    const int y0 = block(-high.y, -margin, view.height, rows), y1 = block(-low.y, margin, view.height, rows);
    const float nearest = near_plane / nearest_depth;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            if (!(farthest[std::ptrdiff_t{stride} * y + x] > nearest)) return false;
    return true;
}

// The ball's image lies within the images of its nearest and its farthest side's squares.
bool Occlusion::hides_ball(const View& view, glm::vec3 center, float radius) const {
    const float depth = view.depth(center), nearest = depth - radius;
    if (nearest <= near_plane) return false;
    const glm::vec2 middle(glm::dot(view.right, center), glm::dot(view.up, center));
    const glm::vec2 tangents(view.tan_half_x, view.tan_half_y);
    const auto extreme = [&](glm::vec2 side, auto choose) {
        return choose(side / (nearest * tangents), side / ((depth + radius) * tangents));
    };
    const glm::vec2 low = extreme(middle - radius, [](glm::vec2 a, glm::vec2 b) { return glm::min(a, b); });
    const glm::vec2 high = extreme(middle + radius, [](glm::vec2 a, glm::vec2 b) { return glm::max(a, b); });
    return hides(low, high, nearest, view);
}

bool Occlusion::hides_box(const View& view, const motion::Bounds& box) const {
    glm::vec2 low(INFINITY), high(-INFINITY);
    float nearest = INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at = view.relative({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                            corner & 4 ? box.max.z : box.min.z});
        const float depth = view.depth(at);
        if (depth <= near_plane) return false;
        const glm::vec2 ndc(glm::dot(view.right, at) / (depth * view.tan_half_x),
                            glm::dot(view.up, at) / (depth * view.tan_half_y));
        low = glm::min(low, ndc);
        high = glm::max(high, ndc);
        nearest = std::min(nearest, depth);
    }
    return hides(low, high, nearest, view);
}

}  // namespace render
