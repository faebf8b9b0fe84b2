#include "render/native/self_occlusion.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/self_occlusion.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/cutout.h"

#ifndef GRANDSTAND_SELF_OCCLUSION
#define GRANDSTAND_SELF_OCCLUSION

namespace render::native {
namespace {

constexpr int most_lanes = 16;
constexpr int run = 8;             // [cells] of a row that are drawn at a time
constexpr int side = 128;          // [cells] of the square that a body is looked at in
constexpr int margin = 2;          // [cells] around it
constexpr float slack = 2.0f;      // [cells] A point so far behind the surface in front of it lies on that surface.
constexpr float thinnest = 0.25f;  // [cells] The same, if that surface shows its other side.
constexpr float nothing = -std::numeric_limits<float>::infinity();

int filled_up(int count) {
    return (count + most_lanes - 1) / most_lanes * most_lanes;
}

// Where the eyes are, and how what they see is mapped to cells.
struct Screen {
    glm::vec3 right, up, towards;  // the first eye
    glm::vec3 low;                 // [model units] of the screen
    float cells_per_unit;
    int stride, rows;  // [cells]
};

struct Points {
    const SelfOcclusion::Axes& positions;
    const SelfOcclusion::Axes& facets;
    bool double_sided;
};

// What one of the eyes sees.
struct Picture {
    std::array<float*, 2> heights;  // of surfaces that face it, and of others
    std::uint32_t* visible;
    float* shown;
    // What is shown, and its squares, added up in this order whatever the length of vectors.
    std::array<float, most_lanes> facing{}, squares{};
};

// Triangles that are ready to be drawn, structure of arrays. `u` and `v` rise along two of the edges' normals, from 0
// to `twice` the area; each with what it is in the first cell's middle, and what it gains a column and a row on.
struct Batch {
    alignas(64) float u[most_lanes], u_column[most_lanes], u_row[most_lanes];
    alignas(64) float v[most_lanes], v_column[most_lanes], v_row[most_lanes];
    alignas(64) float twice[most_lanes];
    alignas(64) float height[most_lanes], height_u[most_lanes], height_v[most_lanes];  // towards the first eye
    alignas(64) std::int32_t first[most_lanes], width[most_lanes], rows[most_lanes];   // [cells]
};

}  // namespace
}  // namespace render::native

#endif

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, most_lanes>;
using Whole = hn::RebindToSigned<Lanes>;
using Vector = hn::Vec<Lanes>;
using Run = hn::CappedTag<float, run>;
constexpr Lanes lanes;
constexpr Whole whole;
constexpr Run cells_of_row;

template <typename Mask>
std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(lanes, mask, bytes);
    return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8;
}

Vector dot(const Vector* v, glm::vec3 axis) {
    return hn::Add(hn::Add(hn::Mul(v[0], hn::Set(lanes, axis.x)), hn::Mul(v[1], hn::Set(lanes, axis.y))),
                   hn::Mul(v[2], hn::Set(lanes, axis.z)));
}

void load(const SelfOcclusion::Axes& from, std::size_t at, Vector* v) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = hn::Load(lanes, &from[axis][at]);
}

}  // namespace

// As both eyes see them [model units]; and what they span.
void Turn(const SelfOcclusion::Axes& vertices, const Screen& screen, SelfOcclusion::Axes& seen, glm::vec3& low,
          glm::vec3& high) {
    const glm::vec3 axes[] = {screen.right, screen.up, screen.towards};
    Vector least[3], most[3];
    for (int axis = 0; axis < 3; ++axis) least[axis] = hn::Neg(most[axis] = hn::Set(lanes, nothing));
    for (std::size_t i = 0; i < vertices[0].size(); i += hn::Lanes(lanes)) {
        Vector p[3];
        load(vertices, i, p);
        for (int axis = 0; axis < 3; ++axis) {
            const Vector at = dot(p, axes[axis]);
            hn::Store(at, lanes, &seen[axis][i]);
            least[axis] = hn::Min(least[axis], at);
            most[axis] = hn::Max(most[axis], at);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = hn::GetLane(hn::MinOfLanes(lanes, least[axis]));
        high[axis] = hn::GetLane(hn::MaxOfLanes(lanes, most[axis]));
    }
}

void ToCells(const Screen& screen, SelfOcclusion::Axes& seen) {
    const Vector scale = hn::Set(lanes, screen.cells_per_unit);
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < seen[axis].size(); i += hn::Lanes(lanes))
            hn::Store(hn::Mul(hn::Sub(hn::Load(lanes, &seen[axis][i]), hn::Set(lanes, screen.low[axis])), scale), lanes,
                      &seen[axis][i]);
}

namespace {

struct Corner {
    Vector x, y, z;
};

Corner corner(const SelfOcclusion::Axes& seen, const Array<std::int32_t>& indices, std::size_t first) {
    const auto index = hn::Load(whole, &indices[first]);
    return {hn::GatherIndex(lanes, seen[0].data(), index), hn::GatherIndex(lanes, seen[1].data(), index),
            hn::GatherIndex(lanes, seen[2].data(), index)};
}

// Which triangles have a cell's middle in their bounds, a bit each; and which of them face the second eye: those have
// two corners swapped.
struct Ready {
    std::uint32_t any, away;
};

Ready set_up(Corner a, Corner b, Corner c, int stride, int from, Batch& batch) {
    const Vector zero = hn::Zero(lanes), half = hn::Set(lanes, 0.5f);
    Vector twice =
        hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)), hn::Mul(hn::Sub(b.y, a.y), hn::Sub(c.x, a.x)));
    const auto away = hn::Lt(twice, zero);
    twice = hn::Abs(twice);
    const auto swap = [&](Vector& p, Vector& q) HWY_ATTR {
        const Vector old = p;
        p = hn::IfThenElse(away, q, p);
        q = hn::IfThenElse(away, old, q);
    };
    swap(b.x, c.x), swap(b.y, c.y), swap(b.z, c.z);
    // The first cell whose middle is not below; all is within the screen.
    const auto cell = [&](Vector at) HWY_ATTR { return hn::ConvertTo(whole, hn::Add(at, half)); };
    const auto x0 = cell(hn::Min(a.x, hn::Min(b.x, c.x))), x1 = cell(hn::Max(a.x, hn::Max(b.x, c.x)));
    const auto y0 = cell(hn::Min(a.y, hn::Min(b.y, c.y))), y1 = cell(hn::Max(a.y, hn::Max(b.y, c.y)));
    const auto any = hn::And(hn::Gt(twice, zero), hn::RebindMask(lanes, hn::And(hn::Lt(x0, x1), hn::Lt(y0, y1))));
    hn::Store(hn::Add(hn::Mul(y0, hn::Set(whole, stride)), x0), whole, batch.first + from);
    hn::Store(hn::Sub(x1, x0), whole, batch.width + from);
    hn::Store(hn::Sub(y1, y0), whole, batch.rows + from);
    const Vector right = hn::Sub(hn::Add(hn::ConvertTo(lanes, x0), half), a.x);
    const Vector up = hn::Sub(hn::Add(hn::ConvertTo(lanes, y0), half), a.y);
    const auto along = [&](Vector column, Vector row, float* at_first, float* a_column, float* a_row) HWY_ATTR {
        hn::Store(hn::Add(hn::Mul(right, column), hn::Mul(up, row)), lanes, at_first + from);
        hn::Store(column, lanes, a_column + from);
        hn::Store(row, lanes, a_row + from);
    };
    along(hn::Sub(c.y, a.y), hn::Sub(a.x, c.x), batch.u, batch.u_column, batch.u_row);
    along(hn::Sub(a.y, b.y), hn::Sub(b.x, a.x), batch.v, batch.v_column, batch.v_row);
    hn::Store(twice, lanes, batch.twice + from);
    hn::Store(a.z, lanes, batch.height + from);
    hn::Store(hn::Div(hn::Sub(b.z, a.z), twice), lanes, batch.height_u + from);
    hn::Store(hn::Div(hn::Sub(c.z, a.z), twice), lanes, batch.height_v + from);
    return {bits_of(any) << from, bits_of(away) << from};
}

// `sign`: -1 for the second eye, whose heights are the other way around.
HWY_INLINE void draw(const Batch& batch, int i, int stride, float sign, float* heights) {
    const auto all = [](float value) HWY_ATTR { return hn::Set(cells_of_row, value); };
    const auto zero = hn::Zero(cells_of_row), iota = hn::Iota(cells_of_row, 0.0f);
    const auto twice = all(batch.twice[i]), height = all(sign * batch.height[i]);
    const auto height_u = all(sign * batch.height_u[i]), height_v = all(sign * batch.height_v[i]);
    const auto u_row = all(batch.u_row[i]), v_row = all(batch.v_row[i]);
    for (int x = 0; x < batch.width[i]; x += static_cast<int>(hn::Lanes(cells_of_row))) {
        const auto column = hn::Add(iota, all(static_cast<float>(x)));
        auto u = hn::Add(all(batch.u[i]), hn::Mul(column, all(batch.u_column[i])));
        auto v = hn::Add(all(batch.v[i]), hn::Mul(column, all(batch.v_column[i])));
        float* cells = heights + batch.first[i] + x;
        for (int y = 0; y < batch.rows[i]; ++y, cells += stride) {
            const auto inside = hn::And(hn::And(hn::Ge(u, zero), hn::Ge(v, zero)), hn::Le(hn::Add(u, v), twice));
            const auto here = hn::Add(height, hn::Add(hn::Mul(u, height_u), hn::Mul(v, height_v)));
            const auto old = hn::LoadU(cells_of_row, cells);
            hn::StoreU(hn::IfThenElse(inside, hn::Max(old, here), old), cells_of_row, cells);
            u = hn::Add(u, u_row);
            v = hn::Add(v, v_row);
        }
    }
}

}  // namespace

void Draw(const SelfOcclusion::Axes& seen, const std::array<Array<std::int32_t>, 3>& corners, bool double_sided,
          int stride, const std::array<Picture, 2>& pictures) {
    Batch batch;
    for (std::size_t first = 0; first < corners[0].size(); first += most_lanes) {
        Ready ready{};
        for (int i = 0; i < most_lanes; i += static_cast<int>(hn::Lanes(lanes))) {
            const auto of = [&](int which) HWY_ATTR { return corner(seen, corners[which], first + i); };
            const Ready some = set_up(of(0), of(1), of(2), stride, i, batch);
            ready.any |= some.any;
            ready.away |= some.away;
        }
        for (std::uint32_t left = ready.any; left != 0; left &= left - 1) {
            const int i = std::countr_zero(left);
            const int away = static_cast<int>(ready.away >> i & 1);
            if (double_sided || !away) draw(batch, i, stride, 1.0f, pictures[0].heights[away]);
            if (double_sided || away) draw(batch, i, stride, -1.0f, pictures[1].heights[1 - away]);
        }
    }
}

// How many cells aren't empty.
int Count(const Picture& picture, bool double_sided, int cells) {
    std::size_t count = 0;
    for (int i = 0; i < cells; i += static_cast<int>(hn::Lanes(lanes))) {
        Vector nearest = hn::Load(lanes, picture.heights[0] + i);
        if (double_sided) nearest = hn::Max(nearest, hn::Load(lanes, picture.heights[1] + i));
        count += hn::CountTrue(lanes, hn::Gt(nearest, hn::Set(lanes, nothing)));
    }
    return static_cast<int>(count);
}

// Each cell becomes the farthest of four: itself, and those right, above and both.
void Widen(float* heights, int stride, int rows) {
    for (int i = 0; i < stride * (rows - 1); i += static_cast<int>(hn::Lanes(lanes))) {
        const Vector below = hn::Min(hn::Load(lanes, heights + i), hn::LoadU(lanes, heights + i + 1));
        const Vector above = hn::Min(hn::Load(lanes, heights + i + stride), hn::LoadU(lanes, heights + i + stride + 1));
        hn::Store(hn::Min(below, above), lanes, heights + i);
    }
}

void Empty(float* heights, std::size_t cells) {
    for (std::size_t i = 0; i < cells; i += hn::Lanes(lanes)) hn::Store(hn::Set(lanes, nothing), lanes, heights + i);
}

// By the farthest of the four cells around it: at the edge of what is in front a point still shows.
void Test(const Points& points, const Screen& screen, std::array<Picture, 2>& pictures) {
    const Vector zero = hn::Zero(lanes), scale = hn::Set(lanes, screen.cells_per_unit);
    for (std::size_t i = 0; i < points.positions[0].size(); i += hn::Lanes(lanes)) {
        Vector p[3], facet[3];
        load(points.positions, i, p);
        load(points.facets, i, facet);
        const auto seen = [&](glm::vec3 axis, float low)
                              HWY_ATTR { return hn::Mul(hn::Sub(dot(p, axis), hn::Set(lanes, low)), scale); };
        const auto cell = [&](Vector at, int cells) HWY_ATTR {
            return hn::Min(hn::Max(hn::ConvertTo(whole, hn::Sub(at, hn::Set(lanes, 0.5f))), hn::Zero(whole)),
                           hn::Set(whole, cells - 2));
        };
        const auto x = cell(seen(screen.right, screen.low.x), screen.stride);
        const auto y = cell(seen(screen.up, screen.low.y), screen.rows);
        const auto at = hn::Add(hn::Mul(y, hn::Set(whole, screen.stride)), x);
        Vector height = seen(screen.towards, screen.low.z);
        Vector facing = dot(facet, screen.towards);
        for (Picture& picture : pictures) {
            const Vector facing_it = hn::GatherIndex(lanes, picture.heights[0], at);
            const Vector beyond = hn::Add(height, hn::Set(lanes, slack));
            auto hidden = hn::And(hn::Gt(facing, zero), hn::Lt(beyond, facing_it));
            Vector shown = hn::Max(facing, zero);
            if (points.double_sided) {
                const Vector others = hn::GatherIndex(lanes, picture.heights[1], at);
                const auto away = hn::Lt(facing, zero);
                const Vector own_side = hn::IfThenElse(away, others, facing_it);
                const Vector other_side = hn::IfThenElse(away, facing_it, others);
                hidden =
                    hn::Or(hn::Lt(beyond, own_side), hn::Lt(hn::Add(height, hn::Set(lanes, thinnest)), other_side));
                shown = hn::Abs(facing);
            }
            picture.visible[i / 32] |= bits_of(hn::Not(hidden)) << i % 32;
            shown = hn::IfThenZeroElse(hidden, shown);
            hn::Store(shown, lanes, picture.shown + i);
            const auto add = [&](Vector value, std::array<float, most_lanes>& to) HWY_ATTR {
                float* sums = &to[i % most_lanes];
                hn::StoreU(hn::Add(hn::LoadU(lanes, sums), value), lanes, sums);
            };
            add(shown, picture.facing);
            add(hn::Mul(shown, shown), picture.squares);
            height = hn::Neg(height);
            facing = hn::Neg(facing);
        }
    }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(Turn);
HWY_EXPORT(ToCells);
HWY_EXPORT(Draw);
HWY_EXPORT(Count);
HWY_EXPORT(Widen);
HWY_EXPORT(Empty);
HWY_EXPORT(Test);

namespace {

void append(SelfOcclusion::Axes& axes, glm::vec3 v) {
    for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(v[axis]);
}

void fill_up(SelfOcclusion::Axes& axes) {
    for (Array<float>& axis : axes)
        axis.resize(static_cast<std::size_t>(filled_up(static_cast<int>(axis.size()))), axis.back());
}

Screen screen_for(glm::vec3 direction) {
    Screen screen{};
    screen.towards = direction;
    screen.right = glm::normalize(std::abs(direction.y) < 0.9f ? glm::cross(glm::vec3(0, 1, 0), direction)
                                                               : glm::cross(glm::vec3(0, 0, 1), direction));
    screen.up = glm::cross(direction, screen.right);
    return screen;
}

// With room for runs beyond what is seen, and for whole vectors.
void fit(Screen& screen, glm::vec3 low, glm::vec3 high) {
    const glm::vec3 size = high - low;
    screen.cells_per_unit = (side - 2 * margin) / std::max({size.x, size.y, 1e-6f * size.z, 1e-30f});
    screen.low = low - glm::vec3(margin / screen.cells_per_unit);
    const auto cells = [&](float length) { return static_cast<int>(length * screen.cells_per_unit) + 2 * margin; };
    screen.stride = filled_up(cells(size.x) + run);
    screen.rows = cells(size.y) + 1;
}

// Into how many pieces along each side triangles with cutouts are cut, of which each is there or not.
int pieces_along(const model::Mesh& mesh) {
    constexpr double all_pieces = 16384, most_along = 16;
    std::size_t cut = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        cut += model::material_of_triangle(mesh, t).alpha_cutoff > 0;
    return static_cast<int>(
        std::clamp(std::sqrt(all_pieces / std::max(1.0, static_cast<double>(cut))), 1.0, most_along));
}

}  // namespace

SelfOcclusion::SelfOcclusion(const figures::Figure& figure, int pose, std::span<const glm::vec3> facets,
                             std::span<const float> shares)
    : points_(static_cast<int>(shares.size())), double_sided_(figure.mesh->double_sided()) {
    const motion::PoseTable& poses = *figure.poses;
    for (int i = 0; i < poses.vertex_count; ++i)
        append(vertices_, motion::unpack_position(
                              poses.vertices[static_cast<std::size_t>(pose) * poses.vertex_count + i], poses.box));
    for (int i = 0; i < points_; ++i) {
        const motion::PosedVertex& point = poses.points[static_cast<std::size_t>(pose) * poses.point_count + i];
        append(positions_, motion::unpack_position(point, poses.box));
        append(facets_, shares[i] * facets[i]);
    }
    add_triangles(*figure.mesh);
    fill_up(vertices_);
    fill_up(positions_);
    for (Array<float>& axis : facets_) axis.resize(positions_[0].size());  // what isn't there shows nothing
    on_screen_ = vertices_;
    for (Array<std::int32_t>& corner : corners_)
        corner.resize(static_cast<std::size_t>(filled_up(static_cast<int>(corner.size()))));
    for (Array<float>& shown : shown_) shown.resize(positions_[0].size());
    for (Array<std::uint32_t>& visible : visible_) visible.resize((positions_[0].size() + 31) / 32);
}

void SelfOcclusion::add_triangles(const model::Mesh& mesh) {
    const bool has_cutouts = model::has_cutouts(mesh);
    const int along = has_cutouts ? pieces_along(mesh) : 1;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        if (has_cutouts && model::material_of_triangle(mesh, t).alpha_cutoff > 0) {
            add_pieces(mesh, t, along);
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) corners_[k].push_back(static_cast<std::int32_t>(mesh.indices[3 * t + k]));
    }
}

void SelfOcclusion::add_pieces(const model::Mesh& mesh, std::size_t triangle, int along) {
    std::array<glm::vec3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) corner[k][axis] = vertices_[axis][mesh.indices[3 * triangle + k]];
    // What the second and the third corner have of each of a piece's, in pieces.
    const auto add = [&](std::array<glm::ivec2, 3> shares) {
        const glm::vec2 middle = glm::vec2(shares[0] + shares[1] + shares[2]) / (3.0f * static_cast<float>(along));
        if (!model::has_surface(mesh, triangle, middle.x, middle.y)) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 share = glm::vec2(shares[k]) / static_cast<float>(along);
            corners_[k].push_back(static_cast<std::int32_t>(vertices_[0].size()));
            append(vertices_, (1 - share.x - share.y) * corner[0] + share.x * corner[1] + share.y * corner[2]);
        }
    };
    for (int i = 0; i < along; ++i) {
        for (int j = 0; i + j < along; ++j) {
            add({glm::ivec2(i, j), {i + 1, j}, {i, j + 1}});
            if (i + j + 1 < along) add({glm::ivec2(i + 1, j), {i + 1, j + 1}, {i, j + 1}});
        }
    }
}

std::array<SelfOcclusion::Seen, 2> SelfOcclusion::look_both_ways(glm::vec3 direction) {
    Screen screen = screen_for(direction);
    glm::vec3 low, high;
    HWY_DYNAMIC_DISPATCH(Turn)(vertices_, screen, on_screen_, low, high);
    fit(screen, low, high);
    HWY_DYNAMIC_DISPATCH(ToCells)(screen, on_screen_);
    const int kinds = double_sided_ ? 2 : 1;
    std::array<Picture, 2> pictures{};
    for (int i = 0; i < 2; ++i) {
        // Vectors begin at every cell.
        const std::size_t cells = static_cast<std::size_t>(screen.stride) * screen.rows + most_lanes;
        for (int kind = 0; kind < kinds; ++kind) {
            Array<float>& heights = heights_[i][kind];
            if (heights.size() < cells) heights.resize(cells);
            HWY_DYNAMIC_DISPATCH(Empty)(heights.data(), cells);
            pictures[i].heights[kind] = heights.data();
        }
        std::ranges::fill(visible_[i], 0u);
        pictures[i].visible = visible_[i].data();
        pictures[i].shown = shown_[i].data();
    }
    HWY_DYNAMIC_DISPATCH(Draw)(on_screen_, corners_, double_sided_, screen.stride, pictures);
    std::array<Seen, 2> seen;
    for (int i = 0; i < 2; ++i) {
        const int cells = HWY_DYNAMIC_DISPATCH(Count)(pictures[i], double_sided_, screen.stride * (screen.rows - 1));
        seen[i].silhouette = static_cast<float>(cells) / (screen.cells_per_unit * screen.cells_per_unit);
        for (int kind = 0; kind < kinds; ++kind)
            HWY_DYNAMIC_DISPATCH(Widen)(pictures[i].heights[kind], screen.stride, screen.rows);
    }
    HWY_DYNAMIC_DISPATCH(Test)({positions_, facets_, double_sided_}, screen, pictures);
    for (int i = 0; i < 2; ++i) {
        if (points_ % 32 != 0) visible_[i][points_ / 32] &= (1u << (points_ % 32)) - 1;
        seen[i].facing = std::accumulate(pictures[i].facing.begin(), pictures[i].facing.end(), 0.0f);
        seen[i].squares = std::accumulate(pictures[i].squares.begin(), pictures[i].squares.end(), 0.0f);
        seen[i].visible = {visible_[i].data(), static_cast<std::size_t>((points_ + 31) / 32)};
        seen[i].shown = {shown_[i].data(), static_cast<std::size_t>(points_)};
    }
    return seen;
}

}  // namespace render::native

#endif
