#include "render/native/cover_cells.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/cover_cells.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

#include <bit>

#include "render/view.h"

#ifndef GRANDSTAND_NATIVE_COVER_CELLS_ONCE
#define GRANDSTAND_NATIVE_COVER_CELLS_ONCE

namespace render::native {

// What a patch is laid into, each from its first cell on, in rows of CellPlane's stride.
struct CoverPlanes {
    Cover* cover;
    Flock* flock;
    float* nearness;             // null: nobody asks
    const float* hidden_behind;  // [m] view depth
    const float* shown_behind;   // null: everything is
};

}  // namespace render::native

#endif

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Cells = hn::CappedTag<std::int16_t, 4 * group_cells>;
constexpr Cells cells;
using Vector = hn::Vec<Cells>;
constexpr int step = static_cast<int>(hn::MaxLanes(cells)) / 4;  // cells a vector
// A number for each cell of a vector.
using Words = hn::Repartition<std::uint64_t, Cells>;
constexpr Words words;
constexpr hn::Rebind<float, Words> floats;
constexpr hn::Rebind<std::int32_t, Words> ints;
constexpr hn::Rebind<std::uint32_t, Words> counts;
using Floats = hn::Vec<decltype(floats)>;

Vector all(int value) {
    return hn::Set(cells, static_cast<std::int16_t>(value));
}

// One of the four 16-bit lanes of each cell, in all four.
template <int lane>
Vector spread(Vector v) {
    constexpr std::uint8_t a = 2 * lane, b = a + 1, c = 8 + a, d = c + 1;
    alignas(16) static constexpr std::uint8_t from[16] = {a, b, a, b, a, b, a, b, c, d, c, d, c, d, c, d};
    const hn::Repartition<std::uint8_t, Cells> bytes;
    return hn::TableLookupBytes(v, hn::BitCast(cells, hn::LoadDup128(bytes, from)));
}

// 1 / coverage where that is over 1, 32767 = 1; at most 2. Newton's step for 1 / x, twice, from the
// straight line that is least off over [1, 2], 24/17 - 8/17 x.
Vector thinning(Vector share) {
    const auto x = hn::Min(hn::Max(share, all(cell_full)), all(2 * cell_full - 1));
    auto y = hn::Sub(all(30840), hn::MulFixedPoint15(all(15420), hn::ShiftLeft<2>(hn::Sub(x, all(cell_full)))));
    for (int i = 0; i < 2; ++i) {
        const auto off = hn::ShiftLeft<2>(hn::Sub(all(cell_full), hn::MulFixedPoint15(x, y)));
        y = hn::SaturatedAdd(y, hn::MulFixedPoint15(y, off));
    }
    return y;
}

// Whether anything of a group of cells can still be seen through.
bool is_open(const Cover* group) {
    alignas(64) static constexpr std::int16_t light[16] = {-1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0};
    // Light counts as full, and what is more than full as much more.
    const auto not_share =
        hn::ShiftRight<1>(hn::BitCast(hn::Repartition<std::uint16_t, Cells>(), hn::Load(cells, light)));
    for (int i = 0; i < group_cells; i += step) {
        const auto there = hn::LoadU(cells, reinterpret_cast<const std::int16_t*>(group + i));
        const auto share = hn::Or(there, hn::BitCast(cells, not_share));
        if (!hn::AllFalse(cells, hn::Lt(share, all(cover_full - closed)))) return true;
    }
    return false;
}

// The last of each cell's lanes.
Floats last_of(Vector v) {
    const hn::RebindToSigned<Words> wide;
    const auto lane = hn::BitCast(words, hn::ShiftRight<48>(hn::BitCast(wide, v)));
    return hn::ConvertTo(floats, hn::BitCast(ints, hn::TruncateTo(counts, lane)));
}

// The depths of a patch.
class Depths {
public:
    explicit Depths(const InDepth& people)
        : middle_(hn::Set(floats, people.depth)),
          reach_(hn::Set(floats, people.reach)),
          steps_(hn::Set(floats, 32767.0f / people.reach)) {}

    // How far back a depth [m] of each cell is, in all four lanes: in the reach from the middle, 32767 = 1.
    Vector back_of(const float* depths) const {
        const auto most = hn::Set(floats, 32767.0f);
        const auto steps = hn::Mul(hn::Sub(hn::LoadU(floats, depths), middle_), steps_);
        const auto whole = hn::ConvertTo(ints, hn::Max(hn::Min(steps, most), hn::Neg(most)));
        return spread<0>(hn::BitCast(cells, hn::PromoteTo(words, hn::BitCast(counts, whole))));
    }
    // near_plane / view depth of what covers so much of each cell and is so far back times that.
    Floats nearness(Vector coverage, Vector back) const {
        const auto covers = hn::Max(last_of(coverage), hn::Set(floats, 1.0f));
        const auto depth = hn::Add(hn::Mul(covers, middle_), hn::Mul(last_of(back), reach_));
        const auto nearest = hn::Mul(covers, hn::Set(floats, near_plane));
        return hn::Div(nearest, hn::Max(depth, nearest));
    }

private:
    Floats middle_, reach_, steps_;
};

// Some of a row's cells, and what they are laid into.
template <bool keeps_depths>
void lay_cells(const InDepth& people, const Depths& depths, std::int16_t* cell, const CoverPlanes& planes,
               std::ptrdiff_t at) {
    const auto a = hn::BitCast(words, hn::Load(cells, cell));
    const auto b = hn::BitCast(words, hn::Load(cells, cell + 4 * step));
    hn::Store(hn::Zero(cells), cells, cell);
    hn::Store(hn::Zero(cells), cells, cell + 4 * step);
    const auto light = hn::BitCast(cells, hn::ConcatEven(words, b, a));
    const auto back = spread<0>(hn::BitCast(cells, hn::ConcatOdd(words, b, a)));
    const auto share = spread<3>(light);
    const auto is_twice = hn::Gt(share, all(2 * cell_full - 1));
    const auto halved = [&](auto v) HWY_ATTR { return hn::IfThenElse(is_twice, hn::ShiftRight<1>(v), v); };
    const auto once = hn::Min(hn::MulFixedPoint15(halved(light), thinning(halved(share))), all(cell_full));
    const auto unit = hn::ShiftLeft<2>(hn::Sub(once, hn::ShiftRight<13>(once)));  // 8192 -> 32764

    auto* to = reinterpret_cast<std::int16_t*>(planes.cover + at);
    auto* flock = reinterpret_cast<std::int16_t*>(planes.flock + at);
    const auto there = hn::LoadU(cells, to), others = hn::LoadU(cells, flock);
    const auto open = hn::Max(hn::Sub(all(cover_full), spread<3>(there)), hn::Zero(cells));
    const auto depth = all(people.depth_code);
    const auto apart = hn::Sub(depth, spread<1>(others));
    const auto beside = hn::And(hn::Gt(apart, all(-1)), hn::Lt(apart, all(people.thickness)));
    const auto before = hn::IfThenElse(beside, spread<0>(others), open);
    const auto is_before = [&](const float* limits) HWY_ATTR {
        return hn::Lt(back, hn::MulFixedPoint15(share, depths.back_of(limits + at)));
    };
    auto shown = hn::And(is_before(planes.hidden_behind), hn::Gt(open, all(closed)));
    if (planes.shown_behind) shown = hn::AndNot(is_before(planes.shown_behind), shown);
    const auto added = hn::IfThenElseZero(shown, hn::MulFixedPoint15(unit, before));
    hn::StoreU(hn::SaturatedAdd(there, added), cells, to);
    const auto joined = hn::OddEven(hn::IfThenElse(beside, spread<1>(others), depth), before);
    hn::StoreU(hn::IfThenElse(hn::And(shown, hn::Gt(share, hn::Zero(cells))), joined, others), cells, flock);
    if constexpr (keeps_depths) {
        float* sum = planes.nearness + at;
        const auto more = hn::Mul(last_of(added), depths.nearness(share, back));
        hn::StoreU(hn::Add(hn::LoadU(floats, sum), more), floats, sum);
    }
}

template <bool keeps_depths>
void lay_rows(const InDepth& people, const Patch& patch, const CoverPlanes& planes) {
    const Depths depths(people);
    for (int y = 0; y < patch.height; ++y) {
        const std::ptrdiff_t row = std::ptrdiff_t{CellPlane<Cover>::stride} * y;
        for (std::uint64_t left = patch.used[y]; left != 0; left &= left - 1) {
            const int first = group_cells * std::countr_zero(left);
            std::int16_t* cell = patch.cells + std::ptrdiff_t{8} * (patch.stride * y + first);
            for (int i = 0; i < group_cells; i += step)
                lay_cells<keeps_depths>(people, depths, cell + 8 * i, planes, row + first + i);
        }
        patch.used[y] = 0;
    }
}

}  // namespace

std::uint64_t OpenGroups(const Cover* cover, int count) {
    std::uint64_t open = 0;
    for (int x = 0; x < count; x += group_cells) open |= std::uint64_t{is_open(cover + x)} << (x / group_cells);
    return open;
}

void LayPatch(const InDepth& people, const Patch& patch, const CoverPlanes& planes) {
    planes.nearness ? lay_rows<true>(people, patch, planes) : lay_rows<false>(people, patch, planes);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(OpenGroups);
HWY_EXPORT(LayPatch);

std::uint64_t open_groups(const Cover* cover, int count) {
    return HWY_DYNAMIC_DISPATCH(OpenGroups)(cover, count);
}

void CoverCells::begin(const Rect& cells, bool keeps_depths) {
    cells_ = cells;
    touched_ = {};
    keeps_depths_ = keeps_depths;
    const int columns = cells.x1 - cells.x0, rows = cells.y1 - cells.y0;
    cover_.fill(columns, rows, {}, {0, 0, 0, cover_full});
    flocks_.fill(columns, rows, {}, {});
    if (keeps_depths) nearness_.fill(columns, rows, 0.0f, 0.0f);
}

Rect CoverCells::open_part(const Rect& cells) const {
    Rect part{std::max(cells.x0, cells_.x0), std::max(cells.y0, cells_.y0), std::min(cells.x1, cells_.x1),
              std::min(cells.y1, cells_.y1)};
    if (part.empty()) return {};
    const int width = part.x1 - part.x0;
    const auto open = [&](int y) { return open_groups(cover_.at(part.x0 - cells_.x0, y - cells_.y0), width); };
    std::uint64_t groups = 0;
    while (part.y0 < part.y1 && (groups = open(part.y0)) == 0) ++part.y0;
    while (part.y0 < part.y1 && open(part.y1 - 1) == 0) --part.y1;
    if (part.empty()) return {};
    // Every group is known to be open or not once one of its rows is.
    const int last = (width - 1) / group_cells;
    for (int y = part.y0 + 1; y < part.y1 && ((groups & 1) == 0 || (groups >> last & 1) == 0); ++y) groups |= open(y);
    part.x1 = std::min(part.x1, part.x0 + group_cells * static_cast<int>(std::bit_width(groups)));
    part.x0 += group_cells * std::countr_zero(groups);
    return part;
}

void CoverCells::lay(const InDepth& people, const Patch& patch, const Limits& limits) {
    const int column = patch.x0 - cells_.x0, row = patch.y0 - cells_.y0;
    const CoverPlanes planes{cover_.at(column, row), flocks_.at(column, row),
                             keeps_depths_ ? nearness_.at(column, row) : nullptr, limits.hidden_behind->at(column, row),
                             limits.shown_behind ? limits.shown_behind->at(column, row) : nullptr};
    HWY_DYNAMIC_DISPATCH(LayPatch)(people, patch, planes);
    const Rect laid{std::max(patch.x0, cells_.x0), std::max(patch.y0, cells_.y0),
                    std::min(patch.x0 + patch.width, cells_.x1), std::min(patch.y0 + patch.height, cells_.y1)};
    touched_ = touched_.empty() ? laid
                                : Rect{std::min(touched_.x0, laid.x0), std::min(touched_.y0, laid.y0),
                                       std::max(touched_.x1, laid.x1), std::max(touched_.y1, laid.y1)};
}

}  // namespace render::native

#endif
