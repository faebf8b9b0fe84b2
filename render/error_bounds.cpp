#include "render/error_bounds.h"

#include <algorithm>

namespace render {

namespace {

float size_of(const motion::PoseTable& table) {
    float most = 0;
    for (const motion::Bounds& box : table.clip_boxes) most = std::max(most, glm::length(box.size()));
    return most;
}

}  // namespace

std::vector<ErrorBounds> measure_error_bounds(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                                              std::span<const figures::Figure> figures) {
    const std::vector<MotionBounds> motion = measure_motion_bounds(crowd, cast, figures);
    std::vector<ErrorBounds> bounds;
    for (std::size_t i = 0; i < figures.size(); ++i)
        bounds.push_back({motion[i], Covering(figures[i]), size_of(*figures[i].poses)});
    return bounds;
}

}  // namespace render
