#include "pointsample/sample.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "motion/pose.h"
#include "pointsample/srgb.h"
#include "pointsample/visibility.h"

namespace pointsample {
namespace {

using motion::Mesh;
using motion::SurfacePoint;

// A triangle while the surface is being ordered.
struct Piece {
    glm::vec3 center;
    std::uint32_t triangle;
    double area;
};

// Reorders `cell` (at least two pieces) so that its first part, whose count is returned, lies on one side along the
// longest axis and has half of the area, as nearly as whole pieces allow. Neither part is empty. Linear time.
std::size_t halve(std::span<Piece> cell) {
    glm::vec3 low = cell[0].center, high = low;
    double area = 0;
    for (const Piece& piece : cell) {
        low = glm::min(low, piece.center);
        high = glm::max(high, piece.center);
        area += piece.area;
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto before = [axis](const Piece& a, const Piece& b) {
        return a.center[axis] < b.center[axis] || (a.center[axis] == b.center[axis] && a.triangle < b.triangle);
    };
    // A selection by area: [0, first) is below the half, [last, size) above it.
    std::size_t first = 0, last = cell.size();
    double below = 0;
    while (last - first > 1) {
        const std::size_t middle = first + (last - first) / 2;
        std::nth_element(cell.begin() + static_cast<std::ptrdiff_t>(first),
                         cell.begin() + static_cast<std::ptrdiff_t>(middle),
                         cell.begin() + static_cast<std::ptrdiff_t>(last), before);
        double lower = 0;
        for (std::size_t i = first; i < middle; ++i) lower += cell[i].area;
        if (below + lower <= 0.5 * area) {
            below += lower;
            first = middle;
        } else {
            last = middle;
        }
    }
    // The piece at `first` crosses the half: it goes where that leaves the smaller difference.
    const bool take = below + 0.5 * cell[first].area < 0.5 * area;
    return std::clamp<std::size_t>(first + (take ? 1 : 0), 1, cell.size() - 1);
}

// The surface as one line of length `area()`: its triangles one after another, each as long as its area, in the order
// of a tree that halves the area across the longest side of its cells. So the line's halves, quarters, eighths ... are
// compact patches of the surface. Triangles without a finite area are left out.
class SurfaceLine {
public:
    SurfaceLine(const Mesh& mesh, const std::vector<glm::vec3>& positions) : mesh_(mesh), positions_(positions) {
        for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
            const std::uint32_t triangle = static_cast<std::uint32_t>(i);
            if (area_of(triangle) > 0) triangles_.push_back(triangle);
        }
        order_by_halving();
        ends_.reserve(triangles_.size());
        double end = 0;
        for (const std::uint32_t triangle : triangles_) ends_.push_back(end += area_of(triangle));
        if (!(end > 0) || !std::isfinite(end))
            throw std::runtime_error("found no triangle with an area; expected a surface to sample");
    }

    double area() const { return ends_.back(); }

    // The point at `along` in [0, 1) of the line.
    SurfacePoint at(double along) const {
        const double position = along * area();
        const auto end = std::upper_bound(ends_.begin(), ends_.end() - 1, position);
        const std::size_t slot = static_cast<std::size_t>(end - ends_.begin());
        const double start = slot == 0 ? 0.0 : ends_[slot - 1];
        return inside(triangles_[slot], std::clamp((position - start) / (*end - start), 0.0, 1.0));
    }

private:
    glm::dvec3 corner(std::uint32_t triangle, std::size_t i) const {
        return positions_[mesh_.indices[std::size_t{3} * triangle + i]];
    }

    // 0 if it is not finite.
    double area_of(std::uint32_t triangle) const {
        const glm::dvec3 a = corner(triangle, 0);
        const double area = 0.5 * glm::length(glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a));
        return std::isfinite(area) ? area : 0.0;
    }

    void order_by_halving() {
        std::vector<Piece> pieces;
        for (const std::uint32_t triangle : triangles_) {
            const glm::dvec3 center = (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0;
            pieces.push_back({glm::vec3(center), triangle, area_of(triangle)});
        }
        std::vector<std::span<Piece>> cells{pieces};
        while (!cells.empty()) {
            const std::span<Piece> cell = cells.back();
            cells.pop_back();
            if (cell.size() < 2) continue;
            const std::size_t half = halve(cell);
            cells.push_back(cell.first(half));
            cells.push_back(cell.subspan(half));
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) triangles_[i] = pieces[i].triangle;
    }

    // Sierpinski's curve through one triangle, `along` in [0, 1]: from the first end of the longest edge to its second,
    // halving the triangle at that edge's middle again and again. Halves have equal areas, so area is preserved.
    SurfacePoint inside(std::uint32_t triangle, double along) const {
        std::size_t first = 0;
        double longest = -1;
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = glm::distance(corner(triangle, i), corner(triangle, (i + 1) % 3));
            if (length > longest) longest = length, first = i;
        }
        // Corners as barycentrics of the triangle's second and third.
        static constexpr std::array<glm::dvec2, 3> corners{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
        glm::dvec2 from = corners[first], to = corners[(first + 1) % 3], apex = corners[(first + 2) % 3];
        constexpr int halvings = 40;  // down to 2^-20 of an edge
        for (int i = 0; i < halvings; ++i) {
            const glm::dvec2 middle = 0.5 * (from + to);
            along *= 2;
            if (along < 1) {
                to = apex;
            } else {
                along -= 1;
                from = apex;
            }
            apex = middle;
        }
        const glm::dvec2 center = (from + to + apex) / 3.0;
        const float u = static_cast<float>(center.x), v = static_cast<float>(center.y);
        return {triangle, u, std::min(v, 1.0f - u)};
    }

    const Mesh& mesh_;
    const std::vector<glm::vec3>& positions_;
    std::vector<std::uint32_t> triangles_;
    std::vector<double> ends_;
};

// Where the seed's sequence starts (splitmix64: neighbouring seeds start far apart).
std::uint64_t start_of(std::uint64_t seed) {
    seed += 0x9e3779b97f4a7c15u;
    seed = (seed ^ seed >> 30) * 0xbf58476d1ce4e5b9u;
    seed = (seed ^ seed >> 27) * 0x94d049bb133111ebu;
    return seed ^ seed >> 31;
}

// Element `index` of the golden-ratio sequence in [0, 1), in exact 64-bit arithmetic: whatever the prefix, the gaps
// between its elements have at most three lengths, within a factor of 2.62 (the three-distance theorem).
double golden(std::uint64_t start, std::uint64_t index) {
    constexpr std::uint64_t golden_fraction = 0x9e3779b97f4a7c15u;  // (sqrt(5) - 1) / 2 * 2^64
    return static_cast<double>((start + index * golden_fraction) >> 11) * 0x1p-53;
}

// Linear light.
glm::vec3 linear(const glm::u8vec4& color) {
    return {linear_of_srgb(color.r), linear_of_srgb(color.g), linear_of_srgb(color.b)};
}

// Bilinear, wrapping, in linear light.
glm::vec3 texture_at(const motion::Texture& texture, const glm::vec2& uv) {
    const glm::vec2 size(texture.width, texture.height);
    const glm::vec2 at = (uv - glm::floor(uv)) * size - 0.5f;
    const glm::vec2 corner = glm::floor(at), s = at - corner;
    const auto texel = [&](int dx, int dy) {
        const int x = (static_cast<int>(corner.x) + dx + texture.width) % texture.width;
        const int y = (static_cast<int>(corner.y) + dy + texture.height) % texture.height;
        return linear(texture.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                                     static_cast<std::size_t>(x)]);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), s.x), glm::mix(texel(0, 1), texel(1, 1), s.x), s.y);
}

// One triangle's corners and how much of each a point has.
struct Corners {
    std::array<std::uint32_t, 3> vertex;
    std::array<float, 3> share;

    Corners(const Mesh& mesh, const SurfacePoint& point) : share{1.0f - point.u - point.v, point.u, point.v} {
        std::copy_n(mesh.indices.begin() + std::ptrdiff_t{3} * point.triangle, 3, vertex.begin());
    }
    template <typename Get>
    auto blend(Get get) const {
        return get(vertex[0]) * share[0] + get(vertex[1]) * share[1] + get(vertex[2]) * share[2];
    }
    std::uint32_t nearest() const {
        return vertex[static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin())];
    }
};

glm::vec3 position_of(const Corners& corners, const std::vector<glm::vec3>& positions) {
    return corners.blend([&](std::uint32_t i) { return positions[i]; });
}

// Interpolated; where the corners' normals cancel out, the triangle's own.
glm::vec3 normal_of(const Corners& corners, const std::vector<glm::vec3>& positions,
                    const std::vector<glm::vec3>& normals) {
    glm::dvec3 normal = corners.blend([&](std::uint32_t i) { return normals[i]; });
    double length = glm::length(normal);
    if (!(length > 1e-6) || !std::isfinite(length)) {
        const glm::dvec3 a = positions[corners.vertex[0]];
        normal = glm::cross(glm::dvec3(positions[corners.vertex[1]]) - a, glm::dvec3(positions[corners.vertex[2]]) - a);
        length = glm::length(normal);
    }
    return glm::vec3(normal / length);
}

glm::u8vec4 color_of(const Mesh& mesh, const Corners& corners) {
    glm::vec3 light = corners.blend([&](std::uint32_t i) { return linear(mesh.colors[i]); });
    const float alpha = corners.blend([&](std::uint32_t i) { return static_cast<float>(mesh.colors[i].a); });
    const std::uint8_t texture = mesh.texture_ids[corners.vertex[0]];
    if (texture != motion::no_texture)
        light *= texture_at(mesh.textures[texture], corners.blend([&](std::uint32_t i) { return mesh.uvs[i]; }));
    return {srgb_of_linear(light.r), srgb_of_linear(light.g), srgb_of_linear(light.b),
            static_cast<std::uint8_t>(std::min(alpha + 0.5f, 255.0f))};
}

// The corners' influences, the same joint once, and of those the four heaviest.
void append_influences(const Mesh& mesh, const Corners& corners, PointModel& out) {
    std::array<std::pair<float, std::uint16_t>, 12> found{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            const float weight = mesh.weights[corners.vertex[i]][k] * corners.share[i];
            const std::uint16_t joint = mesh.joints[corners.vertex[i]][k];
            if (!(weight > 0.0f)) continue;
            std::size_t at = 0;
            while (at < count && found[at].second != joint) ++at;
            if (at == count) found[count++] = {0.0f, joint};
            found[at].first += weight;
        }
    }
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), [](const auto& a, const auto& b) {
        return a.first > b.first || (a.first == b.first && a.second < b.second);
    });
    glm::u16vec4 joints(0);
    glm::vec4 weights(0.0f);
    float sum = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) sum += found[i].first;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) {
        joints[static_cast<int>(i)] = found[i].second;
        weights[static_cast<int>(i)] = found[i].first / sum;
    }
    if (!(sum > 0.0f)) weights.x = 1.0f;
    out.joints.push_back(joints);
    out.weights.push_back(weights);
}

class Sampler {
public:
    Sampler(const Mesh& mesh, const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals,
            const SampleOptions& options)
        : mesh_(mesh), positions_(positions), normals_(normals), options_(options), line_(mesh, positions) {
        if (options.visible_only) visibility_.emplace(positions, mesh.indices);
    }

    PointModel run(const std::function<void(double)>& progress) {
        PointModel out;
        out.area = static_cast<float>(line_.area());
        const std::uint64_t start = start_of(options_.seed);
        std::uint64_t next = 0;
        while (out.size() < options_.count) {
            const std::vector<SurfacePoint> candidates = batch(start, next, options_.count - out.size());
            const std::vector<char> visible = see(candidates);
            for (std::size_t i = 0; i < candidates.size() && out.size() < options_.count; ++i) {
                if (visible[i])
                    append(candidates[i], out);
                else
                    ++out.hidden_removed;
            }
            next += candidates.size();
            refuse_the_hidden(next, out.size());
            if (progress) progress(static_cast<double>(out.size()) / static_cast<double>(options_.count));
        }
        return out;
    }

private:
    // Enough candidates to go on with: a few more than are `missing`, as some will be hidden.
    std::vector<SurfacePoint> batch(std::uint64_t start, std::uint64_t first, std::size_t missing) const {
        constexpr std::size_t least = 1024, most = 16384;  // most: progress shows; least: threads have work
        std::vector<SurfacePoint> candidates(std::clamp(missing + missing / 4, least, most));
        for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i] = line_.at(golden(start, first + i));
        return candidates;
    }

    std::vector<char> see(const std::vector<SurfacePoint>& candidates) const {
        std::vector<char> visible(candidates.size(), 1);
        if (!visibility_) return visible;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size()), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const Corners corners(mesh_, candidates[i]);
                visible[i] = visibility_->sees_outside(position_of(corners, positions_),
                                                       normal_of(corners, positions_, normals_), mesh_.double_sided);
            }
        });
        return visible;
    }

    // One visible in a thousand is taken for none, or the search would not end.
    void refuse_the_hidden(std::uint64_t tried, std::size_t kept) const {
        constexpr std::uint64_t patience = 65536;
        if (kept < options_.count && tried >= patience && kept < tried / 1000)
            throw std::runtime_error("found " + std::to_string(kept) + " of " + std::to_string(tried) +
                                     " points visible from outside; expected at least one in a thousand");
    }

    void append(const SurfacePoint& point, PointModel& out) const {
        const Corners corners(mesh_, point);
        out.surface.push_back(point);
        out.positions.push_back(position_of(corners, positions_));
        out.normals.push_back(normal_of(corners, positions_, normals_));
        out.colors.push_back(color_of(mesh_, corners));
        out.tints.push_back(mesh_.tints[corners.nearest()]);
        append_influences(mesh_, corners, out);
    }

    const Mesh& mesh_;
    const std::vector<glm::vec3>&positions_, &normals_;
    const SampleOptions& options_;
    SurfaceLine line_;
    std::optional<Visibility> visibility_;
};

}  // namespace

PointModel sample(const Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options,
                  const std::function<void(double)>& progress) {
    assert(options.count >= 1 && !poses.empty());
    return Sampler(mesh, poses.front().positions, poses.front().normals, options).run(progress);
}

std::vector<PosedMesh> spread_poses(const motion::Character& character, std::span<const int> clips, std::size_t count) {
    assert(count >= 1);
    std::vector<PosedMesh> poses(clips.empty() ? 1 : count);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        motion::Pose pose;
        if (clips.empty()) {
            motion::evaluate_rest(character, pose);
        } else {
            const motion::Clip& clip = character.clips[static_cast<std::size_t>(clips[i % clips.size()])];
            const std::size_t rounds = (poses.size() + clips.size() - 1) / clips.size();
            const double share = static_cast<double>(i / clips.size()) / static_cast<double>(rounds);
            motion::evaluate(character, clip, share * clip.duration, pose);
        }
        motion::skin(character.mesh, pose, poses[i].positions, poses[i].normals);
    }
    return poses;
}

}  // namespace pointsample
