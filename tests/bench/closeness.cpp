#include "tests/bench/closeness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace bench {
namespace {

struct Triangle {
    glm::dvec3 a, b, c;
};

std::vector<Triangle> triangles_of(const model::Mesh& mesh, std::span<const glm::vec3> positions) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        triangles.push_back(
            {positions[mesh.indices[i]], positions[mesh.indices[i + 1]], positions[mesh.indices[i + 2]]});
    return triangles;
}

// Points in the cubes of a grid.
class Grid {
public:
    explicit Grid(std::span<const glm::vec3> points) : low_(points[0]) {
        glm::vec3 high = low_;
        for (const glm::vec3& point : points) low_ = glm::min(low_, point), high = glm::max(high, point);
        const glm::vec3 size = high - low_;
        const float longest = std::max({size.x, size.y, size.z, std::numeric_limits<float>::min()});
        // About one point in each cube that the surface passes through, were it a square of the longest side.
        edge_ = longest / std::sqrt(static_cast<float>(points.size()));
        cubes_ = glm::ivec3(size / edge_) + 1;
        first_.assign(static_cast<std::size_t>(cubes_.x) * cubes_.y * cubes_.z + 1, 0);
        for (const glm::vec3& point : points) ++first_[index(cube_of(point)) + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        points_.resize(points.size());
        std::vector<std::size_t> next = first_;
        for (const glm::vec3& point : points) points_[next[index(cube_of(point))]++] = point;
    }

    float nearest_distance(const glm::vec3& spot) const {
        const glm::ivec3 middle = cube_of(spot);
        const int most_cubes = std::max({cubes_.x, cubes_.y, cubes_.z});
        float nearest = std::numeric_limits<float>::infinity();
        // What is farther out than `ring` cubes is farther away than as many edges.
        for (int ring = 0; ring < most_cubes && nearest > static_cast<float>(ring - 1) * edge_; ++ring) {
            const glm::ivec3 from = glm::max(middle - ring, 0), to = glm::min(middle + ring, cubes_ - 1);
            for (int z = from.z; z <= to.z; ++z) {
                for (int y = from.y; y <= to.y; ++y) {
                    const bool whole_row = std::abs(z - middle.z) == ring || std::abs(y - middle.y) == ring;
                    for (int x = from.x; x <= to.x; ++x) {
                        if (!whole_row && std::abs(x - middle.x) != ring) continue;
                        const std::size_t cube = index({x, y, z});
                        for (std::size_t i = first_[cube]; i < first_[cube + 1]; ++i)
                            nearest = std::min(nearest, glm::distance(spot, points_[i]));
                    }
                }
            }
        }
        return nearest;
    }

private:
    // The nearest cube, of spots outside too.
    glm::ivec3 cube_of(const glm::vec3& spot) const {
        return glm::ivec3(glm::clamp((spot - low_) / edge_, glm::vec3(0), glm::vec3(cubes_ - 1)));
    }
    std::size_t index(const glm::ivec3& cube) const {
        return (static_cast<std::size_t>(cube.z) * cubes_.y + cube.y) * cubes_.x + cube.x;
    }

    glm::vec3 low_;
    float edge_ = 0;
    glm::ivec3 cubes_;
    std::vector<std::size_t> first_;  // of each cube, and one more
    std::vector<glm::vec3> points_;   // cube by cube
};

double distance_to_edge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length = glm::dot(along, along);
    const double t = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * along);
}

double distance_to_triangle(const glm::dvec3& p, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
    };
    if (glm::length(normal) > 0 && inside(a, b) && inside(b, c) && inside(c, a))
        return std::abs(glm::dot(p - a, glm::normalize(normal)));
    return std::min({distance_to_edge(p, a, b), distance_to_edge(p, b, c), distance_to_edge(p, c, a)});
}

}  // namespace

Spots random_spots(const model::Mesh& mesh, std::span<const glm::vec3> positions, std::size_t count,
                   std::uint64_t seed) {
    const std::vector<Triangle> triangles = triangles_of(mesh, positions);
    std::vector<double> ends;
    double area = 0;
    for (const auto& [a, b, c] : triangles) ends.push_back(area += 0.5 * glm::length(glm::cross(b - a, c - a)));
    std::mt19937_64 engine(seed);
    const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    Spots spots;
    for (std::size_t i = 0; i < count; ++i) {
        const auto end = std::upper_bound(ends.begin(), ends.end() - 1, unit() * area);
        spots.triangles.push_back(static_cast<std::uint32_t>(end - ends.begin()));
        const auto& [a, b, c] = triangles[spots.triangles.back()];
        const double root = std::sqrt(unit()), share = unit();
        spots.positions.emplace_back(a * (1 - root) + b * (root * (1 - share)) + c * (root * share));
    }
    return spots;
}

Covering covering_of(std::span<const glm::vec3> spots, std::span<const glm::vec3> points) {
    const Grid grid(points);
    std::vector<float> distances;
    Covering covering;
    for (const glm::vec3& spot : spots) {
        distances.push_back(grid.nearest_distance(spot));
        covering.mean += distances.back() / static_cast<double>(spots.size());
    }
    const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(spots.size() - 1));
    std::nth_element(distances.begin(), rank, distances.end());
    covering.percentile_99 = *rank;
    covering.largest = *std::max_element(rank, distances.end());
    return covering;
}

double mean_distance_to_surface(std::span<const glm::vec3> points, const model::Mesh& mesh,
                                std::span<const glm::vec3> positions) {
    const std::vector<Triangle> triangles = triangles_of(mesh, positions);
    double sum = 0;
    for (const glm::vec3& point : points) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Triangle& triangle : triangles) nearest = std::min(nearest, distance_to_triangle(point, triangle));
        sum += nearest;
    }
    return sum / static_cast<double>(points.size());
}

}  // namespace bench
