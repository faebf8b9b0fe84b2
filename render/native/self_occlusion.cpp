#include "render/native/self_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/native/facets.h"

namespace render::native {

namespace {

constexpr int side = 128;      // [cells] of the square that a body is looked at in
constexpr int margin = 2;      // [cells] around it
constexpr float slack = 2.0f;  // [cells] A point so far behind the surface in front of it lies on that surface.
constexpr float nothing = -std::numeric_limits<float>::infinity();

}  // namespace

SelfOcclusion::SelfOcclusion(const figures::Figure& figure, int pose, std::span<const float> shares)
    : figure_(figure),
      points_(static_cast<int>(shares.size())),
      double_sided_(figure.mesh->double_sided()),
      depth_(side * side) {
    const motion::PoseTable& poses = *figure.poses;
    for (int i = 0; i < poses.vertex_count; ++i)
        vertices_.push_back(motion::unpack_position(
            poses.vertices[static_cast<std::size_t>(pose) * poses.vertex_count + i], poses.box));
    for (int i = 0; i < points_; ++i) {
        const motion::PosedVertex& point = poses.points[static_cast<std::size_t>(pose) * poses.point_count + i];
        positions_.push_back(motion::unpack_position(point, poses.box));
        facets_.push_back(shares[i] * facet(figure, pose, i));
    }
    seen_.resize(vertices_.size());
}

SelfOcclusion::Seen SelfOcclusion::look_from(glm::vec3 direction, std::span<std::uint32_t> visible) {
    towards_ = direction;
    right_ = glm::normalize(std::abs(direction.y) < 0.9f ? glm::cross(glm::vec3(0, 1, 0), direction)
                                                         : glm::cross(glm::vec3(0, 0, 1), direction));
    up_ = glm::cross(direction, right_);
    draw_depths();
    Seen seen;
    const float cells =
        static_cast<float>(std::count_if(depth_.begin(), depth_.end(), [](float depth) { return depth > nothing; }));
    seen.silhouette = cells / (cells_per_unit_ * cells_per_unit_);
    std::ranges::fill(visible, 0u);
    for (int i = 0; i < points_; ++i) {
        float facing = glm::dot(facets_[i], direction);
        if (double_sided_) facing = std::abs(facing);
        const glm::vec3 p = positions_[i];
        const glm::vec3 at(glm::dot(right_, p), glm::dot(up_, p), glm::dot(towards_, p));
        if (facing > 0.0f && is_hidden((at - low_) * cells_per_unit_)) continue;
        visible[i / 32] |= 1u << (i % 32);
        seen.facing += std::max(facing, 0.0f);
    }
    return seen;
}

void SelfOcclusion::draw_depths() {
    glm::vec3 high(nothing);
    low_ = glm::vec3(-nothing);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const glm::vec3 p = vertices_[i];
        seen_[i] = glm::vec3(glm::dot(right_, p), glm::dot(up_, p), glm::dot(towards_, p));
        low_ = glm::min(low_, seen_[i]);
        high = glm::max(high, seen_[i]);
    }
    const glm::vec3 size = high - low_;
    cells_per_unit_ = (side - 2 * margin) / std::max({size.x, size.y, 1e-6f * size.z, 1e-30f});
    low_ -= glm::vec3(margin / cells_per_unit_);
    for (glm::vec3& p : seen_) p = (p - low_) * cells_per_unit_;
    std::ranges::fill(depth_, nothing);
    const std::vector<std::uint32_t>& indices = figure_.mesh->indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        draw_triangle(seen_[indices[i]], seen_[indices[i + 1]], seen_[indices[i + 2]]);
}

void SelfOcclusion::draw_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    float twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (double_sided_ && twice < 0.0f) {
        std::swap(b, c);
        twice = -twice;
    }
    if (!(twice > 0.0f)) return;
    // The first cell whose middle is not below; all is within the square.
    const auto cell = [](float at) { return static_cast<int>(at + 0.5f); };
    const int x0 = cell(std::min({a.x, b.x, c.x})), x1 = cell(std::max({a.x, b.x, c.x}));
    const int y0 = cell(std::min({a.y, b.y, c.y})), y1 = cell(std::max({a.y, b.y, c.y}));
    if (x0 >= x1 || y0 >= y1) return;
    const glm::vec2 across(c.y - a.y, a.y - b.y), down(a.x - c.x, b.x - a.x);  // of u and v, a cell on
    const glm::vec2 share = glm::vec2(b.z - a.z, c.z - a.z) / twice;
    const glm::vec2 from(static_cast<float>(x0) + 0.5f - a.x, static_cast<float>(y0) + 0.5f - a.y);
    glm::vec2 row = from.x * across + from.y * down;
    for (int y = y0; y < y1; ++y, row += down) {
        glm::vec2 at = row;
        for (int x = x0; x < x1; ++x, at += across) {
            if (at.x < 0.0f || at.y < 0.0f || at.x + at.y > twice) continue;
            float& nearest = depth_[y * side + x];
            nearest = std::max(nearest, a.z + glm::dot(at, share));
        }
    }
}

// By the farthest of the four cells around it: at the edge of what is in front a point still shows.
bool SelfOcclusion::is_hidden(glm::vec3 at) const {
    const int x = std::clamp(static_cast<int>(at.x - 0.5f), 0, side - 2);
    const int y = std::clamp(static_cast<int>(at.y - 0.5f), 0, side - 2);
    const float* cell = &depth_[y * side + x];
    return at.z + slack < std::min({cell[0], cell[1], cell[side], cell[side + 1]});
}

}  // namespace render::native
