#include "render/native/splat.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/splat.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "render/native/splat_model.h"

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::int16_t, chunk_points>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes lanes;
using Pixel = hn::FixedTag<std::int16_t, 8>;
constexpr Pixel pixel;

Vector all(std::int16_t value) {
    return hn::Set(lanes, value);
}
Vector times(Vector a, Vector b) {
    return hn::MulFixedPoint15(a, b);
}

Vector dot(const Vector* v, const std::array<std::int16_t, 3>& axis) {
    return hn::SaturatedAdd(hn::SaturatedAdd(times(v[0], all(axis[0])), times(v[1], all(axis[1]))),
                            times(v[2], all(axis[2])));
}

// 127 becomes 32512; what they are multiplied by makes up for it.
void load_directions(const std::array<std::array<std::int8_t, chunk_points>, 3>& from, int lane, Vector* direction) {
    const hn::Rebind<std::int8_t, Lanes> bytes;
    for (int axis = 0; axis < 3; ++axis)
        direction[axis] = hn::ShiftLeft<8>(hn::PromoteTo(lanes, hn::LoadU(bytes, &from[axis][lane])));
}

// How much of each point is seen from the eye, were it to face it.
HWY_INLINE Vector seen(const SplatPerson& person, int chunk, int lane) {
    const auto from = [&](int i) HWY_ATTR {
        const auto* bits = reinterpret_cast<const std::uint8_t*>(person.visible_of(chunk, i)) + lane / 8;
        return hn::IfThenElseZero(hn::LoadMaskBits(lanes, bits), all(person.visible_share[i]));
    };
    return hn::SaturatedAdd(hn::SaturatedAdd(from(0), from(1)), hn::SaturatedAdd(from(2), from(3)));
}

// What each point shows of its area; a quarter of it, as facets and shares go up to 2.
HWY_INLINE Vector shown(const SplatPerson& person, int chunk, int lane) {
    Vector facet[3];
    load_directions(person.chunk(chunk).facet, lane, facet);
    const Vector facing = dot(facet, person.to_eye);
    const Vector near = hn::Load(lanes, person.shares[0] + chunk * chunk_points + lane);
    const Vector far = hn::Load(lanes, person.shares[1] + chunk * chunk_points + lane);
    const Vector share = hn::Add(near, times(hn::Sub(far, near), all(person.to_far)));
    Vector part = person.two_sided ? hn::Abs(facing) : hn::Max(facing, hn::Zero(lanes));
    if (person.hides_itself) part = times(part, seen(person, chunk, lane));
    part = times(part, share);
    const Vector index = hn::Iota(lanes, static_cast<std::int16_t>(chunk * chunk_points + lane));
    const Vector last = all(static_cast<std::int16_t>(person.count - 1));
    part = hn::IfThenElse(hn::Eq(index, last), times(part, all(person.last_share)), part);
    return hn::IfThenZeroElse(hn::Gt(index, last), part);
}

// A chunk that is read soon.
HWY_INLINE void prefetch(const SplatPerson& person, int chunk) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&person.chunk(chunk));
    for (std::size_t at = 0; at < sizeof(PosedChunk); at += 64) hwy::Prefetch(bytes + at);
}

int chunks_of(const SplatPerson& person) {
    return (person.count + chunk_points - 1) / chunk_points;
}

// Normals of points that are seen from behind show that side's light.
void turn_to_eye(const SplatPerson& person, int chunk, int lane, Vector* normal) {
    Vector facet[3];
    load_directions(person.chunk(chunk).facet, lane, facet);
    const auto away = hn::Lt(dot(facet, person.to_eye), hn::Zero(lanes));
    for (int axis = 0; axis < 3; ++axis) normal[axis] = hn::IfThenElse(away, hn::Neg(normal[axis]), normal[axis]);
}

// What is found of a chunk before it is added to the patch. All but the last is at multiples of 64 bytes.
struct alignas(64) Staged {
    std::uint64_t light_and_area[chunk_points];
    std::int16_t column[chunk_points], row[chunk_points];  // of the first of its four cells
    std::int16_t right[chunk_points], down[chunk_points];  // how far it is from that one's middle, 32768 = a cell
    std::int16_t back[chunk_points + 4];                   // way back times area; read eight bytes at a time
    std::uint32_t used;                                    // a bit a point
};

// Linear colour of the surface, 32767 = 1.
Vector albedo(const SplatPerson& person, int channel, int chunk, int lane, Vector index_bytes) {
    if (person.slot_shares) {
        const Vector own = hn::Load(lanes, person.colors + channel * chunk_points + lane);
        Vector tint = hn::Zero(lanes);
        for (int slot = 0; slot <= model::slot_count; ++slot)
            tint = hn::SaturatedAdd(tint, times(hn::Load(lanes, person.slot_shares + slot * chunk_points + lane),
                                                all(person.palette[channel][slot])));
        return times(own, tint);
    }
    const Vector own = hn::Load(lanes, person.colors + (chunk * 3 + channel) * chunk_points + lane);
    const hn::Repartition<std::uint8_t, Lanes> bytes;
    const auto table = hn::LoadDup128(lanes, person.palette[channel].data());
    const Vector tint = hn::TableLookupBytes(table, hn::BitCast(lanes, hn::BitCast(bytes, index_bytes)));
    return times(own, tint);
}

// Of points that may shine: what they emit, by channel, and the share of their colour that is seen in any light and
// shade.
Vector own_light(const SplatPerson& person, int value, int chunk, int lane) {
    const int row = (person.slot_shares ? 0 : chunk * own_light_values) + value;
    return hn::Load(lanes, person.own_lights + row * chunk_points + lane);
}

// Linear light that each point sends, 32767 = 1.
void find_colors(const SplatPerson& person, const SplatLight& light, int chunk, int lane, Vector* color) {
    Vector normal[3];
    load_directions(person.chunk(chunk).normal, lane, normal);
    if (person.two_sided) turn_to_eye(person, chunk, lane, normal);
    const Vector sunlit = hn::Max(dot(normal, person.to_sun), hn::Zero(lanes));
    const Vector index =
        hn::Load(lanes, reinterpret_cast<const std::int16_t*>(person.slots) + chunk * chunk_points + lane);
    for (int channel = 0; channel < 3; ++channel) {
        Vector lit = hn::Add(hn::Add(all(light.level[channel]), times(normal[1], all(light.slope[channel]))),
                             times(sunlit, all(light.sun[channel])));
        if (person.own_lights) lit = hn::Add(lit, times(hn::Sub(all(16384), lit), own_light(person, 3, chunk, lane)));
        Vector half = times(lit, albedo(person, channel, chunk, lane, index));
        if (person.own_lights)
            half = hn::SaturatedAdd(half, hn::ShiftRight<1>(own_light(person, channel, chunk, lane)));
        half = hn::Min(half, all(16383));
        color[channel] = hn::Add(half, half);
    }
}

// Of short prefixes, what each point shows and sends is needed twice: to sum it up, and to draw it.
struct Parts {
    alignas(64) std::int16_t of[longest_summed_prefix];
    alignas(64) std::int16_t color[3][longest_summed_prefix];
    std::array<std::int16_t, 3> scale{};  // of colours, 8192 = 1
};

auto widened(Vector v) {
    const hn::RepartitionToWide<Lanes> wide;
    return hn::Add(hn::PromoteTo(wide, hn::LowerHalf(v)), hn::PromoteTo(wide, hn::UpperHalf(hn::Half<Lanes>(), v)));
}

// What all points show together, in quarters of areas of one. Their colours are made to send the mean light.
float sum_up(const SplatPerson& person, const SplatLight& light, Parts& parts) {
    const hn::RepartitionToWide<Lanes> wide;
    auto shown_sum = hn::Zero(wide);
    auto red = hn::Zero(wide), green = hn::Zero(wide), blue = hn::Zero(wide);
    for (int chunk = 0; chunk < chunks_of(person); ++chunk) {
        prefetch(person, chunk + 2);
        for (int lane = 0; lane < chunk_points; lane += static_cast<int>(hn::Lanes(lanes))) {
            const int at = chunk * chunk_points + lane;
            const Vector part = shown(person, chunk, lane);
            Vector color[3];
            find_colors(person, light, chunk, lane, color);
            hn::Store(part, lanes, parts.of + at);
            for (int channel = 0; channel < 3; ++channel) hn::Store(color[channel], lanes, parts.color[channel] + at);
            shown_sum = hn::Add(shown_sum, widened(part));
            red = hn::Add(red, widened(times(part, color[0])));
            green = hn::Add(green, widened(times(part, color[1])));
            blue = hn::Add(blue, widened(times(part, color[2])));
        }
    }
    const auto total = [&](auto sum) HWY_ATTR { return static_cast<float>(hn::GetLane(hn::SumOfLanes(wide, sum))); };
    const float sum = total(shown_sum);
    const std::array<float, 3> sent{total(red), total(green), total(blue)};
    for (int channel = 0; channel < 3; ++channel) {
        constexpr float most = 3.9f;
        const float scale = sent[channel] > 0.0f ? person.mean_light[channel] * sum / sent[channel] : 0.0f;
        parts.scale[channel] = static_cast<std::int16_t>(std::min(scale, most) * 8192.0f);
    }
    return sum / 32767.0f;
}

// What a point that shows all of its area covers: `steps` of which one is 2^shift of a cell's.
struct Area {
    std::int16_t steps;
    int shift;
};

Area area_of(const SplatPerson& person, const SplatLight& light, Parts& parts) {
    float each = 4.0f * person.area_each;
    if (person.total > 0.0f) {
        const float sum = sum_up(person, light, parts);
        each = sum > 0.0f ? person.total / sum : 0.0f;
    }
    constexpr float most = 32767.0f;
    float steps = each * cell_full;
    int shift = 0;
    for (; steps > most && shift < 3; ++shift) steps *= 0.5f;
    return {static_cast<std::int16_t>(std::min(steps + 0.5f, most)), shift};
}

struct Place {
    std::int16_t x, y;  // [1/128 cell] the middle of the body, from the middle of the patch's first cell
};

void stage(const SplatPerson& person, const SplatLight& light, const Patch& patch, Place place, Area area,
           const Parts* parts, int chunk, int lane, Staged& out) {
    Vector position[3];
    for (int axis = 0; axis < 3; ++axis) position[axis] = hn::Load(lanes, &person.chunk(chunk).position[axis][lane]);

    const Vector part = parts ? hn::Load(lanes, parts->of + chunk * chunk_points + lane) : shown(person, chunk, lane);
    Vector cover = times(part, all(area.steps));
    for (int i = 0; i < area.shift; ++i) cover = hn::SaturatedAdd(cover, cover);
    const Vector back = dot(position, person.axes[2]);
    // 1 / (1 + t) - 1 = -t + t^2 - t^3 ...: what is farther back is smaller.
    const Vector t = times(back, all(person.nearness));
    const Vector t2 = times(t, t);
    const Vector shrink = hn::Sub(hn::Sub(t2, t), times(t2, t));
    Vector x = dot(position, person.axes[0]), y = dot(position, person.axes[1]);
    x = hn::SaturatedAdd(hn::Add(x, times(x, shrink)), all(place.x));
    y = hn::SaturatedAdd(hn::Add(y, times(y, shrink)), all(place.y));

    const Vector column = hn::ShiftRight<cell_bits>(x), row = hn::ShiftRight<cell_bits>(y);
    const auto within = [](Vector at, int size) {
        return hn::And(hn::Gt(at, all(-1)), hn::Lt(at, all(static_cast<std::int16_t>(size - 1))));
    };
    const auto used =
        hn::And(hn::Gt(cover, hn::Zero(lanes)), hn::And(within(column, patch.width), within(row, patch.height)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(lanes, used, bits);
    std::uint32_t mask = 0;
    for (int i = 0; i < 4; ++i) mask |= std::uint32_t{bits[i]} << (8 * i);
    out.used |= mask << lane;
    if (mask == 0) return;

    Vector shade[3];
    if (parts) {
        for (int channel = 0; channel < 3; ++channel) {
            const Vector color = hn::Load(lanes, parts->color[channel] + chunk * chunk_points + lane);
            const Vector quarter = hn::Min(times(color, all(parts->scale[channel])), all(8191));
            shade[channel] = hn::ShiftLeft<2>(quarter);
        }
    } else {
        find_colors(person, light, chunk, lane, shade);
    }
    for (Vector& channel : shade) channel = times(channel, cover);
    hn::StoreInterleaved4(shade[0], shade[1], shade[2], cover, lanes,
                          reinterpret_cast<std::int16_t*>(out.light_and_area + lane));
    hn::Store(times(back, cover), lanes, out.back + lane);
    hn::Store(column, lanes, out.column + lane);
    hn::Store(row, lanes, out.row + lane);
    const auto within_cell = [](Vector at) HWY_ATTR {
        return hn::ShiftLeft<15 - cell_bits>(hn::And(at, all((1 << cell_bits) - 1)));
    };
    hn::Store(within_cell(x), lanes, out.right + lane);
    hn::Store(within_cell(y), lanes, out.down + lane);
}

// What a cell gets its neighbour doesn't, so that nothing is lost.
void add_row(std::int16_t* cell, hn::Vec<Pixel> row, hn::Vec<Pixel> right) {
    const auto second = hn::MulFixedPoint15(row, right);
    const auto first = hn::Sub(row, second);
#if HWY_MAX_BYTES >= 32
    const hn::FixedTag<std::int16_t, 16> both;
    hn::StoreU(hn::SaturatedAdd(hn::LoadU(both, cell), hn::Combine(both, second, first)), both, cell);
#else
    hn::Store(hn::SaturatedAdd(hn::Load(pixel, cell), first), pixel, cell);
    hn::Store(hn::SaturatedAdd(hn::Load(pixel, cell + 8), second), pixel, cell + 8);
#endif
}

// Shares a point out among its four cells.
void add(const Staged& staged, const Patch& patch, int i) {
    const hn::FixedTag<std::int16_t, 4> half;
    const auto value = hn::Combine(pixel, hn::LoadU(half, staged.back + i),
                                   hn::LoadU(half, reinterpret_cast<const std::int16_t*>(staged.light_and_area + i)));
    const int column = staged.column[i], row = staged.row[i];
    const auto right = hn::Set(pixel, staged.right[i]);
    const auto below = hn::MulFixedPoint15(value, hn::Set(pixel, staged.down[i]));
    std::int16_t* cell = patch.cells + 8 * (row * patch.stride + column);
    add_row(cell, hn::Sub(value, below), right);
    add_row(cell + 8 * patch.stride, below, right);
    const std::uint64_t groups = std::uint64_t{1} << (column / group_cells) | std::uint64_t{1}
                                                                                  << ((column + 1) / group_cells);
    patch.used[row] |= groups;
    patch.used[row + 1] |= groups;
}

void add_spot(const SplatPerson& person, const Patch& patch) {
    constexpr int half = 1 << (cell_bits - 1), within = (1 << cell_bits) - 1;
    const std::int32_t x = person.feet[0] - (patch.x0 << cell_bits) - half;
    const std::int32_t y = person.feet[1] - (patch.y0 << cell_bits) - half;
    const std::int32_t column = x >> cell_bits, row = y >> cell_bits;
    if (column < 0 || row < 0 || column >= patch.width - 1 || row >= patch.height - 1) return;
    Staged spot;
    spot.light_and_area[0] = static_cast<std::uint64_t>(person.spot) << 48;
    spot.column[0] = static_cast<std::int16_t>(column);
    spot.row[0] = static_cast<std::int16_t>(row);
    spot.right[0] = static_cast<std::int16_t>((x & within) << (15 - cell_bits));
    spot.down[0] = static_cast<std::int16_t>((y & within) << (15 - cell_bits));
    std::fill_n(spot.back, 4, std::int16_t{0});
    add(spot, patch, 0);
}

}  // namespace

void Splat(const SplatPerson& person, const SplatLight& light, const Patch& to) {
    const Patch patch = to;  // of its own: what is stored could change it otherwise, for all that is known
    Parts parts;
    const Area area = area_of(person, light, parts);
    if (area.steps == 0) return;
    // From the middle of the patch's first cell, where all of a point would go.
    const auto place_of = [](std::int32_t middle, int first) {
        constexpr int half = 1 << (cell_bits - 1);
        return static_cast<std::int16_t>(std::clamp(middle - (first << cell_bits) - half, -32768, 32767));
    };
    const Place place{place_of(person.middle[0], patch.x0), place_of(person.middle[1], patch.y0)};
    Staged staged;
    for (int chunk = 0; chunk < chunks_of(person); ++chunk) {
        staged.used = 0;
        prefetch(person, chunk + 2);
        for (int lane = 0; lane < chunk_points; lane += static_cast<int>(hn::Lanes(lanes)))
            stage(person, light, patch, place, area, person.total > 0.0f ? &parts : nullptr, chunk, lane, staged);
        for (std::uint32_t left = staged.used; left != 0; left &= left - 1) add(staged, patch, std::countr_zero(left));
    }
    if (person.spot > 0) add_spot(person, patch);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(Splat);

void splat(const SplatPerson& person, const SplatLight& light, const Patch& patch) {
    HWY_DYNAMIC_DISPATCH(Splat)(person, light, patch);
}

}  // namespace render::native

#endif
