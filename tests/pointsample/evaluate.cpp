#include "tests/pointsample/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tests {
namespace {

struct Triangle {
    glm::dvec3 a, b, c;

    double area() const {
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        return std::isfinite(area) ? area : 0.0;
    }
};

Triangle triangle_of(const model::Mesh& mesh, std::size_t i) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[3 * i + k]]); };
    return {corner(0), corner(1), corner(2)};
}

// Rounded, so that what is flat has one normal and no cut comes between.
glm::dvec3 normal_of(const Triangle& t) {
    return glm::dvec3(glm::vec3(glm::normalize(glm::cross(t.b - t.a, t.c - t.a))));
}

// A uniform grid over a prefix; points sorted by cell.
class Grid {
public:
    Grid(const Sample& sample, std::size_t prefix, double cell) : sample_(sample), cell_(cell) {
        low_ = sample.positions[0];
        glm::dvec3 high = low_;
        for (std::size_t i = 0; i < prefix; ++i) {
            low_ = glm::min(low_, sample.positions[i]);
            high = glm::max(high, sample.positions[i]);
        }
        constexpr double most_cells = 6e7;
        for (;; cell_ *= 1.3) {
            const glm::dvec3 size = glm::floor((high - low_) / cell_) + 1.0;
            size_ = Index(size);
            if (size.x * size.y * size.z <= most_cells) break;
        }
        start_.assign(static_cast<std::size_t>(size_.x * size_.y * size_.z) + 1, 0);
        for (std::size_t i = 0; i < prefix; ++i) ++start_[cell_of(where(sample.positions[i])) + 1];
        for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
        points_.resize(prefix);
        std::vector<std::uint32_t> at(start_.begin(), start_.end() - 1);
        for (std::size_t i = 0; i < prefix; ++i)
            points_[at[cell_of(where(sample.positions[i]))]++] = static_cast<std::uint32_t>(i);
    }

    // The distance to the nearest point but `self`.
    double nearest(const glm::dvec3& from, const glm::dvec3& normal, std::size_t self, Opposed rule) const {
        double best = std::numeric_limits<double>::infinity();  // squared
        const Index middle = where(from);
        const long rings = std::max({size_.x, size_.y, size_.z});
        for (long ring = 0; ring <= rings; ++ring) {
            const double reach = static_cast<double>(ring - 1) * cell_;  // what is in the ring is farther
            if (reach > 0 && reach * reach > best) break;
            for_each_cell(middle, ring, [&](std::size_t cell) {
                for (std::uint32_t k = start_[cell]; k < start_[cell + 1]; ++k) {
                    const std::size_t i = points_[k];
                    if (i == self) continue;
                    const glm::dvec3 d = sample_.positions[i] - from;
                    const bool doubled = rule == Opposed::doubled && glm::dot(sample_.normals[i], normal) < -0.7;
                    best = std::min(best, (doubled ? 4 : 1) * glm::dot(d, d));
                }
            });
        }
        return std::sqrt(best);
    }

private:
    using Index = glm::vec<3, long>;

    // The cells at this Chebyshev distance.
    template <typename Visit>
    void for_each_cell(const Index& middle, long ring, Visit visit) const {
        for (long z = std::max(middle.z - ring, 0L); z <= std::min(middle.z + ring, size_.z - 1); ++z)
            for (long y = std::max(middle.y - ring, 0L); y <= std::min(middle.y + ring, size_.y - 1); ++y) {
                const bool face = std::abs(z - middle.z) == ring || std::abs(y - middle.y) == ring;
                const long step = face ? 1 : 2 * ring;
                for (long x = middle.x - ring; x <= middle.x + ring; x += step)
                    if (x >= 0 && x < size_.x) visit(cell_of({x, y, z}));
            }
    }
    Index where(const glm::dvec3& p) const {
        return glm::clamp(Index(glm::floor((p - low_) / cell_)), Index(0), size_ - 1L);
    }
    std::size_t cell_of(const Index& c) const {
        return static_cast<std::size_t>((c.z * size_.y + c.y) * size_.x + c.x);
    }

    const Sample& sample_;
    double cell_;
    glm::dvec3 low_;
    Index size_;
    std::vector<std::uint32_t> start_, points_;
};

}  // namespace

Sample sample_of(const pointsample::PointModel& model, const model::Mesh& mesh) {
    Sample out;
    for (std::size_t i = 0; i < model.size(); ++i) {
        out.positions.push_back(model.positions[i]);
        out.normals.push_back(normal_of(triangle_of(mesh, model.surface[i].triangle)));
    }
    return out;
}

double densest(double area, std::size_t n) {
    return 2 * std::sqrt(area / (2 * std::sqrt(3.0) * static_cast<double>(n)));
}

double area_of(const model::Mesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) area += triangle_of(mesh, t).area();
    return area;
}

Spread spread(const Sample& sample, std::size_t prefix, double area, Opposed rule) {
    const double unit = densest(area, prefix);
    const Grid grid(sample, prefix, unit);
    Spread out{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = 0; i < prefix; ++i) {
        const double d = grid.nearest(sample.positions[i], sample.normals[i], i, rule) / unit;
        out.min = std::min(out.min, d);
        out.mean += d;
    }
    out.mean /= static_cast<double>(prefix);
    return out;
}

Cover cover(const Sample& surface, const Sample& sample, std::size_t prefix, double area, Opposed rule) {
    const double unit = densest(area, prefix);
    const Grid grid(sample, prefix, unit);
    std::vector<double> d(surface.size());
    Cover out;
    for (std::size_t i = 0; i < d.size(); ++i) {
        d[i] = grid.nearest(surface.positions[i], surface.normals[i], sample.size(), rule) / unit;
        out.rms += d[i] * d[i];
    }
    out.rms = std::sqrt(out.rms / static_cast<double>(d.size()));
    const std::size_t at = d.size() * 99 / 100;
    std::nth_element(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(at), d.end());
    out.p99 = d[at];
    out.max = *std::max_element(d.begin() + static_cast<std::ptrdiff_t>(at), d.end());
    return out;
}

Sample dense(const model::Mesh& mesh, std::size_t count) {
    const double area = area_of(mesh);
    Sample out;
    double along = 0.5;
    double number = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Triangle triangle = triangle_of(mesh, t);
        const double own = triangle.area();
        if (!(own > 0)) continue;
        const glm::dvec3 normal = normal_of(triangle);
        for (along += own / area * static_cast<double>(count); along >= 1; along -= 1, ++number) {
            double u = 0.7548776662466927 * number, v = 0.5698402909980532 * number;
            u -= std::floor(u), v -= std::floor(v);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            out.positions.push_back(triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a));
            out.normals.push_back(normal);
        }
    }
    return out;
}

Patches::Patches(const Sample& surface, int levels, bool by_normal)
    : cuts_((std::size_t{1} << levels) - 1), expected_(std::size_t{1} << levels) {
    std::vector<std::uint32_t> all(surface.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<std::span<std::uint32_t>> cells(cuts_.size() + expected_.size());
    cells[0] = all;
    for (std::size_t node = 0; node < cuts_.size(); ++node) {
        const std::span<std::uint32_t> cell = cells[node];
        const Cut cut = cut_of(surface, cell, by_normal);
        const auto middle = std::partition(cell.begin(), cell.end(),
                                           [&](std::uint32_t i) { return coordinate(surface, i, cut.axis) < cut.at; });
        const std::size_t lower = static_cast<std::size_t>(middle - cell.begin());
        cuts_[node] = cut;
        cells[2 * node + 1] = cell.first(lower);
        cells[2 * node + 2] = cell.subspan(lower);
    }
    for (std::size_t i = 0; i < expected_.size(); ++i)
        expected_[i] = static_cast<double>(cells[cuts_.size() + i].size()) / static_cast<double>(surface.size());
}

double Patches::coordinate(const Sample& sample, std::size_t i, int axis) {
    return axis < 3 ? sample.positions[i][axis] : sample.normals[i][axis - 3];
}

Patches::Cut Patches::cut_of(const Sample& surface, std::span<std::uint32_t> cell, bool by_normal) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low[6], high[6];
    std::fill_n(low, 6, infinity), std::fill_n(high, 6, -infinity);
    for (const std::uint32_t i : cell)
        for (int a = 0; a < 6; ++a) {
            low[a] = std::min(low[a], coordinate(surface, i, a));
            high[a] = std::max(high[a], coordinate(surface, i, a));
        }
    int axis = 0;
    for (int a = 1; a < 3; ++a)
        if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    for (int a = 3; by_normal && a < 6; ++a)  // only where that parts opposed sides
        if (low[a] < -0.7 && high[a] > 0.7 && (axis < 3 || high[a] - low[a] > high[axis] - low[axis])) axis = a;

    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        return coordinate(surface, a, axis) < coordinate(surface, b, axis);
    };
    const std::size_t half = cell.size() / 2, slack = cell.size() / (axis < 3 ? 64 : 4);
    const std::size_t first = half - slack, last = std::min(half + slack + 1, cell.size());
    const auto begin = cell.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = cell.begin() + static_cast<std::ptrdiff_t>(last);
    std::nth_element(cell.begin(), begin, cell.end(), less);
    if (end != cell.end()) std::nth_element(begin, end, cell.end(), less);
    std::sort(begin, end, less);
    Cut cut{axis, coordinate(surface, cell[half], axis)};
    double widest = -1;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double below = coordinate(surface, cell[i - 1], axis), above = coordinate(surface, cell[i], axis);
        if (above - below <= widest) continue;
        widest = above - below;
        cut.at = 0.5 * (below + above);
    }
    return cut;
}

std::size_t Patches::patch_of(const glm::dvec3& position, const glm::dvec3& normal) const {
    std::size_t node = 0;
    while (node < cuts_.size()) {
        const Cut& cut = cuts_[node];
        const double v = cut.axis < 3 ? position[cut.axis] : normal[cut.axis - 3];
        node = 2 * node + (v < cut.at ? 1 : 2);
    }
    return node - cuts_.size();
}

double Patches::chi2(const Sample& sample, std::size_t prefix) const {
    std::vector<double> found(expected_.size(), 0.0);
    for (std::size_t i = 0; i < prefix; ++i) ++found[patch_of(sample.positions[i], sample.normals[i])];
    double sum = 0;
    std::size_t used = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double expected = expected_[i] * static_cast<double>(prefix);
        if (!(expected > 0)) continue;
        sum += (found[i] - expected) * (found[i] - expected) / expected;
        ++used;
    }
    return sum / static_cast<double>(used - 1);
}

}  // namespace tests
