#include "render/native/clip.h"

#include <algorithm>
#include <cmath>

#include "render/view.h"

namespace render::native {

namespace {

// A triangle, and a corner more for each plane.
struct Polygon {
    std::array<PlacedCorner, 3 + 5> corners;
    std::size_t count = 0;

    // Rounding may dent a polygon that is thinner than it, and so give it more corners than there is room for.
    void add(const PlacedCorner& corner) {
        if (count < corners.size()) corners[count++] = corner;
    }
};

constexpr int depth_axis = 2;

// The near plane, or one beside the view's middle.
struct Plane {
    int axis;
    double side;  // of the middle: -1 or 1

    static constexpr double reach = wide_reach / 2;  // the picture's middle lies within the other half

    // >= 0 on the inner side.
    double distance(const glm::dvec3& p) const {
        return axis == depth_axis ? p.z - static_cast<double>(near_plane) : reach * p.z - side * p[axis];
    }
    // However far away the ends were that it lies between.
    void put_on(glm::dvec3& p) const {
        p[axis] = axis == depth_axis ? static_cast<double>(near_plane) : side * reach * p.z;
    }
};

// Where the plane cuts an edge: the same place for both triangles at it, whichever way they go around.
PlacedCorner cut(const Plane& plane, const PlacedCorner& a, double a_distance, const PlacedCorner& b,
                 double b_distance) {
    const double all = a_distance - b_distance, of_a = -b_distance / all, of_b = a_distance / all;
    const auto weight = static_cast<float>(of_b);
    const auto mixed = [&](float from, float to) { return from + (to - from) * weight; };
    PlacedCorner c;
    c.position = a.position * of_a + b.position * of_b;
    plane.put_on(c.position);
    for (int i = 0; i < 3; ++i) {
        c.look.light[i] = mixed(a.look.light[i], b.look.light[i]);
        c.look.albedo[i] = mixed(a.look.albedo[i], b.look.albedo[i]);
    }
    c.look.u = mixed(a.look.u, b.look.u);
    c.look.v = mixed(a.look.v, b.look.v);
    c.look.alpha = mixed(a.look.alpha, b.look.alpha);
    return c;
}

Polygon kept(const Polygon& from, const Plane& plane) {
    Polygon out;
    for (std::size_t i = 0; i < from.count; ++i) {
        const PlacedCorner& here = from.corners[i];
        const PlacedCorner& next = from.corners[(i + 1) % from.count];
        const double d = plane.distance(here.position), next_d = plane.distance(next.position);
        if (d >= 0) out.add(here);
        if (d >= 0 && next_d < 0) out.add(cut(plane, here, d, next, next_d));
        if (d < 0 && next_d >= 0) out.add(cut(plane, next, next_d, here, d));
    }
    return out;
}

Polygon clipped(const std::array<PlacedCorner, 3>& triangle) {
    Polygon polygon;
    for (const PlacedCorner& corner : triangle) polygon.add(corner);
    constexpr Plane planes[] = {{depth_axis, 1}, {0, 1}, {0, -1}, {1, 1}, {1, -1}};
    for (const Plane& plane : planes) polygon = kept(polygon, plane);
    return polygon;
}

std::int64_t twice_area(const WideTriangle& t) {
    const auto x = [&](int i) { return std::int64_t{t.x[i]} - t.x[0]; };
    const auto y = [&](int i) { return std::int64_t{t.y[i]} - t.y[0]; };
    return x(1) * y(2) - y(1) * x(2);
}

void swap_sides(WideTriangle& t) {
    std::swap(t.x[1], t.x[2]);
    std::swap(t.y[1], t.y[2]);
    std::swap(t.corners[1], t.corners[2]);
}

}  // namespace

void append_clipped(const std::array<PlacedCorner, 3>& triangle, double center_x, double center_y, bool double_sided,
                    const Texturing& texturing, std::vector<WideTriangle>& out) {
    const Polygon polygon = clipped(triangle);
    for (std::size_t i = 2; i < polygon.count; ++i) {
        WideTriangle t;
        t.texturing = texturing;
        const std::size_t numbers[] = {0, i - 1, i};
        for (int k = 0; k < 3; ++k) {
            const PlacedCorner& corner = polygon.corners[numbers[k]];
            const glm::dvec3& p = corner.position;
            t.x[k] = static_cast<std::int32_t>(std::floor(p.x / p.z + center_x + 0.5));
            t.y[k] = static_cast<std::int32_t>(std::floor(p.y / p.z + center_y + 0.5));
            t.corners[k] = corner.look;
            t.corners[k].depth = static_cast<float>(static_cast<double>(near_plane) / p.z);
        }
        const std::int64_t area = twice_area(t);
        if (area == 0 || (area < 0 && !double_sided)) continue;
        if (area < 0) swap_sides(t);
        out.push_back(t);
    }
}

}  // namespace render::native
