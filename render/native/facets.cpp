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

// Of squared_distance(), quickly: in a straight line.
float least_distance(const pointsample::PointModel& model, std::size_t a, std::size_t b) {
    const glm::vec3 apart = model.positions[a] - model.positions[b];
    return glm::dot(apart, apart);
}

// When all are drawn.
std::vector<float> own_shares(const pointsample::PointModel& model) {
    std::vector<float> shares(model.size(), 1.0f);
    if (model.size() <= neighbours) return shares;
    std::array<float, neighbours> far;
    far.fill(std::numeric_limits<float>::infinity());
    std::vector<std::array<float, neighbours>> nearest(model.size(), far);
    const auto insert = [&](std::size_t i, float d) {
        std::array<float, neighbours>& of = nearest[i];
        if (!(d < of.back())) return;
        of.back() = d;
        for (std::size_t k = neighbours - 1; k > 0 && of[k] < of[k - 1]; --k) std::swap(of[k], of[k - 1]);
    };
    for (std::size_t i = 0; i < model.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (least_distance(model, i, j) >= std::max(nearest[i].back(), nearest[j].back())) continue;
            const float d = pointsample::squared_distance(model, i, j);
            insert(i, d);
            insert(j, d);
        }
    }
    for (std::size_t i = 0; i < model.size(); ++i)
        shares[i] = std::accumulate(nearest[i].begin(), nearest[i].end(), 0.0f);
    make_mean_one(shares);
    return shares;
}

glm::vec3 across(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    return glm::cross(b - a, c - a);
}

}  // namespace

Facets::Facets(const figures::Figure& figure) : figure_(figure) {
    const model::Mesh& mesh = *figure.mesh;
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> number_of(mesh.triangle_count(), none);
    for (const motion::SurfacePoint& point : figure.points->surface) {
        std::uint32_t& number = number_of[point.triangle];
        if (number == none) {
            const std::uint32_t* corner = &mesh.indices[std::size_t{3} * point.triangle];
            const glm::vec3 rest =
                across(mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]);
            number = static_cast<std::uint32_t>(triangles_.size());
            triangles_.push_back({{corner[0], corner[1], corner[2]}, glm::length(rest)});
        }
        triangle_of_.push_back(number);
    }
}

std::vector<glm::vec3> Facets::in_pose(int pose) const {
    const motion::PoseTable& poses = *figure_.poses;
    const motion::PosedVertex* vertices = &poses.vertices[static_cast<std::size_t>(pose) * poses.vertex_count];
    const motion::PosedVertex* points = &poses.points[static_cast<std::size_t>(pose) * poses.point_count];
    constexpr glm::vec3 none(0.0f);
    std::vector<glm::vec3> of_triangles;
    of_triangles.reserve(triangles_.size());
    for (const Triangle& triangle : triangles_) {
        const auto posed = [&](int i) { return motion::unpack_position(vertices[triangle.corners[i]], poses.box); };
        const glm::vec3 now = across(posed(0), posed(1), posed(2));
        of_triangles.push_back(triangle.rest > 0.0f && glm::length(now) > 0.0f ? now / triangle.rest : none);
    }
    std::vector<glm::vec3> facets;
    facets.reserve(triangle_of_.size());
    for (std::size_t i = 0; i < triangle_of_.size(); ++i) {
        const glm::vec3 facet = of_triangles[triangle_of_[i]];
        facets.push_back(facet == none ? motion::unpack_normal(points[i]) : facet);
    }
    return facets;
}

std::vector<std::vector<float>> shares_of_prefixes(const pointsample::PointModel& model, std::span<const int> counts) {
    const std::vector<float> own = own_shares(model);
    struct Nearest {
        std::size_t point = 0;
        float distance = std::numeric_limits<float>::infinity();
    };
    std::vector<Nearest> nearest(model.size());  // among the points so far
    std::size_t so_far = 0;
    std::vector<std::vector<float>> all;
    for (const int end : counts) {
        const auto count = static_cast<std::size_t>(end);
        std::vector<float>& shares = all.emplace_back(own.begin(), own.begin() + end);
        if (count == model.size()) continue;  // they have a mean of 1
        for (std::size_t point = count; point < model.size(); ++point) {
            Nearest& best = nearest[point];
            for (std::size_t i = so_far; i < count; ++i) {
                if (least_distance(model, i, point) >= best.distance) continue;
                const float distance = pointsample::squared_distance(model, i, point);
                if (distance < best.distance) best = {i, distance};
            }
            shares[best.point] += own[point];
        }
        make_mean_one(shares);
        so_far = count;
    }
    return all;
}

}  // namespace render::native
