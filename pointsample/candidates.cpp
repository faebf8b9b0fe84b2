#include "pointsample/candidates.h"

#include <algorithm>
#include <cmath>

#include "pointsample/surface_line.h"
#include "sfsm/random.h"

namespace pointsample {
namespace {

using sfsm::lower_unit;
using sfsm::stream;
using sfsm::unit;
using sfsm::upper_unit;

// How far a candidate strays from the middle of its cell, in cells. Less would show the grid, more brings nothing.
constexpr float jitter = 0.5f;

// Uniform in the cell; drawn to its middle by 1 - spread.
glm::vec2 place_in(const Cell& cell, std::uint64_t random, float spread) {
    float s = upper_unit(random), t = lower_unit(random);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    constexpr float third = 1.0f / 3.0f;
    s = third + spread * (s - third);
    t = third + spread * (t - third);
    return cell.from + s * (cell.to - cell.from) + t * (cell.apex - cell.from);
}

}  // namespace

void Candidates::reserve(std::size_t candidates) {
    const std::size_t whole = candidates / leaf_size + 1;
    leaves.reserve(whole);
    normals.reserve(whole);
    surface.reserve(whole * leaf_size);
}

void Candidates::put(std::size_t i, const Place& place, float stretch, const motion::SurfacePoint& point) {
    Leaf& leaf = leaves[i / leaf_size];
    LeafNormals& normal = normals[i / leaf_size];
    const std::size_t k = i % leaf_size;
    leaf.x[k] = place.position.x, leaf.y[k] = place.position.y, leaf.z[k] = place.position.z;
    normal.x[k] = place.normal.x, normal.y[k] = place.normal.y, normal.z[k] = place.normal.z;
    normal.stretch[k] = stretch;
    surface[i] = point;
}

void Candidates::append(const Place& place, float stretch, const motion::SurfacePoint& point) {
    if (count % leaf_size == 0) {
        leaves.emplace_back();
        normals.emplace_back();
        surface.resize(surface.size() + leaf_size);
    }
    put(count++, place, stretch, point);
}

void Candidates::pad() {
    for (std::size_t i = count; i < leaves.size() * leaf_size; ++i)
        put(i, place(count - 1), stretch(count - 1), surface[count - 1]);
}

void Candidates::keep(std::size_t first, std::span<const char> kept) {
    std::size_t to = first;
    for (std::size_t i = first; i < count; ++i)
        if (kept[i - first]) put(to++, place(i), stretch(i), surface[i]);
    count = to;
    const std::size_t whole = (count + leaf_size - 1) / leaf_size;
    leaves.resize(whole);
    normals.resize(whole);
    surface.resize(whole * leaf_size);
}

Stratifier::Stratifier(const Surface& surface, std::span<const std::uint32_t> line, std::size_t count,
                       std::uint64_t seed)
    : surface_(surface),
      line_(line),
      count_(count),
      seed_(seed),
      step_(surface.total_area() / static_cast<double>(count)) {
    enter_triangle();
}

void Stratifier::enter_triangle() {
    const std::uint32_t triangle = line_[slot_];
    const double area = surface_.area(triangle);
    end_ = start_ + area;
    const std::vector<glm::vec3>& positions = surface_.poses().front().positions;
    for (std::size_t k = 0; k < 3; ++k)
        corners_[k] = surface_.scaled(positions[surface_.indices()[std::size_t{3} * triangle + k]]);
    normal_ = face_normal(surface_.indices(), surface_.poses().front(), triangle);
    // Down to cells a few times smaller than a candidate's.
    const double cells = area / step_;
    halvings_ = cells < 0.25 ? 0 : std::min(40, std::max(0, std::ilogb(cells) + 3));
}

void Stratifier::go_to(double at) {
    if (at < end_ || slot_ + 1 == line_.size()) return;
    do {
        start_ = end_;
        end_ += surface_.area(line_[++slot_]);
    } while (at >= end_ && slot_ + 1 < line_.size());
    enter_triangle();
}

void Stratifier::append(std::size_t count, Candidates& out) {
    for (const std::size_t last = next_ + std::min(count, left()); next_ < last; ++next_) {
        // The place on the line is random in the candidate's cell; the place in the triangle follows from that, down to
        // the smallest cells, and is random within.
        const double within = 0.5 + static_cast<double>(jitter) * (unit(stream(seed_, 2 * next_)) - 0.5);
        const double at = (static_cast<double>(next_) + within) * step_;
        go_to(at);
        const double along = std::clamp((at - start_) / (end_ - start_), 0.0, 0x1.fffffep-1);
        const glm::vec2 uv = place_in(cell_along(corners_[0], corners_[1], corners_[2], along, halvings_),
                                      stream(seed_, 2 * next_ + 1), halvings_ == 0 ? 1.0f : jitter);
        const float u = std::clamp(uv.x, 0.0f, 1.0f), v = std::clamp(uv.y, 0.0f, 1.0f - u);
        const glm::vec3 position = (1.0f - u - v) * corners_[0] + u * corners_[1] + v * corners_[2];
        const std::uint32_t triangle = line_[slot_];
        out.append({position, normal_}, surface_.stretch(triangle), {triangle, u, v});
    }
}

}  // namespace pointsample
