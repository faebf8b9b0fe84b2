// Ear clipping (Meisters 1975); only reflex corners can lie in an ear, and those are looked up by their x.
#include "model/io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace model {
namespace {

// Newell: twice the area along each axis, right for any polygon.
glm::dvec3 normal_of(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i] - corners[0], b = corners[i + 1 < corners.size() ? i + 1 : 0] - corners[0];
        sum += glm::cross(a, b);
    }
    return sum;
}

// Twice the area of a, b, c; above 0 if they turn left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

std::span<const Triangulator::Triangle> Triangulator::cut(std::span<const glm::dvec3> corners) {
    triangles_.clear();
    if (corners.size() == 3) triangles_.push_back({0, 1, 2});
    if (corners.size() <= 3) return triangles_;
    if (!project(corners) || fan_is_right())
        add_fan();
    else
        cut_ears();
    return triangles_;
}

// Leaves out the axis that the polygon faces most, which is exact. False: it faces nowhere.
bool Triangulator::project(std::span<const glm::dvec3> corners) {
    const glm::dvec3 normal = normal_of(corners), size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int right = (axis + 1) % 3, up = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(right, up);
    const auto count = static_cast<std::uint32_t>(corners.size());
    points_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 from_first = corners[i] - corners[0];
        points_[i] = {{from_first[right], from_first[up]}, (i + count - 1) % count, (i + 1) % count, false, false};
    }
    return std::isfinite(normal[axis]) && normal[axis] != 0;
}

bool Triangulator::fan_is_right() const {
    for (std::size_t i = 2; i < points_.size(); ++i)
        if (!(turn(points_[0].at, points_[i - 1].at, points_[i].at) >= 0)) return false;
    return true;
}

void Triangulator::add_fan() {
    for (std::uint32_t i = 2; i < points_.size(); ++i) triangles_.push_back({0, i - 1, i});
}

void Triangulator::cut_ears() {
    constexpr std::uint64_t tests_a_corner = 2000;
    tests_left_ = tests_a_corner * points_.size();
    find_reflex();
    std::uint32_t at = 0;
    std::size_t left = points_.size(), tried = 0;
    while (left > 3) {
        // Round after round with less care where there is no ear: bridges touch, and bad polygons cross.
        const std::size_t round = tried / left;
        if (tests_left_ > 0) --tests_left_;
        const bool cut = tests_left_ == 0 || round > 2 || (round == 2 ? !is_reflex(at) : is_ear(at, round == 1));
        const std::uint32_t next = points_[at].next;
        if (cut) {
            cut_off(at);
            --left;
            tried = 0;
            at = points_[next].next;  // not its neighbour: slivers would share a corner
        } else {
            ++tried;
            at = next;
        }
    }
    triangles_.push_back({points_[at].previous, at, points_[at].next});
}

void Triangulator::find_reflex() {
    reflex_.clear();
    reflex_gone_ = 0;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        points_[i].reflex = is_reflex(i);
        if (points_[i].reflex) reflex_.emplace_back(points_[i].at.x, i);
    }
    std::sort(reflex_.begin(), reflex_.end());
}

bool Triangulator::is_reflex(std::uint32_t point) const {
    const Point& p = points_[point];
    return !(turn(points_[p.previous].at, p.at, points_[p.next].at) > 0);
}

bool Triangulator::is_ear(std::uint32_t tip, bool strictly) {
    const Point& p = points_[tip];
    const glm::dvec2 &a = points_[p.previous].at, &c = points_[p.next].at;
    const double area = turn(a, p.at, c);
    if (!(area >= 0)) return false;
    if (area == 0) return true;  // nothing lies in it
    const auto [least, most] = std::minmax({a.x, p.at.x, c.x});
    auto other = std::lower_bound(reflex_.begin(), reflex_.end(), std::pair(least, std::uint32_t{0}));
    for (; other != reflex_.end() && other->first <= most; ++other) {
        if (tests_left_ > 0) --tests_left_;
        if (tests_left_ == 0 || is_blocked_by(other->second, tip, strictly)) return tests_left_ == 0;
    }
    return true;
}

// Whether `point` lies in the ear of `tip`, or on its cut unless strictly.
bool Triangulator::is_blocked_by(std::uint32_t point, std::uint32_t tip, bool strictly) const {
    const Point &p = points_[tip], &other = points_[point];
    if (other.gone || !other.reflex || point == p.previous || point == p.next) return false;
    const glm::dvec2 &a = points_[p.previous].at, &b = p.at, &c = points_[p.next].at, &q = other.at;
    if (q == a || q == c) return false;
    if (q == b) {  // the outline touches itself here: where does it go on?
        for (const std::uint32_t neighbour : {other.previous, other.next}) {
            const glm::dvec2& n = points_[neighbour].at;
            if (turn(a, b, n) > 0 && turn(b, c, n) > 0) return true;
        }
        return false;
    }
    const double cut = turn(c, a, q);
    return turn(a, b, q) > 0 && turn(b, c, q) > 0 && (strictly ? cut > 0 : cut >= 0);
}

void Triangulator::cut_off(std::uint32_t tip) {
    Point& p = points_[tip];
    triangles_.push_back({p.previous, tip, p.next});
    points_[p.previous].next = p.next;
    points_[p.next].previous = p.previous;
    p.gone = true;
    if (p.reflex) ++reflex_gone_;
    for (const std::uint32_t neighbour : {p.previous, p.next}) {
        const bool before = points_[neighbour].reflex, now = is_reflex(neighbour);
        points_[neighbour].reflex = now;
        if (before && !now) ++reflex_gone_;
        if (before || !now) continue;
        // Where a spike was cut off.
        const std::pair entry(points_[neighbour].at.x, neighbour);
        reflex_.insert(std::lower_bound(reflex_.begin(), reflex_.end(), entry), entry);
    }
    if (2 * reflex_gone_ <= reflex_.size()) return;
    std::erase_if(reflex_,
                  [&](const auto& entry) { return points_[entry.second].gone || !points_[entry.second].reflex; });
    reflex_gone_ = 0;
}

}  // namespace model
