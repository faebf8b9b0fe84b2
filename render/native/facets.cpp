#include "render/native/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "pointsample/prefix_look.h"

namespace render::native {

namespace {

// The mean of so many neighbours' distances tells how densely points lie.
constexpr std::size_t neighbours = 8;

void make_mean_one(std::vector<float>& shares) {
    const float sum = std::accumulate(shares.begin(), shares.end(), 0.0f);
    for (float& share : shares) share *= static_cast<float>(shares.size()) / sum;
}

}  // namespace

glm::vec3 facet(const figures::Figure& figure, int pose, int point) {
    const motion::PoseTable& poses = *figure.poses;
    const model::Mesh& mesh = *figure.mesh;
    const std::uint32_t* corner = &mesh.indices[std::size_t{3} * figure.points->surface[point].triangle];
    const motion::PosedVertex* vertices = &poses.vertices[static_cast<std::size_t>(pose) * poses.vertex_count];
    const auto across = [](glm::vec3 a, glm::vec3 b, glm::vec3 c) { return glm::cross(b - a, c - a); };
    const auto posed = [&](int i) { return motion::unpack_position(vertices[corner[i]], poses.box); };
    const float rest =
        glm::length(across(mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]));
    const glm::vec3 now = across(posed(0), posed(1), posed(2));
    if (!(rest > 0.0f) || !(glm::length(now) > 0.0f))
        return motion::unpack_normal(poses.points[static_cast<std::size_t>(pose) * poses.point_count + point]);
    return now / rest;
}

Shares::Shares(const pointsample::PointModel& model) : model_(model), own_(model.size(), 1.0f) {
    if (model.size() <= neighbours) return;
    for (std::size_t i = 0; i < model.size(); ++i) {
        std::array<float, neighbours> nearest;
        nearest.fill(std::numeric_limits<float>::infinity());
        for (std::size_t j = 0; j < model.size(); ++j) {
            const float d = pointsample::squared_distance(model, i, j);
            if (j == i || !(d < nearest.back())) continue;
            nearest.back() = d;
            for (std::size_t k = neighbours - 1; k > 0 && nearest[k] < nearest[k - 1]; --k)
                std::swap(nearest[k], nearest[k - 1]);
        }
        own_[i] = std::accumulate(nearest.begin(), nearest.end(), 0.0f);
    }
    make_mean_one(own_);
}

std::vector<float> Shares::of_first(std::size_t count) const {
    if (count == model_.size()) return own_;
    std::vector<float> shares(own_.begin(), own_.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t point = count; point < model_.size(); ++point)
        shares[pointsample::nearest_of_prefix(model_, point, count)] += own_[point];
    make_mean_one(shares);
    return shares;
}

}  // namespace render::native
