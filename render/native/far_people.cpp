#include "render/native/far_people.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/far_people.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/cache_control.h>
#include <hwy/highway.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/contact_shade.h"
#include "render/native/cell_grid.h"

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, fewest_far_people>;
constexpr Floats floats;
constexpr hn::Rebind<std::int32_t, Floats> ints;
using Float = hn::Vec<Floats>;
using Int = hn::Vec<decltype(ints)>;
constexpr int lanes = static_cast<int>(hn::MaxLanes(floats));

// Some people of a block, as far as they touch a patch.
struct Staged {
    // Rows, on either side of the sun, as offsets into FarScene's.
    alignas(64) std::int32_t before[lanes], behind[lanes];
    alignas(64) std::int32_t to_sun[lanes], around[lanes], up[lanes];  // between rows, 32767 = 1
    alignas(64) std::int32_t cell[lanes];  // of the first of their four cells, as an offset into a patch's
    // What the upper and the lower two of them get: in the low half the left one, 32767 = all.
    alignas(64) std::int32_t upper[lanes], lower[lanes];
    alignas(64) std::int32_t back[lanes];   // way back from the block's middle, 32767 = its reach
    alignas(64) std::int32_t steps[lanes];  // [1/8192 cell] that the largest silhouette covers
    alignas(64) std::int32_t shade[lanes];  // [1/8192 cell] of black under them that is as dark as their shade
};

Float set(float value) {
    return hn::Set(floats, value);
}

// diamond_of, in [0, 4).
Float diamond(Float x, Float z) {
    const Float size = hn::Max(hn::Add(hn::Abs(x), hn::Abs(z)), set(1e-30f));
    const Float along = hn::Div(x, size);
    const Float front = hn::IfThenElse(hn::Lt(x, hn::Zero(floats)), hn::Add(set(4.0f), along), along);
    return hn::IfThenElse(hn::Lt(z, hn::Zero(floats)), hn::Sub(set(2.0f), along), front);
}

struct Step {
    Int whole;
    Int part;  // 32767 = 1
};

// Of so many.
Step step_of(Float value, Float steps_each, float steps) {
    const Float at = hn::Min(hn::Mul(value, steps_each), set(steps - 0.0001f));
    const Int whole = hn::ConvertTo(ints, at);
    return {whole, hn::ConvertTo(ints, hn::Mul(hn::Sub(at, hn::ConvertTo(floats, whole)), set(32767.0f)))};
}

Int floor_of(Float value) {
    return hn::ConvertTo(ints, hn::Floor(value));
}

// All of a person, or the upper or lower half.
struct Part {
    float quarters;  // of their height, down from the middle
    float share;
};

// Stages `lanes` people from `person` on, of whom those from `first` on count; returns which of them touch the patch, a
// bit each.
std::uint32_t stage(const FarScene& scene, const FarBlockOnScreen& block, Part part, std::size_t first,
                    std::size_t person, const Patch& patch, Staged& out) {
    const scene::Crowd& crowd = *scene.people.crowd;
    const hn::Rebind<std::uint8_t, Floats> bytes;
    const Int character = hn::PromoteTo(ints, hn::LoadU(bytes, &crowd.character[person]));
    const auto of_character = [&](const auto& table) HWY_ATTR {
        const hn::Rebind<std::decay_t<decltype(table[0])>, Floats> tag;
        return block.character >= 0 ? hn::Set(tag, table[static_cast<std::size_t>(block.character)])
                                    : hn::GatherIndex(tag, table.data(), character);
    };
    const Int key =
        hn::Add(of_character(scene.first_key), hn::PromoteTo(ints, hn::LoadU(bytes, scene.people.keys + person)));
    const Float height = hn::LoadU(floats, &crowd.height[person]);
    const Float scale = hn::Mul(height, of_character(scene.metres));
    const Int turn = hn::LoadU(ints, reinterpret_cast<const std::int32_t*>(scene.people.turns + person));
    const Float unit = set(1.0f / 32767.0f);
    const Float sine = hn::Mul(hn::ConvertTo(floats, hn::ShiftRight<16>(hn::ShiftLeft<16>(turn))), unit);
    const Float cosine = hn::Mul(hn::ConvertTo(floats, hn::ShiftRight<16>(turn)), unit);

    Float at[3];
    hn::LoadInterleaved3(floats, &crowd.position[person].x, at[0], at[1], at[2]);
    for (int axis = 0; axis < 3; ++axis)
        at[axis] = hn::Sub(hn::Sub(at[axis], set(block.eye[0][axis])), set(block.eye[1][axis]));
    const Float center[3] = {of_character(scene.center_x), of_character(scene.center_y), of_character(scene.center_z)};
    at[0] = hn::Add(at[0], hn::Mul(scale, hn::Add(hn::Mul(cosine, center[0]), hn::Mul(sine, center[2]))));
    at[1] = hn::Add(at[1], hn::Mul(scale, center[1]));
    at[2] = hn::Add(at[2], hn::Mul(scale, hn::Sub(hn::Mul(cosine, center[2]), hn::Mul(sine, center[0]))));

    const auto along = [&](glm::vec3 axis) HWY_ATTR {
        return hn::Add(hn::Add(hn::Mul(at[0], set(axis.x)), hn::Mul(at[1], set(axis.y))), hn::Mul(at[2], set(axis.z)));
    };
    const Float depth = hn::Max(along(scene.forward), set(near_plane));
    const Float cells_per_metre = hn::Div(set(scene.cells_at_one_metre), depth);
    constexpr float steps_a_cell = 1 << cell_bits;
    const auto place = [&](Float from_middle, float middle, int start) HWY_ATTR {
        constexpr float farthest = 1e6f;  // beyond every picture
        const Float from = hn::Add(from_middle, set(middle - 0.5f));
        const Float clamped = hn::Max(hn::Min(from, set(farthest)), set(-farthest));
        return hn::Sub(floor_of(hn::Mul(clamped, set(steps_a_cell))), hn::Set(ints, start << cell_bits));
    };
    const Int x = place(hn::Mul(along(scene.right), cells_per_metre), scene.center[0], patch.x0);
    const Float cells = hn::Mul(cells_per_metre, scale);
    // Who is low in cells is as well one splat: both halves of it lie in the middle.
    const Float tall = hn::Mul(hn::Mul(cells, of_character(scene.height)), set(scene.up.y));
    const Float down = hn::IfThenElseZero(hn::Gt(tall, set(lowest_tall)), hn::Mul(tall, set(0.25f * part.quarters)));
    const Int y = place(hn::Sub(down, hn::Mul(along(scene.up), cells_per_metre)), scene.center[1], patch.y0);
    const auto within = [&](Int where, int size) HWY_ATTR {
        return hn::And(hn::Gt(where, hn::Set(ints, -1)), hn::Lt(where, hn::Set(ints, (size - 1) << cell_bits)));
    };
    // The last ones of the crowd are read together with some before them.
    const auto number = [&](std::size_t of) HWY_ATTR {
        return hn::Set(ints, static_cast<std::int32_t>(of) - static_cast<std::int32_t>(person));
    };
    const Int lane = hn::Iota(ints, 0);
    const auto is_of_block = hn::And(hn::Gt(lane, number(first - 1)), hn::Lt(lane, number(block.first + block.count)));
    const auto used = hn::And(hn::And(within(x, patch.width), within(y, patch.height)), is_of_block);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(ints, used, bits);
    const std::uint32_t mask = bits[0] | std::uint32_t{bits[1]} << 8;
    if (mask == 0) return 0;

    constexpr std::size_t line = 64;
    for (std::size_t byte = 0; byte < lanes * sizeof(scene::Palette); byte += line)
        hwy::Prefetch(reinterpret_cast<const std::uint8_t*>(&crowd.palette[person]) + byte);
    const auto cells_of = [](Int steps) HWY_ATTR { return hn::ShiftRight<cell_bits>(steps); };
    const Int cell = hn::Add(hn::Mul(cells_of(y), hn::Set(ints, patch.stride)), cells_of(x));
    hn::Store(hn::ShiftLeft<3>(cell), ints, out.cell);
    const auto part_of = [](Int steps) HWY_ATTR { return hn::And(steps, hn::Set(ints, (1 << cell_bits) - 1)); };
    const auto shares = [&](Int vertical) HWY_ATTR {
        const Int right = hn::Mul(part_of(x), vertical), both = hn::ShiftLeft<cell_bits>(vertical);
        constexpr int to_unit = 2 * cell_bits - 15;  // a product's bits, where 15 are 1
        static_assert(to_unit == -1);
        const auto unit_of = [](Int product)
                                 HWY_ATTR { return hn::Min(hn::ShiftLeft<-to_unit>(product), hn::Set(ints, 32767)); };
        return hn::Or(unit_of(hn::Sub(both, right)), hn::ShiftLeft<16>(unit_of(right)));
    };
    hn::Store(shares(hn::Sub(hn::Set(ints, 1 << cell_bits), part_of(y))), ints, out.upper);
    hn::Store(shares(part_of(y)), ints, out.lower);
    const Float back = hn::Mul(hn::Sub(depth, set(block.depth)), set(32767.0f / block.reach));
    hn::Store(hn::ConvertTo(ints, hn::Max(hn::Min(back, set(32767.0f)), set(-32767.0f))), ints, out.back);
    // Off the picture's middle a silhouette's image is larger, as it is cast aslant.
    const auto square = [](Float v) HWY_ATTR { return hn::Mul(v, v); };
    const Float out_square = hn::Add(square(at[0]), square(at[2]));
    const Float aslant = hn::Div(hn::Sqrt(hn::Add(out_square, square(at[1]))), depth);
    const Float largest = of_character(scene.largest_silhouette);
    const Float area = hn::Mul(hn::Mul(hn::Mul(square(cells), aslant), set(part.share * cell_full)), largest);
    hn::Store(hn::ConvertTo(ints, hn::Min(hn::Add(area, set(0.5f)), set(32767.0f))), ints, out.steps);

    // Seen from aside it is smaller; nobody who sits has any.
    const Float radius = hn::Mul(hn::Mul(height, set(contact_reach)), cells_per_metre);
    const Float spot =
        hn::Mul(hn::Mul(square(radius), set(block.in_rows ? 0.0f : contact_area * part.share * cell_full)),
                hn::Div(hn::Abs(at[1]), depth));
    hn::Store(hn::ConvertTo(ints, hn::Min(hn::Add(spot, set(0.5f)), set(32767.0f))), ints, out.shade);
    const auto turned = [&](Float dx, Float dz) HWY_ATTR {
        return diamond(hn::Sub(hn::Mul(cosine, dx), hn::Mul(sine, dz)),
                       hn::Add(hn::Mul(cosine, dz), hn::Mul(sine, dx)));
    };
    const Step eye = step_of(turned(hn::Neg(at[0]), hn::Neg(at[2])), set(0.25f * ring_nodes), ring_nodes);
    const Step sun =
        step_of(turned(set(scene.to_sun[0]), set(scene.to_sun[1])), set(0.25f * sun_azimuths), sun_azimuths);
    // between_nodes': from straight below, -1, to straight above.
    const Float upward = hn::Div(hn::Neg(at[1]), hn::Max(hn::Add(hn::Abs(at[1]), hn::Sqrt(out_square)), set(1e-30f)));
    const Step ring = step_of(hn::Add(upward, set(1.0f)), set(0.5f * (rings - 1)), rings - 1);
    hn::Store(ring.part, ints, out.up);
    const auto rows = [](Int count) HWY_ATTR { return hn::Mul(count, hn::Set(ints, far_row_values)); };
    const Int own = hn::Add(hn::Add(hn::Mul(key, hn::Set(ints, far_key_rows)), eye.whole),
                            hn::Mul(ring.whole, hn::Set(ints, far_ring_rows)));
    const Int before = hn::Add(own, hn::Mul(sun.whole, hn::Set(ints, far_sun_rows)));
    const auto is_last = hn::Eq(sun.whole, hn::Set(ints, sun_azimuths - 1));
    hn::Store(rows(before), ints, out.before);
    hn::Store(rows(hn::IfThenElse(is_last, own, hn::Add(before, hn::Set(ints, far_sun_rows)))), ints, out.behind);
    hn::Store(sun.part, ints, out.to_sun);
    hn::Store(eye.part, ints, out.around);
    return mask;
}

// Rows of two neighbours around the ring, and one.
using Two = hn::CappedTag<std::int16_t, 2 * far_row_values>;
using One = hn::CappedTag<std::int16_t, far_row_values>;
constexpr Two two_rows;
constexpr One one_row;
using Pixel = hn::FixedTag<std::int16_t, 8>;
constexpr Pixel pixel;

// A person's row in their colours: what slots send, and in the last the silhouette.
struct Colored {
    hn::Vec<Pixel> low, high;
};

template <typename Vector>
Vector between(Vector a, Vector b, Vector share) {
    return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), share));
}

Colored look_at(const FarScene& scene, const Staged& staged, int i, const scene::Palette& palette) {
    const std::int16_t* before = scene.rows.data() + staged.before[i];
    const std::int16_t* behind = scene.rows.data() + staged.behind[i];
    const auto to_sun = hn::Set(two_rows, static_cast<std::int16_t>(staged.to_sun[i]));
    const auto around = hn::Set(one_row, static_cast<std::int16_t>(staged.around[i]));
    const auto above = hn::Set(two_rows, static_cast<std::int16_t>(staged.up[i]));
    // Of both neighbours, of values from `first` on.
    const auto neighbours = [&](int first) HWY_ATTR {
        constexpr int ring = far_ring_rows * far_row_values;
        const auto at = [&](const std::int16_t* from) HWY_ATTR {
            return between(hn::LoadU(two_rows, from + first), hn::LoadU(two_rows, from + ring + first), above);
        };
        return between(at(before), at(behind), to_sun);
    };
    alignas(16) static constexpr std::uint8_t fourths[] = {0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};
    const auto* colors = reinterpret_cast<const std::uint8_t*>(palette.colors.data());
    const auto colored = [&](auto look, int first) HWY_ATTR {
        const hn::RebindToUnsigned<One> shorts;
        const hn::Rebind<std::uint8_t, decltype(shorts)> bytes;
        const auto color =
            hn::PromoteTo(shorts, hn::Or(hn::LoadU(bytes, colors + first), hn::LoadU(bytes, fourths + first)));
        const auto linear = hn::BitCast(one_row, hn::ShiftRight<1>(hn::Mul(color, color)));
        return hn::MulFixedPoint15(look, linear);
    };
#if HWY_MAX_BYTES >= 64
    const auto both = neighbours(0);
    const auto row = between(hn::LowerHalf(one_row, both), hn::UpperHalf(one_row, both), around);
#elif HWY_MAX_BYTES >= 32
    const auto row = between(neighbours(0), neighbours(far_row_values), around);
#endif
#if HWY_MAX_BYTES >= 32
    const auto all = colored(row, 0);
    return {hn::LowerHalf(pixel, all), hn::UpperHalf(pixel, all)};
#else
    constexpr int half = far_row_values / 2;
    return {colored(between(neighbours(0), neighbours(far_row_values), around), 0),
            colored(between(neighbours(half), neighbours(far_row_values + half), around), half)};
#endif
}

// Red, green and blue of all slots, 32767 = 1, then the silhouette.
hn::Vec<Pixel> sum_up(const Colored& row) {
    const hn::Repartition<std::uint8_t, Pixel> bytes;
    const auto fourths_of = [&](auto values, const std::uint8_t* from) HWY_ATTR {
        return hn::BitCast(pixel, hn::TableLookupBytesOr0(hn::BitCast(bytes, values), hn::Load(bytes, from)));
    };
    constexpr std::uint8_t no = 128;
    alignas(16) static constexpr std::uint8_t to_low[] = {6, 7, 14, 15, no, no, no, no, no, no, no, no, no, no, no, no};
    alignas(16) static constexpr std::uint8_t to_high[] = {no, no, no, no, 6,  7,  14, 15,
                                                           no, no, no, no, no, no, no, no};
    alignas(16) static constexpr std::int16_t is_slot[] = {-1, -1, -1, 0, -1, -1, -1, 0};
    const auto both = hn::BitCast(bytes, hn::And(hn::SaturatedAdd(row.low, row.high), hn::Load(pixel, is_slot)));
    const auto other = hn::BitCast(pixel, hn::CombineShiftRightBytes<8>(bytes, both, both));
    return hn::SaturatedAdd(hn::SaturatedAdd(hn::BitCast(pixel, both), other),
                            hn::Add(fourths_of(row.low, to_low), fourths_of(row.high, to_high)));
}

// Adds to two neighbours: the left one's share of the value is in the low half.
void add_pair(std::int16_t* cells, hn::Vec<Pixel> value, std::int32_t shares) {
#if HWY_MAX_BYTES >= 32
    using Pair = hn::FixedTag<std::int16_t, 16>;
    constexpr Pair pair;
    const hn::Repartition<std::uint8_t, Pair> bytes;
    alignas(32) static constexpr std::uint8_t halves[] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1,
                                                          2, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 3};
    const auto both = hn::BitCast(pair, hn::Set(hn::Repartition<std::int32_t, Pair>(), shares));
    const auto each = hn::TableLookupBytes(both, hn::BitCast(pair, hn::Load(bytes, halves)));
    const auto added = hn::MulFixedPoint15(hn::Combine(pair, value, value), each);
    hn::StoreU(hn::SaturatedAdd(hn::LoadU(pair, cells), added), pair, cells);
#else
    for (int i = 0; i < 2; ++i) {
        const auto share = hn::Set(pixel, static_cast<std::int16_t>(shares >> 16 * i));
        hn::Store(hn::SaturatedAdd(hn::Load(pixel, cells + 8 * i), hn::MulFixedPoint15(value, share)), pixel,
                  cells + 8 * i);
    }
#endif
}

// Which lanes of a cell count people's shade, too.
hn::Mask<Pixel> with_shade() {
    alignas(16) static constexpr std::int16_t is_with[] = {0, 0, 0, -1, -1, 0, 0, 0};
    return hn::MaskFromVec(hn::Load(pixel, is_with));
}

// Of each cell: people's light, coverage, the way back times coverage, and what of the coverage is people.
void add(const FarScene& scene, const Staged& staged, int i, std::size_t person, const Patch& patch) {
    const auto sum = sum_up(look_at(scene, staged, i, scene.people.crowd->palette[person]));
    alignas(16) static constexpr std::int16_t is_light[] = {-1, -1, -1, 0, 0, 0, 0, 0};
    alignas(16) static constexpr std::int16_t is_back[] = {0, 0, 0, 0, -1, 0, 0, 0};
    alignas(16) static constexpr std::int16_t one[] = {0, 0, 0, 32767, 0, 32767, 0, 0};
    const auto back = hn::And(hn::Set(pixel, static_cast<std::int16_t>(staged.back[i])), hn::Load(pixel, is_back));
    const auto each = hn::Or(hn::And(sum, hn::Load(pixel, is_light)), hn::Or(back, hn::Load(pixel, one)));
    alignas(16) static constexpr std::uint8_t fourth[] = {6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6, 7};
    const hn::Repartition<std::uint8_t, Pixel> bytes;
    const auto silhouette = hn::TableLookupBytes(sum, hn::BitCast(pixel, hn::Load(bytes, fourth)));
    const auto area = hn::MulFixedPoint15(silhouette, hn::Set(pixel, static_cast<std::int16_t>(staged.steps[i])));
    const auto all = hn::SaturatedAdd(area, hn::Set(pixel, static_cast<std::int16_t>(staged.shade[i])));
    const auto value = hn::MulFixedPoint15(each, hn::IfThenElse(with_shade(), all, area));
    std::int16_t* cells = patch.cells + staged.cell[i];
    add_pair(cells, value, staged.upper[i]);
    add_pair(cells + 8 * patch.stride, value, staged.lower[i]);
}

bool is_empty(const std::int16_t* group) {
    using Cells = hn::CappedTag<std::int16_t, 8 * group_cells>;
    constexpr Cells cells;
    auto any = hn::Zero(cells);
    for (int i = 0; i < 8 * group_cells; i += static_cast<int>(hn::MaxLanes(cells)))
        any = hn::Or(any, hn::Load(cells, group + i));
    return hn::AllTrue(cells, hn::Eq(any, hn::Zero(cells)));
}

// Areas that fell on a cell become what they cover of it, and that shows more of people's upper parts. Says which
// groups of cells are used.
void thin(const FarScene& scene, const FarBlockOnScreen& block, const Patch& patch) {
    alignas(16) std::int16_t leaning[8] = {};
    for (int channel = 0; channel < 3; ++channel)
        leaning[channel] =
            static_cast<std::int16_t>(std::clamp(0.5f * block.leaning[channel], -0.999f, 0.999f) * 32767.0f);
    const auto lean = hn::Load(pixel, leaning);
    const FarCover& cover = block.in_rows ? scene.in_rows : scene.scattered;
    for (int y = 0; y < patch.height; ++y) {
        std::int16_t* group = patch.cells + std::ptrdiff_t{8} * patch.stride * y;
        std::uint64_t used = 0;
        for (int x = 0; x < patch.stride; x += group_cells, group += 8 * group_cells) {
            if (is_empty(group)) continue;
            used |= std::uint64_t{1} << (x / group_cells);
            for (std::int16_t* cell = group; cell < group + 8 * group_cells; cell += 8) {
                // What lies under people is hidden as what is behind them.
                const int all = cell[3] >> far_cover_shift, people = cell[5] >> far_cover_shift;
                const auto share = hn::IfThenElse(with_shade(), hn::Set(pixel, cover.covered[all]),
                                                  hn::Set(pixel, cover.covered[people]));
                const auto covers = hn::MulFixedPoint15(hn::Load(pixel, cell), share);
                const auto more = hn::MulFixedPoint15(lean, hn::Set(pixel, cover.upper[people]));
                hn::Store(hn::SaturatedAdd(covers, hn::MulFixedPoint15(covers, more)), pixel, cell);
            }
        }
        patch.used[y] = used;
    }
}

}  // namespace

void SplatBlock(const FarScene& scene, const FarBlockOnScreen& block, const Patch& to) {
    const Patch patch = to;  // of its own: what is stored could change it otherwise, for all that is known
    const std::size_t last = scene.people.crowd->size() - lanes;
    const auto add_all = [&](Part part) HWY_ATTR {
        Staged staged;
        for (std::size_t first = block.first; first < block.first + block.count; first += lanes) {
            const std::size_t person = std::min(first, last);
            std::uint32_t left = stage(scene, block, part, first, person, patch, staged);
            for (; left != 0; left &= left - 1) {
                const int i = std::countr_zero(left);
                add(scene, staged, i, person + static_cast<std::size_t>(i), patch);
            }
        }
    };
    if (block.is_tall) {
        add_all({-1.0f, 0.5f});
        add_all({1.0f, 0.5f});
    } else {
        add_all({0.0f, 1.0f});
    }
    thin(scene, block, patch);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(SplatBlock);

namespace {

std::int16_t clamped(float cells) {
    constexpr float most = 16000.0f;
    return static_cast<std::int16_t>(std::clamp(cells, -most, most));
}

}  // namespace

FarCrowd::FarCrowd(std::span<const figures::Figure> figures, const scene::Light& light)
    : figures_(figures.begin(), figures.end()) {
    scene_.to_sun = {light.to_sun.x, light.to_sun.z};
    const auto fill = [](FarCover& cover, auto covered_by) {
        for (std::size_t i = 0; i < cover.covered.size(); ++i) {
            const double areas = (static_cast<double>(i) + 0.5) * (1 << far_cover_shift) / cell_full;
            const double open = std::exp(-areas);
            // Where the middle of what shows is, from the top, if the farther down the more is hidden.
            const double down = 1.0 / areas - open / (1.0 - open);
            cover.covered[i] = static_cast<std::int16_t>(std::lround(32767.0 * covered_by(areas) / areas));
            cover.upper[i] = static_cast<std::int16_t>(std::lround(32767.0 * (1.0 - 2.0 * down)));
        }
    };
    fill(scene_.scattered, [](double areas) { return 1.0 - std::exp(-areas); });
    fill(scene_.in_rows, [](double areas) { return areas / std::sqrt(1.0 + areas * areas); });
}

void FarCrowd::learn(std::span<const SplatModel* const> models) {
    leanings_.resize(figures_.size());
    std::size_t keys = 0;
    for (std::size_t character = 0; character < figures_.size(); ++character) {
        scene_.metres.push_back(1.0f / figures_[character].poses->rest_height);
        scene_.first_key.push_back(static_cast<std::int32_t>(keys));
        if (!models[character]) {
            scene_.largest_silhouette.push_back(0.0f);
            for (auto* center : {&scene_.center_x, &scene_.center_y, &scene_.center_z}) center->push_back(0.0f);
            continue;
        }
        const FarLooks looks(figures_[character], *models[character]);
        leanings_[character] = looks.leanings;
        scene_.largest_silhouette.push_back(looks.largest_silhouette);
        scene_.rows.insert(scene_.rows.end(), looks.rows.begin(), looks.rows.end());
        const FarShape shape = far_shape(*figures_[character].poses);
        scene_.center_x.push_back(shape.center.x);
        scene_.center_y.push_back(shape.center.y);
        scene_.center_z.push_back(shape.center.z);
        scene_.height.push_back(shape.height);
        keys += looks.rows.size() / (far_key_rows * far_row_values);
    }
}

void FarCrowd::look_at(const scene::Crowd& crowd) {
    crowd_ = &crowd;
    looks_.resize(crowd.blocks.size());
    tbb::parallel_for(std::size_t{0}, looks_.size(),
                      [&](std::size_t block) { looks_[block] = look_of(crowd, crowd.blocks[block]); });
}

FarCrowd::Look FarCrowd::look_of(const scene::Crowd& crowd, const scene::CrowdBlock& block) {
    std::array<std::uint32_t, 256> people{};
    Look look;
    for (std::size_t person = block.first; person < block.first + block.count; ++person) {
        ++people[crowd.character[person]];
        for (std::size_t slot = 1; slot <= model::slot_count; ++slot) {
            const glm::vec3 share = glm::vec3(crowd.palette[person].colors[slot - 1]) / 255.0f;
            look.colors[slot] += share * share;
        }
    }
    for (glm::vec3& color : look.colors) color /= static_cast<float>(block.count);
    look.colors[model::no_slot] = glm::vec3(1.0f);
    look.character = static_cast<std::size_t>(std::ranges::max_element(people) - people.begin());
    look.is_mixed = people[look.character] < block.count;
    return look;
}

std::array<float, 3> FarCrowd::leaning_of(const Look& look, float ring) const {
    const int below = std::min(static_cast<int>(ring), rings - 2);
    const float up = ring - static_cast<float>(below);
    const Leaning& a = leanings_[look.character][static_cast<std::size_t>(below)];
    const Leaning& b = leanings_[look.character][static_cast<std::size_t>(below) + 1];
    glm::vec3 mean(0.0f), lean(0.0f);
    for (std::size_t slot = 0; slot <= model::slot_count; ++slot) {
        mean += look.colors[slot] * glm::mix(a.mean[slot], b.mean[slot], up);
        lean += look.colors[slot] * glm::mix(a.lean[slot], b.lean[slot], up);
    }
    std::array<float, 3> out{};
    for (int channel = 0; channel < 3; ++channel)
        if (mean[channel] > 0.0f) out[channel] = 12.0f * lean[channel] / mean[channel];
    return out;
}

void FarCrowd::prepare(const Frame& frame, float cell) {
    const View& view = frame.view;
    scene_.people = frame.far_people;
    scene_.right = view.right;
    scene_.up = view.up;
    scene_.forward = view.forward;
    scene_.cells_at_one_metre = view.pixels_per_metre(1.0f) / cell;
    scene_.center = {0.5f / cell * static_cast<float>(view.width), 0.5f / cell * static_cast<float>(view.height)};
    if (!frame.far_blocks.empty() && frame.far_people.crowd != crowd_) look_at(*frame.far_people.crowd);
    by_depth_ = frame.far_blocks;
    std::ranges::stable_sort(by_depth_, {}, &FarBlock::depth);
    blocks_.resize(by_depth_.size());
    bounds_.resize(by_depth_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, by_depth_.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            blocks_[i] = ready(view, by_depth_[i]);
            bounds_[i] = pixels_of(blocks_[i].cells(), cell);
        }
    });
}

FarBlockOnScreen FarCrowd::ready(const View& world, const FarBlock& far) const {
    const scene::CrowdBlock& block = scene_.people.crowd->blocks[far.block];
    const View view = world.from(block.origin);
    const DepthRange depths = depth_range(view, block.box);
    const float extent = depths.farthest - depths.nearest;
    FarBlockOnScreen out;
    static_cast<InDepth&>(out) = in_depth(far.depth, std::max(extent, near_plane), 0.0f);
    out.in_rows = scene_.people.crowd->role[block.first] == scene::Role::spectator;
    const Look& look = looks_[far.block];
    out.character = look.is_mixed ? -1 : static_cast<std::int32_t>(look.character);
    out.first = block.first;
    out.count = block.count;
    out.eye[0] = glm::vec3(view.position);
    out.eye[1] = glm::vec3(view.position - glm::dvec3(out.eye[0]));
    const glm::vec3 middle = view.relative(block.box.center());
    const Between between = between_nodes(middle == glm::vec3(0.0f) ? -view.forward : -middle);
    out.leaning = leaning_of(look, static_cast<float>(between.node[0] / ring_nodes) + between.up);
    constexpr float tallest = 2.0f;  // [m]
    float height = 0;
    for (std::size_t character = 0; character < figures_.size(); ++character)
        if (look.is_mixed || character == look.character)
            height = std::max(height, scene_.height[character] * scene_.metres[character] * tallest * view.up.y);
    out.is_tall = height * scene_.cells_at_one_metre > lowest_tall * std::max(depths.nearest, near_plane);
    glm::vec2 from(INFINITY), to(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at = view.relative({corner & 1 ? block.box.max.x : block.box.min.x,
                                            corner & 2 ? block.box.max.y : block.box.min.y,
                                            corner & 4 ? block.box.max.z : block.box.min.z});
        const float scale = scene_.cells_at_one_metre / std::max(view.depth(at), near_plane);
        const glm::vec2 cells = scale * glm::vec2(glm::dot(view.right, at), -glm::dot(view.up, at));
        from = glm::min(from, cells);
        to = glm::max(to, cells);
    }
    out.x0 = clamped(std::floor(from.x + scene_.center[0]) - 1.0f);
    out.y0 = clamped(std::floor(from.y + scene_.center[1]) - 1.0f);
    out.x1 = clamped(std::floor(to.x + scene_.center[0]) + 3.0f);
    out.y1 = clamped(std::floor(to.y + scene_.center[1]) + 3.0f);
    return out;
}

void FarCrowd::prefetch(const FarBlockOnScreen& block) const {
    const scene::Crowd& crowd = *scene_.people.crowd;
    constexpr int lines = 3;
    const auto ahead = [](const auto* first) {
        for (int line = 0; line < lines; ++line)
            hwy::Prefetch(reinterpret_cast<const std::uint8_t*>(first) + 64 * line);
    };
    ahead(&crowd.position[block.first]);
    ahead(&crowd.height[block.first]);
    ahead(&crowd.character[block.first]);
    ahead(scene_.people.keys + block.first);
    ahead(scene_.people.turns + block.first);
}

void FarCrowd::splat(const FarBlockOnScreen& block, const Patch& patch) const {
    HWY_DYNAMIC_DISPATCH(SplatBlock)(scene_, block, patch);
}

}  // namespace render::native

#endif
