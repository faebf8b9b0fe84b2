#include "render/native/triangles_on_screen.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/triangles_on_screen.cpp"
#include <hwy/foreach_target.h>
// After it, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float farthest_whole = 1e30f;  // [m] no product with it is infinite

void project(const View& view, const Corners& corners, ScreenCorners& out) {
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto set = [&](float value) HWY_ATTR { return hn::Set(d, value); };
    const glm::mat4& m = view.clip_from_camera_relative;
    const glm::vec3 camera(view.position);
    const float half_width = 0.5f * static_cast<float>(view.width),
                half_height = 0.5f * static_cast<float>(view.height);
    const auto scale_x = set(half_width * subpixels), scale_y = set(half_height * -subpixels);
    const auto middle_x = set(half_width * subpixels), middle_y = set(half_height * subpixels);
    // Rounded inward, so that no corner's subpixels leave the guard band.
    const auto reach_x = set((half_width + guard_band - 1) / half_width);
    const auto reach_y = set((half_height + guard_band - 1) / half_height);
    for (std::size_t i = 0; i < corners.count; i += hn::Lanes(d)) {
        const auto x = hn::Sub(hn::Load(d, &corners.x[i]), set(camera.x));
        const auto y = hn::Sub(hn::Load(d, &corners.y[i]), set(camera.y));
        const auto z = hn::Sub(hn::Load(d, &corners.z[i]), set(camera.z));
        const auto row = [&](int r) HWY_ATTR {
            return hn::Add(hn::Add(hn::Mul(x, set(m[0][r])), hn::Mul(y, set(m[1][r]))), hn::Mul(z, set(m[2][r])));
        };
        const auto across = row(0), up = row(1), far = row(3);
        const auto is_between = hn::And(hn::Ge(far, set(near_plane)), hn::Le(far, set(farthest_whole)));
        const auto is_near_picture =
            hn::And(hn::Le(hn::Abs(across), hn::Mul(reach_x, far)), hn::Le(hn::Abs(up), hn::Mul(reach_y, far)));
        const auto is_whole = hn::And(is_between, is_near_picture);
        const auto one = hn::Div(set(1.0f), hn::IfThenElse(is_whole, far, set(1.0f)));
        const auto at_x = hn::IfThenElseZero(is_whole, hn::Add(hn::Mul(hn::Mul(across, one), scale_x), middle_x));
        const auto at_y = hn::IfThenElseZero(is_whole, hn::Add(hn::Mul(hn::Mul(up, one), scale_y), middle_y));
        hn::Store(hn::NearestInt(at_x), di, &out.x[i]);
        hn::Store(hn::NearestInt(at_y), di, &out.y[i]);
        hn::Store(hn::Mul(set(near_plane), one), d, &out.depth[i]);
        const auto side = [&](auto is_outside, std::int32_t bit)
                              HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(di, is_outside), hn::Set(di, bit)); };
        const auto nearer = hn::Neg(far);
        auto sides = side(hn::Lt(across, nearer), outside_left);
        sides = hn::Or(sides, side(hn::Gt(across, far), outside_right));
        sides = hn::Or(sides, side(hn::Gt(up, far), outside_top));
        sides = hn::Or(sides, side(hn::Lt(up, nearer), outside_bottom));
        sides = hn::Or(sides, side(hn::Not(is_whole), clipped));
        hn::Store(sides, di, &out.sides[i]);
    }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cmath>
#include <optional>

namespace render::native {

namespace {

constexpr std::size_t longest_vector = 16;

std::size_t padded(std::size_t count) {
    return (count + longest_vector - 1) / longest_vector * longest_vector;
}

struct ScreenCorner {
    std::int32_t x, y;
    float depth;
};

// Whether a row or column of samples lies in [low, high], both in subpixels.
bool holds_a_sample(std::int32_t low, std::int32_t high, std::int32_t picture_end) {
    return std::max(first_sampled<most_samples>(low), 0) <= std::min(last_sampled<most_samples>(high), picture_end - 1);
}

// Twice the area on the screen: positive of what faces the camera, which is counter-clockwise where y is up.
std::int64_t facing_area(const ScreenCorner& a, const ScreenCorner& b, const ScreenCorner& c) {
    return std::int64_t{c.x - a.x} * (b.y - a.y) - std::int64_t{c.y - a.y} * (b.x - a.x);
}

// What depth is in the plane of three corners: at the centre of pixel (0, 0), and by how much it grows.
struct DepthPlane {
    double depth, along_x, along_y;

    DepthPlane(const ScreenCorner& a, const ScreenCorner& b, const ScreenCorner& c, std::int64_t area) {
        const double per_area = subpixels / static_cast<double>(area);
        const double to_b = static_cast<double>(b.depth) - a.depth, to_c = static_cast<double>(c.depth) - a.depth;
        along_x = (to_c * (b.y - a.y) - to_b * (c.y - a.y)) * per_area;
        along_y = (to_b * (c.x - a.x) - to_c * (b.x - a.x)) * per_area;
        constexpr double pixel = 1.0 / subpixels;
        depth = a.depth + along_x * (0.5 - pixel * a.x) + along_y * (0.5 - pixel * a.y);
    }
};

void add(const View& view, const std::array<ScreenCorner, 4>& clockwise, const DepthPlane& plane, std::uint32_t surface,
         std::vector<ScreenTriangle>& out) {
    const auto& [a, b, c, d] = clockwise;
    const auto [left, right] = std::minmax({a.x, b.x, c.x, d.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y, d.y});
    if (!holds_a_sample(left, right, view.width) || !holds_a_sample(top, bottom, view.height)) return;
    out.push_back({{a.x, b.x, c.x, d.x},
                   {a.y, b.y, c.y, d.y},
                   surface,
                   std::max({a.depth, b.depth, c.depth, d.depth}),
                   plane.depth,
                   plane.along_x,
                   plane.along_y});
}

void add_if_seen(const View& view, const ScreenCorner& a, const ScreenCorner& b, const ScreenCorner& c,
                 std::uint32_t surface, std::vector<ScreenTriangle>& out) {
    const std::int64_t area = facing_area(a, b, c);
    if (area > 0) add(view, {a, c, b, b}, DepthPlane(a, b, c, area), surface, out);
}

// Rounding may have dented it: then it is two triangles.
void add_if_seen(const View& view, const ScreenCorner& a, const ScreenCorner& b, const ScreenCorner& c,
                 const ScreenCorner& d, std::uint32_t surface, std::vector<ScreenTriangle>& out) {
    const std::int64_t abc = facing_area(a, b, c), acd = facing_area(a, c, d);
    if (std::min({abc, acd, facing_area(b, c, d), facing_area(d, a, b)}) <= 0) {
        add_if_seen(view, a, b, c, surface, out);
        add_if_seen(view, a, c, d, surface, out);
        return;
    }
    add(view, {a, d, c, b}, abc >= acd ? DepthPlane(a, b, c, abc) : DepthPlane(a, c, d, acd), surface, out);
}

// A corner while it is clipped: in clip space, and on the screen as soon as that is known.
struct ClipCorner {
    glm::dvec3 at;  // across, up, and away
    bool is_projected;
    ScreenCorner screen;
};
constexpr std::size_t most_corners = 8;  // three, and one more a plane
struct Polygon {
    std::array<ClipCorner, most_corners> corners;
    std::size_t count = 0;

    // Rounding may dent a polygon that is thinner than it, and so give it more corners than there is room for.
    void add(const ClipCorner& corner) {
        if (count < most_corners) corners[count++] = corner;
    }
};

// Whoever was projected is inside, however the last bit falls.
double distance(const ClipCorner& corner, glm::dvec3 normal, double offset) {
    const double d = glm::dot(normal, corner.at) - offset;
    return corner.is_projected ? std::max(d, 0.0) : d;
}

// What of a polygon is on the inner side, where normal . at >= offset. A cut goes from the inside out, whichever
// neighbour asks, so that neighbours stay seamless.
Polygon cut(const Polygon& polygon, glm::dvec3 normal, double offset) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const ClipCorner& a = polygon.corners[i];
        const ClipCorner& b = polygon.corners[(i + 1) % polygon.count];
        const double from_a = distance(a, normal, offset), from_b = distance(b, normal, offset);
        if (from_a >= 0) out.add(a);
        if ((from_a >= 0) == (from_b >= 0)) continue;
        const bool a_is_inside = from_a >= 0;
        const ClipCorner& inner = a_is_inside ? a : b;
        const ClipCorner& outer = a_is_inside ? b : a;
        const double in = a_is_inside ? from_a : from_b, beyond = a_is_inside ? from_b : from_a;
        out.add({inner.at + (outer.at - inner.at) * (in / (in - beyond)), false, {}});
    }
    return out;
}

// Planes' normals and offsets: near, then the guard band's four sides.
struct ClipPlanes {
    std::array<glm::dvec4, 5> planes;
    glm::dvec2 half;  // [px] of the picture

    explicit ClipPlanes(const View& view) : half(0.5 * view.width, 0.5 * view.height) {
        const glm::dvec2 reach = (half + (guard_band - 1.0)) / half;
        planes = {glm::dvec4(0, 0, 1, near_plane), glm::dvec4(1, 0, reach.x, 0), glm::dvec4(-1, 0, reach.x, 0),
                  glm::dvec4(0, 1, reach.y, 0), glm::dvec4(0, -1, reach.y, 0)};
    }
};

ScreenCorner projected(const ClipCorner& corner, glm::dvec2 half) {
    if (corner.is_projected) return corner.screen;
    const double away = std::max(corner.at.z, static_cast<double>(near_plane));
    const double x = (corner.at.x / away * half.x + half.x) * subpixels;
    const double y = (corner.at.y / away * -half.y + half.y) * subpixels;
    const glm::dvec2 low(-guard_band * subpixels), high = (2.0 * half + static_cast<double>(guard_band)) * 256.0;
    return {static_cast<std::int32_t>(std::lround(std::clamp(x, low.x, high.x))),
            static_cast<std::int32_t>(std::lround(std::clamp(y, low.y, high.y))),
            static_cast<float>(static_cast<double>(near_plane) / away)};
}

void add_clipped(const View& view, const Corners& corners, const ScreenCorners& screen, const Triangle& triangle,
                 std::uint32_t surface, std::vector<ScreenTriangle>& out) {
    Polygon polygon;
    for (const std::uint32_t i : triangle) {
        const glm::vec3 relative = glm::vec3(corners.x[i], corners.y[i], corners.z[i]) - glm::vec3(view.position);
        const glm::dvec4 clip = glm::dmat4(view.clip_from_camera_relative) * glm::dvec4(glm::dvec3(relative), 1.0);
        if (!std::isfinite(clip.x) || !std::isfinite(clip.y) || !std::isfinite(clip.w)) return;
        polygon.add({glm::dvec3(clip.x, clip.y, clip.w),
                     (screen.sides[i] & clipped) == 0,
                     {screen.x[i], screen.y[i], screen.depth[i]}});
    }
    const ClipPlanes clip(view);
    for (const glm::dvec4& plane : clip.planes) polygon = cut(polygon, glm::dvec3(plane), plane.w);
    if (polygon.count < 3) return;
    const ScreenCorner first = projected(polygon.corners[0], clip.half);
    ScreenCorner last = projected(polygon.corners[1], clip.half);
    for (std::size_t i = 2; i < polygon.count; ++i) {
        const ScreenCorner next = projected(polygon.corners[i], clip.half);
        add_if_seen(view, first, last, next, surface, out);
        last = next;
    }
}

// {a, b, c} and {a, c, d} as one, whichever corners they begin with; nothing if they are not that.
std::optional<Panel> joined(const std::vector<glm::vec3>& positions, const Triangle& first, const Triangle& second,
                            std::uint32_t surface) {
    constexpr float flat = 1e-3f;  // [m] off the plane
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const std::uint32_t a = first[i], b = first[(i + 1) % 3], c = first[(i + 2) % 3], d = second[(j + 2) % 3];
            if (second[j] != a || second[(j + 1) % 3] != c || d == c) continue;
            const glm::vec3 normal = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
            const float distance = std::abs(glm::dot(normal, positions[d] - positions[a]));
            if (distance <= flat * glm::length(normal)) return Panel{{a, b, c, d}, surface};
        }
    return std::nullopt;
}

}  // namespace

Corners::Corners(const std::vector<glm::vec3>& positions)
    : count(padded(positions.size())),
      x(hwy::AllocateAligned<float>(count)),
      y(hwy::AllocateAligned<float>(count)),
      z(hwy::AllocateAligned<float>(count)) {
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 position = positions[std::min(i, positions.size() - 1)];
        x[i] = position.x;
        y[i] = position.y;
        z[i] = position.z;
    }
}

ScreenCorners::ScreenCorners(std::size_t count)
    : x(hwy::AllocateAligned<std::int32_t>(count)),
      y(hwy::AllocateAligned<std::int32_t>(count)),
      depth(hwy::AllocateAligned<float>(count)),
      sides(hwy::AllocateAligned<std::int32_t>(count)) {}

HWY_EXPORT(project);
void project(const View& view, const Corners& corners, ScreenCorners& out) {
    HWY_DYNAMIC_DISPATCH(project)(view, corners, out);
}

std::vector<Panel> make_panels(const std::vector<glm::vec3>& positions, const std::vector<Triangle>& triangles,
                               const std::vector<std::uint32_t>& surfaces) {
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        std::optional<Panel> two;
        if (i + 1 < triangles.size() && surfaces[i] == surfaces[i + 1])
            two = joined(positions, triangles[i], triangles[i + 1], surfaces[i]);
        panels.push_back(two.value_or(Panel{{a, b, c, c}, surfaces[i]}));
        if (two) ++i;
    }
    return panels;
}

void add_visible(const View& view, const Corners& corners, const ScreenCorners& screen,
                 const std::vector<Panel>& panels, std::vector<ScreenTriangle>& out) {
    const auto corner = [&](std::uint32_t i) { return ScreenCorner{screen.x[i], screen.y[i], screen.depth[i]}; };
    for (const Panel& panel : panels) {
        const auto [a, b, c, d] = panel.corners;
        const std::int32_t sa = screen.sides[a], sb = screen.sides[b], sc = screen.sides[c], sd = screen.sides[d];
        if ((sa & sb & sc & sd & ~clipped) != 0) continue;
        if (((sa | sb | sc | sd) & clipped) != 0) {
            add_clipped(view, corners, screen, {a, b, c}, panel.surface, out);
            if (!panel.is_triangle()) add_clipped(view, corners, screen, {a, c, d}, panel.surface, out);
        } else if (panel.is_triangle()) {
            add_if_seen(view, corner(a), corner(b), corner(c), panel.surface, out);
        } else {
            add_if_seen(view, corner(a), corner(b), corner(c), corner(d), panel.surface, out);
        }
    }
}

}  // namespace render::native
#endif
