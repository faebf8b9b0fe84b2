// Polygons as triangles. Internal to the loaders.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace model {

// Cuts one polygon after another; keeps its lists for the next.
class Triangulator {
public:
    using Triangle = std::array<std::uint32_t, 3>;  // numbers of the polygon's corners

    // n - 2 triangles for n >= 3 corners, wound as the polygon is; valid until the next call. What every triangle of a
    // fan about the first corner is right for stays a fan. Else ears are cut off, seen along the polygon's mean normal:
    // concave polygons, and holes that are joined to the outline by a bridge, there and back. Every corner is kept, so
    // some triangles may have no area. Polygons that cross themselves are covered in some way. About n^1.5 time, at
    // most 2000 n; exact for corners that are floats.
    std::span<const Triangle> cut(std::span<const glm::dvec3> corners);

private:
    struct Point {
        glm::dvec2 at;
        std::uint32_t previous, next;
        bool reflex, gone;  // reflex: not strictly convex
    };

    bool project(std::span<const glm::dvec3> corners);
    bool fan_is_right() const;
    void add_fan();
    void cut_ears();
    void find_reflex();
    bool is_reflex(std::uint32_t point) const;
    bool is_ear(std::uint32_t tip, bool strictly);
    bool is_blocked_by(std::uint32_t point, std::uint32_t tip, bool strictly) const;
    void cut_off(std::uint32_t tip);

    std::vector<Triangle> triangles_;
    std::vector<Point> points_;
    std::vector<std::pair<double, std::uint32_t>> reflex_;  // by x
    std::size_t reflex_gone_ = 0;
    std::uint64_t tests_left_ = 0;
};

}  // namespace model
