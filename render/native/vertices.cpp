#include "render/native/vertices.h"

#include <algorithm>

#include "render/view.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/vertices.cpp"
#include <hwy/foreach_target.h>
// What follows is compiled once for every target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = HWY_CAPPED(float, group);
using Ints = hn::Rebind<std::int32_t, Floats>;
using Words = hn::Rebind<std::uint32_t, Floats>;
using VFloat = hn::Vec<Floats>;
using VInt = hn::Vec<Ints>;

struct Vector3 {
    VFloat x, y, z;
};

VFloat apply(const Form& form, const Vector3& p) {
    const Floats f;
    const auto xy = hn::Add(hn::Mul(hn::Set(f, form.x), p.x), hn::Mul(hn::Set(f, form.y), p.y));
    return hn::Add(xy, hn::Add(hn::Mul(hn::Set(f, form.z), p.z), hn::Set(f, form.one)));
}

VFloat dot(const Vector3& a, const Vector3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

// Octahedral, as motion::unpack_normal.
Vector3 unfold(VInt u, VInt v) {
    const Floats f;
    const auto scale = hn::Set(f, 127.0f);
    const auto least = hn::Set(f, -1.0f);
    auto x = hn::Max(hn::Div(hn::ConvertTo(f, u), scale), least);
    auto y = hn::Max(hn::Div(hn::ConvertTo(f, v), scale), least);
    const auto z = hn::Sub(hn::Sub(hn::Set(f, 1.0f), hn::Abs(x)), hn::Abs(y));
    const auto fold = hn::Max(hn::Neg(z), hn::Zero(f));
    x = hn::Sub(x, hn::CopySign(fold, x));
    y = hn::Sub(y, hn::CopySign(fold, y));
    const Vector3 n{x, y, z};
    const auto length = hn::Sqrt(dot(n, n));
    return {hn::Div(x, length), hn::Div(y, length), hn::Div(z, length)};
}

VInt snapped(VFloat position) {
    const Floats f;
    const auto most = hn::Set(f, 1e9f);  // far beyond any picture, and still an int
    const auto bounded = hn::Max(hn::Min(position, most), hn::Neg(most));
    return hn::ConvertTo(Ints(), hn::Floor(hn::Add(bounded, hn::Set(f, 0.5f))));
}

struct Bounds {
    VInt min_x, min_y, max_x, max_y;
    VFloat nearest;
};

// Linear.
hn::Vec<Floats> light_on(const Vector3& normal, const Vector3& to_sun, const Daylight& daylight, int c) {
    const Floats f;
    const auto facing_sun = hn::Max(dot(normal, to_sun), hn::Zero(f));
    const auto around = hn::Add(hn::Set(f, daylight.level[c]), hn::Mul(normal.y, hn::Set(f, daylight.slope[c])));
    return hn::Add(around, hn::Mul(facing_sun, hn::Set(f, daylight.sun[c])));
}

// One group, a vector at a time. `behind`: the same from behind; null: not wanted.
void place_group(const Placement& placement, const Daylight& daylight, const std::uint32_t* posed, LitVertex* lit,
                 LitVertex* behind, std::int32_t* across, std::int32_t* down, Bounds& bounds) {
    const Floats f;
    const Ints i;
    const Words w;
    const auto low = hn::Set(w, 0xffffu);
    for (std::size_t lane = 0; lane < group; lane += hn::Lanes(f)) {
        hn::Vec<Words> xy, z_normal;
        hn::LoadInterleaved2(w, posed + 2 * lane, xy, z_normal);
        const Vector3 packed{hn::ConvertTo(f, hn::BitCast(i, hn::And(xy, low))),
                             hn::ConvertTo(f, hn::BitCast(i, hn::ShiftRight<16>(xy))),
                             hn::ConvertTo(f, hn::BitCast(i, hn::And(z_normal, low)))};
        const auto depth = apply(placement.depth, packed);
        const auto over_depth = hn::Div(hn::Set(f, 1.0f), depth);
        const auto x =
            snapped(hn::Add(hn::Mul(apply(placement.across, packed), over_depth), hn::Set(f, placement.center_x)));
        const auto y =
            snapped(hn::Add(hn::Mul(apply(placement.down, packed), over_depth), hn::Set(f, placement.center_y)));
        hn::StoreU(x, i, across + lane);
        hn::StoreU(y, i, down + lane);
        const auto near = hn::Mul(over_depth, hn::Set(f, near_plane));
        bounds = {hn::Min(bounds.min_x, x), hn::Min(bounds.min_y, y), hn::Max(bounds.max_x, x),
                  hn::Max(bounds.max_y, y), hn::Max(bounds.nearest, near)};

        const auto signed_normal = hn::BitCast(i, z_normal);
        const Vector3 normal =
            unfold(hn::ShiftRight<24>(hn::ShiftLeft<8>(signed_normal)), hn::ShiftRight<24>(signed_normal));
        const Vector3 to_sun{hn::Set(f, placement.sun[0]), hn::Set(f, placement.sun[1]), hn::Set(f, placement.sun[2])};
        const auto light_up = [&](const Vector3& side, LitVertex* to) {
            hn::StoreInterleaved4(light_on(side, to_sun, daylight, 0), light_on(side, to_sun, daylight, 1),
                                  light_on(side, to_sun, daylight, 2), near, f, to[lane].light);
        };
        light_up(normal, lit);
        if (behind) light_up({hn::Neg(normal.x), hn::Neg(normal.y), hn::Neg(normal.z)}, behind);
    }
}

Extent place_all(const Placement& placement, const Daylight& daylight, std::span<const motion::PosedVertex> posed,
                 bool double_sided, LitVertex* lit, std::int32_t* across, std::int32_t* down) {
    const Ints i;
    const auto most = hn::Set(i, INT32_MAX), least = hn::Set(i, INT32_MIN);
    LitVertex* behind = lit + in_groups(posed.size());
    Bounds bounds{most, most, least, least, hn::Zero(Floats())};
    for (std::size_t first = 0; first < posed.size(); first += group) {
        // The last group is filled up with its last vertex.
        motion::PosedVertex rest[group];
        const motion::PosedVertex* from = posed.data() + first;
        if (posed.size() - first < group) {
            std::fill(std::copy(posed.begin() + first, posed.end(), rest), rest + group, posed.back());
            from = rest;
        }
        place_group(placement, daylight, reinterpret_cast<const std::uint32_t*>(from), lit + first,
                    double_sided ? behind + first : nullptr, across + first, down + first, bounds);
    }
    return {hn::GetLane(hn::MinOfLanes(i, bounds.min_x)), hn::GetLane(hn::MinOfLanes(i, bounds.min_y)),
            hn::GetLane(hn::MaxOfLanes(i, bounds.max_x)), hn::GetLane(hn::MaxOfLanes(i, bounds.max_y)),
            hn::GetLane(hn::MaxOfLanes(Floats(), bounds.nearest))};
}

// Whether a sample's row or column lies in [least, most] on the grid; samples lie in the middle of their squares.
hn::Mask<Ints> holds_sample(VInt least, VInt most) {
    const Ints i;
    const auto first = hn::ShiftRight<4>(hn::Add(least, hn::Set(i, grid_per_sample / 2 - 1)));
    const auto last = hn::ShiftRight<4>(hn::Sub(most, hn::Set(i, grid_per_sample / 2)));
    return hn::Not(hn::Gt(first, last));
}
static_assert(grid_per_sample == 16);

// Those of one vector that are to be kept; writes a vector's worth. By scalars where compressing is a table's work.
std::uint32_t append(hn::Vec<Words> a, hn::Vec<Words> b, hn::Vec<Words> c, hn::Vec<Words> face, hn::Mask<Words> keep,
                     FacingTriangle* to) {
    const Words w;
#if HWY_TARGET <= HWY_AVX3
    hn::StoreInterleaved4(hn::Compress(a, keep), hn::Compress(b, keep), hn::Compress(c, keep), hn::Compress(face, keep),
                          w, to->corners);
    return static_cast<std::uint32_t>(hn::CountTrue(w, keep));
#else
    FacingTriangle all[group];
    std::uint8_t bytes[8] = {};  // as many as may be written
    hn::StoreInterleaved4(a, b, c, face, w, all[0].corners);
    hn::StoreMaskBits(w, keep, bytes);
    const std::uint32_t bits = bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
    std::uint32_t count = 0;
    for (std::size_t lane = 0; lane < hn::Lanes(w); ++lane) {
        to[count] = all[lane];
        count += bits >> lane & 1;
    }
    return count;
#endif
}

std::uint32_t find_all_facing(const PersonMesh& mesh, const std::uint32_t* packed, FacingTriangle* to) {
    const Ints i;
    const Words w;
    const auto* places = reinterpret_cast<const std::int32_t*>(packed);
    const bool both_sides = mesh.double_sided;
    std::uint32_t count = 0;
    const auto x_of = [](VInt corner) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(corner)); };
    const auto y_of = [](VInt corner) { return hn::ShiftRight<16>(corner); };
    for (std::size_t first = 0; first < mesh.corners[0].size(); first += hn::Lanes(i)) {
        const auto a = hn::GatherIndex(i, places, hn::LoadU(i, mesh.corners[0].data() + first));
        auto b = hn::GatherIndex(i, places, hn::LoadU(i, mesh.corners[1].data() + first));
        auto c = hn::GatherIndex(i, places, hn::LoadU(i, mesh.corners[2].data() + first));
        const auto ax = x_of(a), bx = x_of(b), cx = x_of(c), ay = y_of(a), by = y_of(b), cy = y_of(c);
        const auto twice_area =
            hn::Sub(hn::Mul(hn::Sub(bx, ax), hn::Sub(cy, ay)), hn::Mul(hn::Sub(by, ay), hn::Sub(cx, ax)));
        auto number = hn::Iota(w, static_cast<std::uint32_t>(first));
        auto seen = hn::Gt(twice_area, hn::Zero(i));
        if (both_sides) {
            const auto behind = hn::Lt(twice_area, hn::Zero(i));
            const auto kept = b;
            b = hn::IfThenElse(behind, c, b);
            c = hn::IfThenElse(behind, kept, c);
            number = hn::Or(number, hn::IfThenElseZero(hn::RebindMask(w, behind), hn::Set(w, from_behind)));
            seen = hn::Or(seen, behind);
        }
        const auto in_columns = holds_sample(hn::Min(ax, hn::Min(bx, cx)), hn::Max(ax, hn::Max(bx, cx)));
        const auto in_rows = holds_sample(hn::Min(ay, hn::Min(by, cy)), hn::Max(ay, hn::Max(by, cy)));
        const auto keep = hn::RebindMask(w, hn::And(seen, hn::And(in_columns, in_rows)));
        count += append(hn::BitCast(w, a), hn::BitCast(w, b), hn::BitCast(w, c), number, keep, to + count);
    }
    return count;
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render::native {

HWY_EXPORT(place_all);
HWY_EXPORT(find_all_facing);

Extent place_vertices(const Placement& placement, const Daylight& daylight, std::span<const motion::PosedVertex> posed,
                      bool double_sided, LitVertex* lit, std::int32_t* across, std::int32_t* down) {
    return HWY_DYNAMIC_DISPATCH(place_all)(placement, daylight, posed, double_sided, lit, across, down);
}

std::uint32_t find_facing(const PersonMesh& mesh, const std::uint32_t* packed, FacingTriangle* to) {
    return HWY_DYNAMIC_DISPATCH(find_all_facing)(mesh, packed, to);
}

}  // namespace render::native
#endif  // HWY_ONCE
