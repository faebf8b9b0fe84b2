#include "render/covering.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <queue>
#include <span>

#include "model/unorm.h"

namespace render {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

// Radii and places are floats.
constexpr float rounding = 1.0001f;

// Numbers of points that have one radius, that of the fewest of them: each is its own up to 16, then eight an octave.
std::uint32_t rung_of(std::uint32_t count) {
    if (count < 8) return count;
    const auto octave = static_cast<std::uint32_t>(std::bit_width(count)) - 4;
    return 8 * octave + (count >> octave);
}

std::uint32_t fewest_of(std::uint32_t rung) {
    if (rung < 8) return rung;
    return (8 + rung % 8) << (rung / 8 - 1);
}

// The first rung of which all numbers have a point.
std::uint32_t rung_with(std::uint32_t point) {
    return rung_of(point) + 1;
}

// A part of a triangle, by its corners' barycentrics of the triangle's second and third corner.
struct Piece {
    std::uint32_t triangle;
    std::array<glm::vec2, 3> corners;
    float size;  // of its longest edge in the poses that it was cut in [model units]

    glm::vec2 middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0f; }
};

// Points of a pose, axis by axis [model units].
struct Axes {
    std::vector<float> x, y, z;

    explicit Axes(std::span<const glm::vec3> points) {
        for (const glm::vec3& point : points) {
            x.push_back(point.x);
            y.push_back(point.y);
            z.push_back(point.z);
        }
    }
    float squared_distance(std::size_t point, const glm::vec3& from) const {
        const float dx = x[point] - from.x, dy = y[point] - from.y, dz = z[point] - from.z;
        return dx * dx + dy * dy + dz * dz;
    }
};

// A pose unpacked.
struct Pose {
    std::vector<glm::vec3> vertices;
    Axes points;
};

std::vector<glm::vec3> unpacked(std::span<const motion::PosedVertex> packed, const motion::Bounds& box) {
    std::vector<glm::vec3> places;
    for (const motion::PosedVertex& vertex : packed) places.push_back(motion::unpack_position(vertex, box));
    return places;
}

std::span<const motion::PosedVertex> row(const std::vector<motion::PosedVertex>& all, std::size_t pose, int count) {
    return std::span(all).subspan(pose * static_cast<std::size_t>(count), static_cast<std::size_t>(count));
}

// Poses that are spread evenly stand for all where pieces are cut and neighbours looked for: whichever are found, the
// bound holds.
std::vector<Pose> spread_poses(const motion::PoseTable& table) {
    constexpr int most = 6;
    const int count = std::min(most, table.pose_count);
    std::vector<Pose> poses;
    for (int i = 0; i < count; ++i) {
        // From the first on, which the standing are in; the last of them is one step from the end.
        const auto pose = static_cast<std::size_t>(i * static_cast<std::int64_t>(table.pose_count) / count);
        poses.push_back({unpacked(row(table.vertices, pose, table.vertex_count), table.box),
                         Axes(unpacked(row(table.points, pose, table.point_count), table.box))});
    }
    return poses;
}

glm::vec3 place_of(const model::Mesh& mesh, std::uint32_t triangle, glm::vec2 at, std::span<const glm::vec3> vertices) {
    const std::uint32_t* corner = &mesh.indices[std::size_t{3} * triangle];
    return vertices[corner[0]] * (1.0f - at.x - at.y) + vertices[corner[1]] * at.x + vertices[corner[2]] * at.y;
}

float edge_of(const model::Mesh& mesh, const Piece& piece, int corner, std::span<const Pose> poses) {
    float most = 0;
    for (const Pose& pose : poses)
        most = std::max(most,
                        glm::distance(place_of(mesh, piece.triangle, piece.corners[corner], pose.vertices),
                                      place_of(mesh, piece.triangle, piece.corners[(corner + 1) % 3], pose.vertices)));
    return most;
}

// All triangles, the largest cut in halves across their longest edge until all are small beside the gaps between
// points, or there are as many as may be.
std::vector<Piece> cut(const model::Mesh& mesh, std::span<const Pose> poses, float small, std::size_t most) {
    const auto smaller = [](const Piece& a, const Piece& b) { return a.size < b.size; };
    std::priority_queue<Piece, std::vector<Piece>, decltype(smaller)> queue(smaller);
    const auto add = [&](Piece piece) {
        const float edges[] = {edge_of(mesh, piece, 0, poses), edge_of(mesh, piece, 1, poses),
                               edge_of(mesh, piece, 2, poses)};
        const auto longest = std::max_element(edges, edges + 3) - edges;
        piece.size = edges[longest];
        std::rotate(piece.corners.begin(), piece.corners.begin() + longest, piece.corners.end());  // it comes first
        queue.push(piece);
    };
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle)
        add({triangle, {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}, 0});
    while (queue.size() < most && queue.top().size > small) {
        const Piece piece = queue.top();
        queue.pop();
        const auto& [a, b, c] = piece.corners;
        const glm::vec2 half = 0.5f * (a + b);
        add({piece.triangle, {a, half, c}, 0});
        add({piece.triangle, {half, b, c}, 0});
    }
    std::vector<Piece> pieces;
    for (; !queue.empty(); queue.pop()) pieces.push_back(queue.top());
    std::ranges::sort(pieces, {}, &Piece::triangle);
    return pieces;
}

// The nearest of some points, [first, end): in lanes, which compilers make vectors of.
float nearest(const Axes& points, std::size_t first, std::size_t end, const glm::vec3& from) {
    constexpr std::size_t width = 8;
    float least[width];
    std::ranges::fill(least, infinite);
    std::size_t i = first;
    for (; i + width <= end; i += width)
        for (std::size_t lane = 0; lane < width; ++lane) {
            const float squared = points.squared_distance(i + lane, from);
            least[lane] = squared < least[lane] ? squared : least[lane];
        }
    for (; i < end; ++i) least[0] = std::min(least[0], points.squared_distance(i, from));
    return *std::ranges::min_element(least);
}

// Of a piece, the points that may be nearest to it, rising: rung by rung those that are much nearer in some pose than
// what there was. Where many points are, two poses find them: they are of the same limb in all.
std::vector<std::uint32_t> find_neighbours(const model::Mesh& mesh, const Piece& piece, std::span<const Pose> poses) {
    constexpr float nearer = 0.99f;  // squared
    constexpr std::size_t many = 1024, few_poses = 2;
    std::vector<glm::vec3> from;
    for (const Pose& pose : poses) from.push_back(place_of(mesh, piece.triangle, piece.middle(), pose.vertices));
    std::vector<float> best(poses.size(), infinite);
    std::vector<std::uint32_t> found;
    const std::size_t all = poses[0].points.x.size();
    for (std::uint32_t rung = 0; fewest_of(rung) < all; ++rung) {
        const std::size_t first = fewest_of(rung), end = std::min<std::size_t>(fewest_of(rung + 1), all);
        const std::size_t old = found.size();
        const std::size_t looked_at = first < many ? poses.size() : std::min(few_poses, poses.size());
        for (std::size_t pose = 0; pose < looked_at; ++pose) {
            const Axes& points = poses[pose].points;
            const float squared = nearest(points, first, end, from[pose]);
            if (squared >= nearer * best[pose]) continue;
            best[pose] = squared;
            std::size_t point = first;
            while (points.squared_distance(point, from[pose]) > squared) ++point;
            found.push_back(static_cast<std::uint32_t>(point));
        }
        std::sort(found.begin() + old, found.end());
        found.erase(std::unique(found.begin() + old, found.end()), found.end());
    }
    return found;
}

// Something in some poses at once.
constexpr std::size_t lanes = 8;
using Lanes = std::array<float, lanes>;
struct Places {
    Lanes x, y, z;
};

// Some poses of a table, all of their vertices or points.
void unpack(const std::vector<motion::PosedVertex>& all, int count, const motion::Bounds& box, std::size_t first_pose,
            std::size_t pose_count, std::vector<Places>& out) {
    out.resize(static_cast<std::size_t>(count));
    const glm::vec3 step = box.size() / static_cast<float>(model::unorm_steps);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        // Behind the last pose comes that one again.
        const std::span<const motion::PosedVertex> packed =
            row(all, std::min(first_pose + lane, pose_count - 1), count);
        for (std::size_t i = 0; i < packed.size(); ++i) {
            out[i].x[lane] = box.min.x + step.x * static_cast<float>(packed[i].x);
            out[i].y[lane] = box.min.y + step.y * static_cast<float>(packed[i].y);
            out[i].z[lane] = box.min.z + step.z * static_cast<float>(packed[i].z);
        }
    }
}

Places blend(const Places& a, const Places& b, const Places& c, glm::vec2 at) {
    const float rest = 1.0f - at.x - at.y;
    Places out;
    for (std::size_t i = 0; i < lanes; ++i) {
        out.x[i] = rest * a.x[i] + at.x * b.x[i] + at.y * c.x[i];
        out.y[i] = rest * a.y[i] + at.x * b.y[i] + at.y * c.y[i];
        out.z[i] = rest * a.z[i] + at.x * b.z[i] + at.y * c.z[i];
    }
    return out;
}

Lanes squared_distances(const Places& a, const Places& b) {
    Lanes out;
    for (std::size_t i = 0; i < lanes; ++i) {
        const float x = a.x[i] - b.x[i], y = a.y[i] - b.y[i], z = a.z[i] - b.z[i];
        out[i] = x * x + y * y + z * z;
    }
    return out;
}

float largest(const Lanes& of) {
    std::array<float, lanes / 2> half;
    for (std::size_t i = 0; i < lanes / 2; ++i) half[i] = of[i] > of[i + lanes / 2] ? of[i] : of[i + lanes / 2];
    return std::max(std::max(half[0], half[1]), std::max(half[2], half[3]));
}

// All of a piece is as far from its middle, at most, as its farthest corner.
class Tile {
public:
    void unpack(const motion::PoseTable& table, std::size_t first_pose) {
        const auto poses = static_cast<std::size_t>(table.pose_count);
        render::unpack(table.vertices, table.vertex_count, table.box, first_pose, poses, vertices_);
        render::unpack(table.points, table.point_count, table.box, first_pose, poses, points_);
    }

    // The largest distance of any of the piece, into the last rung of each number of neighbours.
    void widen(const model::Mesh& mesh, const Piece& piece, std::span<const std::uint32_t> neighbours,
               std::span<float> radii) const {
        const std::uint32_t* corner = &mesh.indices[std::size_t{3} * piece.triangle];
        const Places &a = vertices_[corner[0]], &b = vertices_[corner[1]], &c = vertices_[corner[2]];
        const Places middle = blend(a, b, c, piece.middle());
        float reach = 0;
        for (const glm::vec2& at : piece.corners)
            reach = std::max(reach, largest(squared_distances(blend(a, b, c, at), middle)));
        reach = std::sqrt(reach);
        Lanes nearest;
        nearest.fill(infinite);
        for (std::size_t i = 0; i < neighbours.size(); ++i) {
            const Lanes squared = squared_distances(points_[neighbours[i]], middle);
            for (std::size_t lane = 0; lane < lanes; ++lane)
                nearest[lane] = squared[lane] < nearest[lane] ? squared[lane] : nearest[lane];
            const std::size_t end = i + 1 < neighbours.size() ? rung_with(neighbours[i + 1]) : radii.size();
            if (end == rung_with(neighbours[i])) continue;
            radii[end - 1] = std::max(radii[end - 1], std::sqrt(largest(nearest)) + reach);
        }
    }

private:
    std::vector<Places> vertices_, points_;
};

}  // namespace

Covering::Covering(const figures::Figure& figure) {
    const motion::PoseTable& table = *figure.poses;
    if (table.point_count == 0) return;
    const auto points = static_cast<std::uint32_t>(table.point_count);
    const auto poses = static_cast<std::size_t>(table.pose_count);
    // Looked at with all their neighbours in every pose: some ten nanoseconds each.
    constexpr std::size_t most_posed_pieces = 2'000'000, most_pieces = 6'000;
    const float small = 0.5f * std::sqrt(table.area / static_cast<float>(points));
    const std::vector<Pose> some = spread_poses(table);
    const std::vector<Piece> pieces = cut(*figure.mesh, some, small, std::min(most_posed_pieces / poses, most_pieces));
    std::vector<std::vector<std::uint32_t>> neighbours(pieces.size());
    tbb::parallel_for(std::size_t{0}, pieces.size(),
                      [&](std::size_t i) { neighbours[i] = find_neighbours(*figure.mesh, pieces[i], some); });

    point_count_ = points;
    radii_.assign(rung_with(points - 1) + 1, 0.0f);
    tbb::enumerable_thread_specific<std::vector<float>> found(radii_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (poses + lanes - 1) / lanes),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          Tile tile;
                          std::vector<float>& radii = found.local();
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              tile.unpack(table, i * lanes);
                              for (std::size_t piece = 0; piece < pieces.size(); ++piece)
                                  tile.widen(*figure.mesh, pieces[piece], neighbours[piece], radii);
                          }
                      });
    for (const std::vector<float>& one : found)
        for (std::size_t i = 0; i < radii_.size(); ++i) radii_[i] = std::max(radii_[i], rounding * one[i]);
    for (std::size_t i = radii_.size() - 1; i > 0; --i) radii_[i - 1] = std::max(radii_[i - 1], radii_[i]);
    radii_[0] = infinite;
}

float Covering::radius(std::uint32_t count) const {
    if (radii_.empty()) return infinite;
    return count < point_count_ ? radii_[rung_of(count)] : radii_.back();
}

}  // namespace render
