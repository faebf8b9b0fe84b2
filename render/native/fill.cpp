#include "render/native/fill.h"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/fill.cpp"
#include <hwy/foreach_target.h>
// What follows is compiled once for every target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(group == block_samples);
using Floats = HWY_CAPPED(float, group);
using Ints = hn::Rebind<std::int32_t, Floats>;
using Words = hn::Rebind<std::uint32_t, Floats>;
using Four = hn::FixedTag<float, 4>;
using VFloat = hn::Vec<Floats>;
using VInt = hn::Vec<Ints>;
using VWords = hn::Vec<Words>;
using FloatMask = hn::Mask<Floats>;

constexpr int lanes = static_cast<int>(hn::MaxLanes(Floats()));
constexpr int parts = block_samples / lanes;  // vectors a block

struct Offsets {
    alignas(64) std::int32_t x[block_samples], y[block_samples];
};
// Where a block's samples are in it.
constexpr Offsets offsets = [] {
    Offsets made{};
    for (int i = 0; i < block_samples; ++i) {
        made.x[i] = sample_x(i);
        made.y[i] = sample_y(i);
    }
    return made;
}();

// What is linear in edges 1 and 2. What is last means nothing.
struct alignas(16) PlainShading {
    float at[4], second[4], third[4];
};

// The first lane's the lowest.
std::uint32_t bits_of(hn::Mask<Ints> mask) {
    std::uint8_t bytes[8] = {};  // as many as may be written
    hn::StoreMaskBits(Ints(), mask, bytes);
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

VFloat between(float at, float to_second, float to_third, VFloat second, VFloat third) {
    const Floats f;
    return hn::Add(hn::Add(hn::Set(f, at), hn::Mul(hn::Set(f, to_second), second)),
                   hn::Mul(hn::Set(f, to_third), third));
}

// In the low half; what the high one has means nothing. Adding what has no bits for fractions rounds, to even.
VWords rounded(VFloat color) {
    const Floats f;
    constexpr float no_fractions = 1 << 23;
    const auto bounded = hn::Min(hn::Max(color, hn::Zero(f)), hn::Set(f, full));
    return hn::BitCast(Words(), hn::Add(bounded, hn::Set(f, no_fractions)));
}

// Whole vectors, not masked stores: what is drawn next is often in the same block, and loads can't be served by a
// masked store that is still on its way.
template <typename D, typename V, typename T>
void blend(V value, hn::Mask<D> mask, D d, T* to) {
    hn::Store(hn::IfThenElse(mask, value, hn::Load(d, to)), d, to);
}

void store(VFloat red, VFloat green, VFloat blue, FloatMask mask, const Block& block, int lane) {
    const Words w;
    const auto wide_mask = hn::RebindMask(w, mask);
    const auto low = hn::Set(w, 0xffffu);
    blend(hn::Or(hn::And(rounded(red), low), hn::ShiftLeft<16>(rounded(green))), wide_mask, w, block.red_green + lane);
    blend(hn::And(rounded(blue), low), wide_mask, w, block.blue + lane);
}

// Keeps of `inside` what is nearer than what is there, and its depth. False: nothing is. `exists`: called only if
// something is nearer; keeps of that what there is.
template <typename Exists>
bool nearer(VFloat depth, FloatMask& inside, const Block& block, int lane, Exists exists) {
    const Floats f;
    const auto there = hn::Load(f, block.depth + lane);
    inside = hn::And(inside, hn::Gt(depth, there));
    if (hn::AllFalse(f, inside)) return false;
    if (!exists(inside)) return false;
    hn::Store(hn::IfThenElse(inside, depth, there), f, block.depth + lane);
    return true;
}

void update_farthest(const Block& block) {
    const Floats f;
    auto least = hn::Load(f, block.depth);
    for (int part = 1; part < parts; ++part) least = hn::Min(least, hn::Load(f, block.depth + part * lanes));
    *block.farthest = hn::GetLane(hn::MinOfLanes(f, least));
}

// `edge1`, `edge2`: at the samples.
void shade(const PlainShading& s, VFloat edge1, VFloat edge2, FloatMask mask, const Block& block, int lane) {
    const auto value = [&](int i) { return between(s.at[i], s.second[i], s.third[i], edge1, edge2); };
    store(value(0), value(1), value(2), mask, block, lane);
}

// One mipmap; null: none.
struct Texels {
    const std::int32_t* data = nullptr;
    int side = 1;  // [texels]
    model::Sampler sampler;
    bool is_usual = true;  // the sampler
};

// Corners that differ in everything, in perspective.
struct RichShading {
    Corner at, to_second, to_third;
    float depth_second, depth_third;
    Texels texels;
    float alpha_cutoff;
    bool emits;
    glm::vec3 emission;  // times `full`, and what its texels show
    Texels emissive_texels;
};

struct Color {
    VFloat red, green, blue;
};

// How far between two texels, in steps of 1 / 256.
constexpr int texel_steps = 256;

// The two texels that a place lies between along one axis, and how far from the first.
struct TexelPair {
    VInt first, second, from_first;
};

// Of a texture that repeats, between its texels.
TexelPair usual_pair(VFloat t, int side) {
    const Floats f;
    const Ints i;
    const auto in_tile = hn::Sub(t, hn::Floor(t));
    const auto place =
        hn::ConvertTo(i, hn::Floor(hn::Add(hn::Mul(in_tile, hn::Set(f, static_cast<float>(texel_steps * side))),
                                           hn::Set(f, 0.5f - texel_steps / 2))));
    const auto wrap = hn::Set(i, side - 1);
    const auto first = hn::And(hn::ShiftRight<8>(place), wrap);
    return {first, hn::And(hn::Add(first, hn::Set(i, 1)), wrap), hn::And(place, hn::Set(i, texel_steps - 1))};
}

// Of any other (model/texture_sample.h).
TexelPair unusual_pair(VFloat t, int side, model::Wrap wrap, bool nearest) {
    const Floats f;
    const Ints i;
    if (!nearest && wrap == model::Wrap::repeat) return usual_pair(t, side);
    const auto one = hn::Set(f, 1.0f), two = hn::Set(f, 2.0f);
    if (wrap == model::Wrap::repeat) {
        t = hn::Sub(t, hn::Floor(t));
    } else if (wrap == model::Wrap::mirror) {
        t = hn::Sub(t, hn::Mul(two, hn::Floor(hn::Mul(t, hn::Set(f, 0.5f)))));
        t = hn::Min(t, hn::Sub(two, t));
    } else {
        t = hn::Min(hn::Max(t, hn::Zero(f)), one);
    }
    const auto within = [&](VInt texel) { return hn::Min(hn::Max(texel, hn::Zero(i)), hn::Set(i, side - 1)); };
    if (nearest) {
        const auto texel = within(hn::ConvertTo(i, hn::Floor(hn::Mul(t, hn::Set(f, static_cast<float>(side))))));
        return {texel, texel, hn::Zero(i)};
    }
    const auto place =
        hn::ConvertTo(i, hn::Floor(hn::Add(hn::Mul(t, hn::Set(f, static_cast<float>(texel_steps * side))),
                                           hn::Set(f, 0.5f - texel_steps / 2))));
    const auto first = hn::ShiftRight<8>(place);
    return {within(first), within(hn::Add(first, hn::Set(i, 1))), hn::And(place, hn::Set(i, texel_steps - 1))};
}

// The four texels around a place, and how much of each is shown there, `texel_steps` squared together.
struct FourTexels {
    VInt a, b, c, d, left, right, upper, lower;

    // Of a byte of theirs.
    template <typename Byte>
    VFloat mean(Byte byte) const {
        const auto above = hn::Add(hn::Mul(byte(a), left), hn::Mul(byte(b), right));
        const auto below = hn::Add(hn::Mul(byte(c), left), hn::Mul(byte(d), right));
        const auto sum = hn::Add(hn::Mul(above, upper), hn::Mul(below, lower));
        const Floats f;
        return hn::Mul(hn::ConvertTo(f, sum), hn::Set(f, 1.0f / (255.0f * texel_steps * texel_steps)));
    }
};

FourTexels four_texels(const Texels& texels, VFloat u, VFloat v) {
    const Ints i;
    const model::Sampler& by = texels.sampler;
    const TexelPair x =
        texels.is_usual ? usual_pair(u, texels.side) : unusual_pair(u, texels.side, by.across, by.nearest);
    const TexelPair y =
        texels.is_usual ? usual_pair(v, texels.side) : unusual_pair(v, texels.side, by.down, by.nearest);
    const auto side = hn::Set(i, texels.side), steps = hn::Set(i, texel_steps);
    const auto row0 = hn::Mul(y.first, side), row1 = hn::Mul(y.second, side);
    return {hn::GatherIndex(i, texels.data, hn::Add(row0, x.first)),
            hn::GatherIndex(i, texels.data, hn::Add(row0, x.second)),
            hn::GatherIndex(i, texels.data, hn::Add(row1, x.first)),
            hn::GatherIndex(i, texels.data, hn::Add(row1, x.second)),
            hn::Sub(steps, x.from_first),
            x.from_first,
            hn::Sub(steps, y.from_first),
            y.from_first};
}

// Bilinear, in the texels' own coding, then made linear.
Color texel(const Texels& texels, VFloat u, VFloat v) {
    const Ints i;
    const FourTexels four = four_texels(texels, u, v);
    const auto low = hn::Set(i, 255);
    const auto channel = [&](auto byte) {
        const auto srgb = four.mean(byte);
        return hn::Mul(srgb, srgb);
    };
    return {channel([&](VInt t) { return hn::And(t, low); }),
            channel([&](VInt t) { return hn::And(hn::ShiftRight<8>(t), low); }),
            channel([&](VInt t) { return hn::And(hn::ShiftRight<16>(t), low); })};
}

// Of screen shares, what perspective makes of them.
void put_in_perspective(const RichShading& s, VFloat& second, VFloat& third) {
    const Floats f;
    const auto depth = between(s.at.depth, s.to_second.depth, s.to_third.depth, second, third);
    second = hn::Div(hn::Mul(second, hn::Set(f, s.depth_second)), depth);
    third = hn::Div(hn::Mul(third, hn::Set(f, s.depth_third)), depth);
}

// Keeps of `mask` where a cutout leaves a surface. False: nowhere.
bool keep_surface(const RichShading& s, VFloat second, VFloat third, FloatMask& mask) {
    const Floats f;
    second = hn::IfThenElseZero(mask, second);
    third = hn::IfThenElseZero(mask, third);
    put_in_perspective(s, second, third);
    auto alpha = between(s.at.alpha, s.to_second.alpha, s.to_third.alpha, second, third);
    if (s.texels.data != nullptr) {
        const FourTexels four = four_texels(s.texels, between(s.at.u, s.to_second.u, s.to_third.u, second, third),
                                            between(s.at.v, s.to_second.v, s.to_third.v, second, third));
        alpha = hn::Mul(alpha, four.mean([](VInt t) { return hn::And(hn::ShiftRight<24>(t), hn::Set(Ints(), 255)); }));
    }
    constexpr float rounding = 1e-5f;  // of sums of bytes
    mask = hn::And(mask, hn::Ge(alpha, hn::Set(f, s.alpha_cutoff - rounding)));
    return !hn::AllFalse(f, mask);
}

// Few surfaces need it. `second`, `third`: in perspective.
HWY_NOINLINE void add_emission(const RichShading& s, VFloat second, VFloat third, Color& shown) {
    const Floats f;
    Color own{hn::Set(f, s.emission.r), hn::Set(f, s.emission.g), hn::Set(f, s.emission.b)};
    if (s.emissive_texels.data != nullptr) {
        const Color texture = texel(s.emissive_texels, between(s.at.u, s.to_second.u, s.to_third.u, second, third),
                                    between(s.at.v, s.to_second.v, s.to_third.v, second, third));
        own = {hn::Mul(own.red, texture.red), hn::Mul(own.green, texture.green), hn::Mul(own.blue, texture.blue)};
    }
    shown = {hn::Add(shown.red, own.red), hn::Add(shown.green, own.green), hn::Add(shown.blue, own.blue)};
}

// `second`, `third`: how much of those corners each sample is.
void shade(const RichShading& s, VFloat second, VFloat third, FloatMask mask, const Block& block, int lane) {
    // Outside of the triangle nothing is promised of the numbers below.
    second = hn::IfThenElseZero(mask, second);
    third = hn::IfThenElseZero(mask, third);
    put_in_perspective(s, second, third);
    const auto color = [&](int c) {
        const auto light = between(s.at.light[c], s.to_second.light[c], s.to_third.light[c], second, third);
        const auto albedo = between(s.at.albedo[c], s.to_second.albedo[c], s.to_third.albedo[c], second, third);
        return hn::Mul(light, albedo);
    };
    Color shown{color(0), color(1), color(2)};
    if (s.texels.data != nullptr) {
        const Color texture = texel(s.texels, between(s.at.u, s.to_second.u, s.to_third.u, second, third),
                                    between(s.at.v, s.to_second.v, s.to_third.v, second, third));
        shown = {hn::Mul(shown.red, texture.red), hn::Mul(shown.green, texture.green),
                 hn::Mul(shown.blue, texture.blue)};
    }
    if (s.emits) add_emission(s, second, third, shown);
    store(shown.red, shown.green, shown.blue, mask, block, lane);
}

Corner difference(const Corner& a, const Corner& b) {
    Corner d;
    for (int c = 0; c < 3; ++c) {
        d.light[c] = a.light[c] - b.light[c];
        d.albedo[c] = a.albedo[c] - b.albedo[c];
    }
    d.depth = a.depth - b.depth;
    d.u = a.u - b.u;
    d.v = a.v - b.v;
    d.alpha = a.alpha - b.alpha;
    return d;
}

// How a triangle's two later corners come and go along the screen [1 / sample].
struct Slopes {
    float second_x, second_y, third_x, third_y;
};

// The mipmap whose texels are nearest to samples in size, in the triangle's middle.
int mipmap(const TextureLayers& textures, const Corner (&corners)[3], const Slopes& slopes) {
    const float first_x = -slopes.second_x - slopes.third_x, first_y = -slopes.second_y - slopes.third_y;
    const auto [a, b, c] = corners;
    const float depth = a.depth + b.depth + c.depth;
    const auto slope = [&](float t0, float t1, float t2, float s0, float s1, float s2) {
        const float mean = (t0 * a.depth + t1 * b.depth + t2 * c.depth) / depth;
        return 3 * (s0 * a.depth * (t0 - mean) + s1 * b.depth * (t1 - mean) + s2 * c.depth * (t2 - mean)) / depth;
    };
    const float u_x = slope(a.u, b.u, c.u, first_x, slopes.second_x, slopes.third_x);
    const float v_x = slope(a.v, b.v, c.v, first_x, slopes.second_x, slopes.third_x);
    const float u_y = slope(a.u, b.u, c.u, first_y, slopes.second_y, slopes.third_y);
    const float v_y = slope(a.v, b.v, c.v, first_y, slopes.second_y, slopes.third_y);
    const auto side = static_cast<float>(textures.side(0));
    const float squared = std::max(u_x * u_x + v_x * v_x, u_y * u_y + v_y * v_y) * side * side;
    if (!(squared > 1)) return 0;
    const int most = textures.levels() - 1;
    return squared < 1e12f ? std::min(std::ilogb(2 * squared) / 2, most) : most;
}

RichShading rich_shading(const TextureLayers& textures, const Corner (&corners)[3], const Texturing& texturing,
                         const Slopes& slopes) {
    RichShading shading{corners[0],
                        difference(corners[1], corners[0]),
                        difference(corners[2], corners[0]),
                        corners[1].depth,
                        corners[2].depth,
                        {},
                        texturing.alpha_cutoff,
                        texturing.emission != glm::vec3(0),
                        full * texturing.emission,
                        {}};
    if (texturing.layer == untextured && texturing.emissive_layer == untextured) return shading;
    const int level = mipmap(textures, corners, slopes);
    const auto texels = [&](std::uint8_t layer) -> Texels {
        if (layer == untextured) return {};
        return {reinterpret_cast<const std::int32_t*>(textures.texels(layer, level)), textures.side(level),
                texturing.sampler, texturing.sampler == model::Sampler{}};
    };
    shading.texels = texels(texturing.layer);
    shading.emissive_texels = texels(texturing.emissive_layer);
    return shading;
}

// ---- people of no more than reach_on_grid: 32-bit edges, a group of triangles set up at a time ----

// Blocks are looked at sixteen at a time, in a square; row by row.
constexpr int square_side = sample_block_side;
constexpr int square_blocks = square_side * square_side;

// Columns and rows, in turns.
struct Offsets16 {
    alignas(64) std::int16_t xy[block_samples][2];
};
// Where samples are, from a square's first one: of each of its blocks, and the first of all of them.
struct SquareOffsets {
    Offsets16 samples[square_blocks], blocks;
};
constexpr SquareOffsets square_offsets = [] {
    SquareOffsets made{};
    for (int b = 0; b < square_blocks; ++b) {
        const int x = sample_block_side * (b % square_side), y = sample_block_side * (b / square_side);
        made.blocks.xy[b][0] = static_cast<std::int16_t>(x);
        made.blocks.xy[b][1] = static_cast<std::int16_t>(y);
        for (int i = 0; i < block_samples; ++i) {
            made.samples[b].xy[i][0] = static_cast<std::int16_t>(x + sample_x(i));
            made.samples[b].xy[i][1] = static_cast<std::int16_t>(y + sample_y(i));
        }
    }
    return made;
}();

// Which blocks of a square lie in its first n columns, and rows; a bit each.
struct Within {
    std::uint32_t columns[square_side + 1], rows[square_side + 1];
};
constexpr Within within = [] {
    Within made{};
    for (int n = 0; n <= square_side; ++n) {
        for (int b = 0; b < square_blocks; ++b) {
            made.columns[n] |= std::uint32_t{b % square_side < n} << b;
            made.rows[n] |= std::uint32_t{b / square_side < n} << b;
        }
    }
    return made;
}();

// Edge k lies opposite of corner k; inside all three are >= 0. In steps of a sample, rounded down.
struct alignas(64) EdgeGroup {
    std::int32_t slope[3][group];  // more a sample to the right in the low half, below in the high one: both fit
    std::int32_t start[3][group];  // at the first sample of the first block
    std::int32_t most[3][group];   // that it gains within a block
    // How much of corner k = 1, 2 a sample is: scale * edge + rest[k - 1].
    float scale[group], rest[2][group];
    float nearest[group];                                         // that any sample may be
    float depth[group], depth_second[group], depth_third[group];  // depth + edge 1 * second + edge 2 * third
    std::int32_t first_column[group], end_column[group], first_row[group], end_row[group];  // blocks from the person's

    int along(int k, int t) const { return static_cast<std::int16_t>(slope[k][t]); }
    int down(int k, int t) const { return slope[k][t] >> 16; }
};
static_assert(reach_on_grid <= INT16_MAX);

struct Blocks {
    int first_column, end_column, first_row, end_row;
};

// Blocks whose samples a span on the grid may hold, cut to [first, end).
void block_range(VInt least, VInt most, int first, int end, VInt& from, VInt& to) {
    const Ints i;
    const auto first_sample = hn::ShiftRight<4>(hn::Add(least, hn::Set(i, grid_per_sample / 2 - 1)));
    const auto last_sample = hn::ShiftRight<4>(hn::Sub(most, hn::Set(i, grid_per_sample / 2)));
    from = hn::Max(hn::ShiftRight<2>(first_sample), hn::Set(i, first));
    to = hn::Min(hn::Add(hn::ShiftRight<2>(last_sample), hn::Set(i, 1)), hn::Set(i, end));
}
static_assert(grid_per_sample == 16 && sample_block_side == 4);

// Those lanes of `out` that have any block; a bit each.
std::uint32_t set_up_edges(const FacingTriangle* facing, const Blocks& tile, EdgeGroup& out) {
    const Floats f;
    const Ints i;
    const Words w;
    std::uint32_t alive = 0;
    for (int lane = 0; lane < group; lane += lanes) {
        VInt x[3], y[3];  // of corners
        VWords corners[3], faces;
        hn::LoadInterleaved4(w, facing[lane].corners, corners[0], corners[1], corners[2], faces);
        for (int k = 0; k < 3; ++k) {
            const auto packed = hn::BitCast(i, corners[k]);
            x[k] = hn::ShiftRight<16>(hn::ShiftLeft<16>(packed));
            y[k] = hn::ShiftRight<16>(packed);
        }
        VInt column, end_column, row, end_row;
        block_range(hn::Min(x[0], hn::Min(x[1], x[2])), hn::Max(x[0], hn::Max(x[1], x[2])), tile.first_column,
                    tile.end_column, column, end_column);
        block_range(hn::Min(y[0], hn::Min(y[1], y[2])), hn::Max(y[0], hn::Max(y[1], y[2])), tile.first_row,
                    tile.end_row, row, end_row);
        const auto some = hn::And(hn::Gt(end_column, column), hn::Gt(end_row, row));
        const std::uint32_t mask = bits_of(some);
        alive |= mask << lane;
        if (mask == 0) continue;
        hn::Store(column, i, out.first_column + lane);
        hn::Store(end_column, i, out.end_column + lane);
        hn::Store(row, i, out.first_row + lane);
        hn::Store(end_row, i, out.end_row + lane);

        // Of the first sample of the first block.
        const auto sample_x = hn::Add(hn::ShiftLeft<6>(column), hn::Set(i, grid_per_sample / 2));
        const auto sample_y = hn::Add(hn::ShiftLeft<6>(row), hn::Set(i, grid_per_sample / 2));
        const auto zero = hn::Zero(i);
        const auto area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                                  hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
        const auto over_area = hn::Div(hn::Set(f, 1.0f), hn::ConvertTo(f, area));
        hn::Store(hn::Mul(over_area, hn::Set(f, float{grid_per_sample})), f, out.scale + lane);
        for (int k = 0; k < 3; ++k) {
            const int from = (k + 1) % 3, to = (k + 2) % 3;
            const auto along = hn::Sub(y[from], y[to]);
            const auto down = hn::Sub(x[to], x[from]);
            const auto exact =
                hn::Add(hn::Mul(along, hn::Sub(sample_x, x[from])), hn::Mul(down, hn::Sub(sample_y, y[from])));
            const auto owns = hn::Or(hn::Gt(along, zero), hn::And(hn::Eq(along, zero), hn::Gt(down, zero)));
            const auto owned = hn::Sub(exact, hn::IfThenZeroElse(owns, hn::Set(i, 1)));
            const auto floor = hn::ShiftRight<4>(owned);
            const auto slope = hn::Or(hn::And(along, hn::Set(i, 0xffff)), hn::ShiftLeft<16>(down));
            const auto gained = hn::Add(hn::Max(along, zero), hn::Max(down, zero));
            hn::Store(slope, i, out.slope[k] + lane);
            hn::Store(floor, i, out.start[k] + lane);
            hn::Store(hn::Add(gained, hn::Add(gained, gained)), i, out.most[k] + lane);
            if (k == 0) continue;
            const auto rest = hn::ConvertTo(f, hn::Sub(exact, hn::ShiftLeft<4>(floor)));
            hn::Store(hn::Mul(rest, over_area), f, out.rest[k - 1] + lane);
        }
    }
    return alive;
}
static_assert(sample_block_side - 1 == 3);

// The corners of a triangle on the screen.
struct FacingCorners {
    std::uint32_t numbers[3], paints[3];
    std::uint32_t lit_at;  // so much farther on are the lit vertices of the side that is seen
    const Face* face;
};

FacingCorners corners_of(const PersonMesh& mesh, std::uint32_t number) {
    const Face& face = mesh.faces[number & ~from_behind];
    const std::uint32_t turned = number / from_behind, second = 1 + turned, third = 2 - turned;
    return {{face.corners[0], face.corners[second], face.corners[third]},
            {face.paints[0], face.paints[second], face.paints[third]},
            turned * mesh.behind(),
            &face};
}

// Of those of set_up_edges() that are alive. Returns which of them are so flat that their perspective doesn't show: in
// a colour as stored, a square root, it is less than one of 255 steps.
std::uint32_t set_up_depths(const PersonMesh& mesh, const FacingTriangle* facing, std::uint32_t alive,
                            const LitVertex* vertices, EdgeGroup& out) {
    const Floats f;
    constexpr float flat_enough = 0.98f;  // of depths, nearest by farthest
    std::uint32_t flat = 0;
    alignas(64) float corner[3][group] = {};
    for (std::uint32_t left = alive; left != 0; left &= left - 1) {
        const int t = std::countr_zero(left);
        const FacingCorners corners = corners_of(mesh, facing[t].face);
        for (int k = 0; k < 3; ++k) corner[k][t] = vertices[corners.numbers[k]].depth;
    }
    for (int lane = 0; lane < group; lane += lanes) {
        const auto at = hn::Load(f, corner[0] + lane);
        const auto at_second = hn::Load(f, corner[1] + lane), at_third = hn::Load(f, corner[2] + lane);
        const auto second = hn::Sub(at_second, at), third = hn::Sub(at_third, at);
        const auto scale = hn::Load(f, out.scale + lane);
        constexpr float rounding = 1.0f + 1e-6f;
        const auto nearest = hn::Max(at, hn::Max(at_second, at_third));
        const auto farthest = hn::Min(at, hn::Min(at_second, at_third));
        const auto is_flat = hn::Ge(farthest, hn::Mul(nearest, hn::Set(f, flat_enough)));
        flat |= bits_of(hn::RebindMask(Ints(), is_flat)) << lane;
        hn::Store(hn::Mul(nearest, hn::Set(f, rounding)), f, out.nearest + lane);
        hn::Store(hn::Add(hn::Add(at, hn::Mul(second, hn::Load(f, out.rest[0] + lane))),
                          hn::Mul(third, hn::Load(f, out.rest[1] + lane))),
                  f, out.depth + lane);
        hn::Store(hn::Mul(second, scale), f, out.depth_second + lane);
        hn::Store(hn::Mul(third, scale), f, out.depth_third + lane);
    }
    return flat;
}

// What a person is drawn with.
struct Dress {
    const PersonMesh& mesh;
    const LitVertex* vertices;
    const Tint* tints;
};

using FourFloats = hn::Vec<Four>;

// Of numbers at the corners.
PlainShading by_edges(FourFloats at, FourFloats at_second, FourFloats at_third, const EdgeGroup& edges, int t) {
    const Four f;
    PlainShading shading;
    const auto second = hn::Sub(at_second, at), third = hn::Sub(at_third, at);
    const auto rest =
        hn::Add(hn::Mul(second, hn::Set(f, edges.rest[0][t])), hn::Mul(third, hn::Set(f, edges.rest[1][t])));
    const auto scale = hn::Set(f, edges.scale[t]);
    hn::Store(hn::Add(at, rest), f, shading.at);
    hn::Store(hn::Mul(second, scale), f, shading.second);
    hn::Store(hn::Mul(third, scale), f, shading.third);
    return shading;
}

// How a triangle is coloured; found out when the first of its samples is seen.
struct Shading {
    enum class Kind { unknown, plain, product, rich } kind = Kind::unknown;
    PlainShading plain;   // of the colour, or of the light
    PlainShading albedo;  // of a product
    RichShading rich;
};

// Without texture and perspective. Where light and albedo both change so much that their product isn't linear enough
// (a sample could be off by one of 255 steps as stored, that is of a square root) they are multiplied at samples.
void find_flat_shading(const Dress& dress, const FacingCorners& corners, const EdgeGroup& edges, int t,
                       Shading& shading) {
    const Four f;
    static_assert(sizeof(Tint) == sizeof(LitVertex));
    const auto albedo = [&](int k) { return hn::Load(f, &dress.tints[corners.paints[k]].red); };
    const auto light = [&](int k) { return hn::Load(f, dress.vertices[corners.lit_at + corners.numbers[k]].light); };
    if (!corners.face->plain) {
        const auto most = [&](auto of) { return hn::Max(of(0), hn::Max(of(1), of(2))); };
        const auto least = [&](auto of) { return hn::Min(of(0), hn::Min(of(1), of(2))); };
        const auto least_light = least(light), least_albedo = least(albedo);
        // A product is off by a quarter of this at most.
        const auto bend = hn::Mul(hn::Sub(most(light), least_light), hn::Sub(most(albedo), least_albedo));
        const auto darkest = hn::Mul(least_light, least_albedo);
        constexpr float step = 8.0f / 255;
        const auto limit = hn::Mul(darkest, hn::Set(f, step * step * full));
        const auto colors = hn::FirstN(f, 3);
        if (!hn::AllFalse(f, hn::And(colors, hn::Gt(hn::Mul(bend, bend), limit)))) {
            shading.plain = by_edges(light(0), light(1), light(2), edges, t);
            shading.albedo = by_edges(albedo(0), albedo(1), albedo(2), edges, t);
            shading.kind = Shading::Kind::product;
            return;
        }
    }
    const auto color = [&](int k) { return hn::Mul(light(k), albedo(k)); };
    shading.plain = by_edges(color(0), color(1), color(2), edges, t);
    shading.kind = Shading::Kind::plain;
}

RichShading rich_shading(const Dress& dress, const FacingCorners& corners, const Slopes& slopes) {
    Corner all[3];
    for (int k = 0; k < 3; ++k) {
        const LitVertex& vertex = dress.vertices[corners.lit_at + corners.numbers[k]];
        const Tint& tint = dress.tints[corners.paints[k]];
        const glm::vec2 uv = dress.mesh.uvs.empty() ? glm::vec2(0) : dress.mesh.uvs[corners.numbers[k]];
        all[k] = {{vertex.light[0], vertex.light[1], vertex.light[2]},
                  vertex.depth,
                  {tint.red, tint.green, tint.blue},
                  uv.x,
                  uv.y,
                  dress.mesh.alphas.empty() ? 1.0f : dress.mesh.alphas[corners.numbers[k]]};
    }
    return rich_shading(dress.mesh.textures, all, dress.mesh.texturings[corners.face->texturing], slopes);
}

HWY_NOINLINE void find_shading(const Dress& dress, std::uint32_t number, bool is_flat, const EdgeGroup& edges, int t,
                               Shading& shading) {
    const FacingCorners corners = corners_of(dress.mesh, number);
    if (corners.face->texturing == 0 && is_flat) {
        find_flat_shading(dress, corners, edges, t, shading);
        return;
    }
    const auto slope = [&](int steps) { return static_cast<float>(steps) * edges.scale[t]; };
    const Slopes slopes{slope(edges.along(1, t)), slope(edges.down(1, t)), slope(edges.along(2, t)),
                        slope(edges.down(2, t))};
    shading.rich = rich_shading(dress, corners, slopes);
    shading.kind = Shading::Kind::rich;
}

bool is_cut(const PersonMesh& mesh, std::uint32_t number) {
    return mesh.texturings[mesh.faces[number & ~from_behind].texturing].alpha_cutoff > 0;
}

// How much of corner k = 1, 2 samples are.
VFloat share_of(int k, VFloat edge, const EdgeGroup& edges, int t) {
    const Floats f;
    return hn::Add(hn::Mul(edge, hn::Set(f, edges.scale[t])), hn::Set(f, edges.rest[k - 1][t]));
}

// Of a triangle with cutouts, whose shading is rich. `edge1`, `edge2`: at the samples.
bool keep_surface(const Shading& shading, const EdgeGroup& edges, int t, VFloat edge1, VFloat edge2, FloatMask& mask) {
    return keep_surface(shading.rich, share_of(1, edge1, edges, t), share_of(2, edge2, edges, t), mask);
}

// `edge1`, `edge2`: at the samples.
void shade(const Shading& shading, const EdgeGroup& edges, int t, VFloat edge1, VFloat edge2, FloatMask mask,
           const Block& block, int lane) {
    if (shading.kind == Shading::Kind::plain) {
        shade(shading.plain, edge1, edge2, mask, block, lane);
    } else if (shading.kind == Shading::Kind::product) {
        const auto value = [&](const PlainShading& s, int i) {
            return between(s.at[i], s.second[i], s.third[i], edge1, edge2);
        };
        const auto color = [&](int i) { return hn::Mul(value(shading.plain, i), value(shading.albedo, i)); };
        store(color(0), color(1), color(2), mask, block, lane);
    } else {
        shade(shading.rich, share_of(1, edge1, edges, t), share_of(2, edge2, edges, t), mask, block, lane);
    }
}

// Edge k at samples `at` of a square. `start`: at its first.
VInt edge_at(std::int32_t slope, std::int32_t start, const Offsets16& at, int lane) {
    const Ints i;
    const hn::Repartition<std::int16_t, Ints> shorts;
    auto rest = hn::Zero(i);
    const auto part = hn::ReorderWidenMulAccumulate(i, hn::BitCast(shorts, hn::Set(i, slope)),
                                                    hn::Load(shorts, at.xy[lane]), hn::Zero(i), rest);
    return hn::Add(hn::RearrangeToOddPlusEven(part, rest), hn::Set(i, start));
}

// The blocks of a square that a triangle may touch, a bit each.
std::uint32_t touched_blocks(const EdgeGroup& edges, int t, const std::int32_t (&start)[3]) {
    const Ints i;
    std::uint32_t touched = 0;
    for (int lane = 0; lane < group; lane += lanes) {
        auto outside = hn::Zero(i);
        for (int k = 0; k < 3; ++k) {
            const std::int32_t most = start[k] + edges.most[k][t];
            outside = hn::Or(outside, edge_at(edges.slope[k][t], most, square_offsets.blocks, lane));
        }
        touched |= bits_of(hn::Gt(outside, hn::Set(i, -1))) << lane;
    }
    return touched;
}

// So many rows of a square as fit.
template <typename D>
hn::Vec<D> load_rows(D d, const float* first) {
    constexpr int rows = static_cast<int>(hn::MaxLanes(D())) / square_side;
    if constexpr (rows == 1) {
        return hn::LoadU(d, first);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, load_rows(half, first + NearLayer::farthest_stride * (rows / 2)), load_rows(half, first));
    }
}

// The blocks of a square in which anything is farther than `nearest`, a bit each. `farthest`: of its first block, in
// rows of NearLayer::farthest_stride.
std::uint32_t open_blocks(const float* farthest, float nearest) {
    const Floats f;
    std::uint32_t open = 0;
    for (int lane = 0; lane < group; lane += lanes) {
        const auto there = load_rows(f, farthest + NearLayer::farthest_stride * (lane / square_side));
        open |= bits_of(hn::RebindMask(Ints(), hn::Gt(hn::Set(f, nearest), there))) << lane;
    }
    return open;
}

// Block `b` of a square; `start`: the edges at the square's first sample. `find` fills `shading` in.
template <typename Find>
void fill_block(const EdgeGroup& edges, int t, const std::int32_t (&start)[3], int b, const Block& block, bool is_cut,
                Shading& shading, Find find) {
    const Floats f;
    const Ints i;
    bool changed = false;
    for (int lane = 0; lane < group; lane += lanes) {
        const auto edge = [&](int k) { return edge_at(edges.slope[k][t], start[k], square_offsets.samples[b], lane); };
        const auto edge1 = edge(1), edge2 = edge(2);
        FloatMask mask = hn::RebindMask(f, hn::Gt(hn::Or(hn::Or(edge(0), edge1), edge2), hn::Set(i, -1)));
        const auto exact1 = hn::ConvertTo(f, edge1), exact2 = hn::ConvertTo(f, edge2);
        const auto depth = between(edges.depth[t], edges.depth_second[t], edges.depth_third[t], exact1, exact2);
        const auto exists = [&](FloatMask& there) {
            if (!is_cut) return true;
            if (shading.kind == Shading::Kind::unknown) find();
            return keep_surface(shading, edges, t, exact1, exact2, there);
        };
        if (!nearer(depth, mask, block, lane, exists)) continue;
        changed = true;
        if (shading.kind == Shading::Kind::unknown) find();
        shade(shading, edges, t, exact1, exact2, mask, block, lane);
    }
    if (changed) update_farthest(block);
}

// Triangle `t` of a group. `column`, `row`: of its first block in the layer.
struct Filling {
    const Dress& dress;
    const EdgeGroup& edges;
    int t;
    std::uint32_t face;
    int column, row;
    bool is_flat, is_cut;
};

// Blocks `some` of the square that begins x to the right and y below of the first; `start`: the edges there.
void fill_blocks(const Filling& by, int x, int y, const std::int32_t (&start)[3], std::uint32_t some, Shading& shading,
                 NearLayer& layer) {
    for (; some != 0; some &= some - 1) {
        const int b = std::countr_zero(some);
        fill_block(by.edges, by.t, start, b, layer.block(by.column + x + b % square_side, by.row + y + b / square_side),
                   by.is_cut, shading, [&] { find_shading(by.dress, by.face, by.is_flat, by.edges, by.t, shading); });
    }
}

// Of more blocks than a square has.
HWY_NOINLINE void fill_large(const Filling& by, int columns, int rows, NearLayer& layer) {
    const EdgeGroup& edges = by.edges;
    const int t = by.t;
    Shading shading;
    for (int y = 0; y < rows; y += square_side) {
        for (int x = 0; x < columns; x += square_side) {
            const std::uint32_t open = within.columns[std::min(columns - x, square_side)] &
                                       within.rows[std::min(rows - y, square_side)] &
                                       open_blocks(layer.farthest(by.column + x, by.row + y), edges.nearest[t]);
            if (open == 0) continue;
            std::int32_t start[3];
            for (int k = 0; k < 3; ++k)
                start[k] = edges.start[k][t] + sample_block_side * (x * edges.along(k, t) + y * edges.down(k, t));
            fill_blocks(by, x, y, start, open & touched_blocks(edges, t, start), shading, layer);
        }
    }
}

HWY_NOINLINE void fill_small(const Filling& by, const std::int32_t (&start)[3], std::uint32_t some, NearLayer& layer) {
    Shading shading;
    fill_blocks(by, 0, 0, start, some, shading, layer);
}

void fill_triangle(const Filling& by, NearLayer& layer) {
    const EdgeGroup& edges = by.edges;
    const int t = by.t;
    const int columns = edges.end_column[t] - edges.first_column[t], rows = edges.end_row[t] - edges.first_row[t];
    if (columns > square_side || rows > square_side) return fill_large(by, columns, rows, layer);
    const std::uint32_t open =
        within.columns[columns] & within.rows[rows] & open_blocks(layer.farthest(by.column, by.row), edges.nearest[t]);
    if (open == 0) return;
    const std::int32_t start[3] = {edges.start[0][t], edges.start[1][t], edges.start[2][t]};
    const std::uint32_t some = open & touched_blocks(edges, t, start);
    if (some != 0) fill_small(by, start, some, layer);
}

// The least rectangle with all of these blocks of the layer in which anything is farther than `nearest`.
Blocks seen_blocks(const NearLayer& layer, const Blocks& among, float nearest) {
    const Floats f;
    std::uint64_t columns = 0;
    int first_row = among.end_row, end_row = among.first_row;
    const int count = among.end_column - among.first_column;
    const std::uint64_t all = count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
    for (int row = among.first_row; row < among.end_row; ++row) {
        const float* farthest = layer.farthest(among.first_column, row);
        std::uint64_t open = 0;
        for (int x = 0; x < count; x += lanes) {
            const auto is_open = hn::Gt(hn::Set(f, nearest), hn::LoadU(f, farthest + x));
            open |= std::uint64_t{bits_of(hn::RebindMask(Ints(), is_open))} << x;
        }
        open &= all;
        if (open == 0) continue;
        columns |= open;
        first_row = std::min(first_row, row);
        end_row = row + 1;
    }
    if (columns == 0) return {};
    return {among.first_column + std::countr_zero(columns), among.first_column + 64 - std::countl_zero(columns),
            first_row, end_row};
}

Blocks blocks_of(const Rect& pixels, const NearLayer& layer) {
    const auto first = [](int at, int from) { return std::max(at / sample_block_pixels - from, 0); };
    const auto end = [](int at, int from, int to) {
        return std::min((at + sample_block_pixels - 1) / sample_block_pixels, to) - from;
    };
    const Rect tile = layer.blocks();
    return {first(pixels.x0, tile.x0), end(pixels.x1, tile.x0, tile.x1), first(pixels.y0, tile.y0),
            end(pixels.y1, tile.y0, tile.y1)};
}

void fill_person(const PersonMesh& mesh, const PersonOnGrid& person, NearLayer& layer) {
    const Blocks all = blocks_of(person.pixels, layer);
    if (all.first_column >= all.end_column || all.first_row >= all.end_row) return;
    constexpr float rounding = 1.0f + 1e-6f;
    const Blocks seen = seen_blocks(layer, all, person.nearest * rounding);
    if (seen.first_column >= seen.end_column) return;
    const int origin_column = person.origin_x / sample_block_side - layer.blocks().x0;
    const int origin_row = person.origin_y / sample_block_side - layer.blocks().y0;
    const Blocks within_person{seen.first_column - origin_column, seen.end_column - origin_column,
                               seen.first_row - origin_row, seen.end_row - origin_row};
    const Dress dress{mesh, person.vertices, person.tints};
    const bool has_cutouts = !mesh.alphas.empty();
    EdgeGroup edges;
    for (std::size_t first = 0; first < person.facing.size(); first += group) {
        const FacingTriangle* facing = person.facing.data() + first;
        std::uint32_t alive = set_up_edges(facing, within_person, edges);
        if (person.facing.size() - first < group) alive &= (1u << (person.facing.size() - first)) - 1;
        if (alive == 0) continue;
        const std::uint32_t flat = set_up_depths(mesh, facing, alive, person.vertices, edges);
        for (; alive != 0; alive &= alive - 1) {
            const int t = std::countr_zero(alive);
            fill_triangle(
                {dress, edges, t, facing[t].face, origin_column + edges.first_column[t],
                 origin_row + edges.first_row[t], (flat >> t & 1) != 0, has_cutouts && is_cut(mesh, facing[t].face)},
                layer);
        }
    }
}

// ---- triangles of any size: 64-bit edges, one at a time ----

struct WideEdge {
    std::int64_t along, down,
        at_corner;  // [grid steps squared]; a grid step more to the right, below; at the picture's
    bool owns;

    std::int64_t at(std::int64_t x, std::int64_t y) const { return along * x + down * y + at_corner; }
};

WideEdge edge_between(const WideTriangle& t, int from, int to) {
    const std::int64_t along = std::int64_t{t.y[from]} - t.y[to], down = std::int64_t{t.x[to]} - t.x[from];
    return {along, down, -(along * t.x[from] + down * t.y[from]), along > 0 || (along == 0 && down > 0)};
}

// What an edge gains within a block, at most.
constexpr std::int64_t most_gained = 2 * std::int64_t{sample_block_side} * grid_per_sample * 2 * wide_reach;
constexpr std::int64_t edge_limit = 1 << 30;
// [grid steps squared] No edge of such a triangle is cut off by the limit in a block that has samples of it.
constexpr std::int64_t most_small_area = edge_limit - most_gained;

// 32 bits are enough for a sign: within a block an edge changes by less than this limit.
std::int32_t clamped(std::int64_t edge) {
    static_assert(most_gained <= edge_limit);
    return static_cast<std::int32_t>(std::clamp(edge, -edge_limit, edge_limit));
}

Blocks blocks_of(const WideTriangle& t, const NearLayer& layer) {
    constexpr int step = sample_block_side * grid_per_sample;
    const auto [min_x, max_x] = std::minmax({t.x[0], t.x[1], t.x[2]});
    const auto [min_y, max_y] = std::minmax({t.y[0], t.y[1], t.y[2]});
    const auto block = [](std::int32_t at) { return at >= 0 ? at / step : -1; };  // none is left of the picture
    return {std::max(block(min_x), layer.blocks().x0), std::min(block(max_x) + 1, layer.blocks().x1),
            std::max(block(min_y), layer.blocks().y0), std::min(block(max_y) + 1, layer.blocks().y1)};
}

void fill_wide(const TextureLayers& textures, const WideTriangle& t, NearLayer& layer) {
    const Floats f;
    const Ints i;
    const Blocks blocks = blocks_of(t, layer);
    if (blocks.first_column >= blocks.end_column || blocks.first_row >= blocks.end_row) return;
    const WideEdge edges[3] = {edge_between(t, 1, 2), edge_between(t, 2, 0), edge_between(t, 0, 1)};
    const std::int64_t area = edges[0].at(t.x[0], t.y[0]);
    const double over_area = 1.0 / static_cast<double>(area);
    // At samples inside, edges are whole below. However thin the triangle, its shares follow from them exactly; those
    // of a larger one change so little within a block that floats hold the steps.
    const bool is_small = area < most_small_area;
    const auto a_sample = [&](std::int64_t slope) {
        return static_cast<float>(static_cast<double>(grid_per_sample * slope) * over_area);
    };
    const Slopes slopes{a_sample(edges[1].along), a_sample(edges[1].down), a_sample(edges[2].along),
                        a_sample(edges[2].down)};
    const RichShading shades = rich_shading(textures, t.corners, t.texturing, slopes);
    for (int row = blocks.first_row; row < blocks.end_row; ++row) {
        for (int column = blocks.first_column; column < blocks.end_column; ++column) {
            const std::int64_t x = (std::int64_t{sample_block_side} * column) * grid_per_sample + grid_per_sample / 2;
            const std::int64_t y = (std::int64_t{sample_block_side} * row) * grid_per_sample + grid_per_sample / 2;
            const auto share = [&](const WideEdge& edge) {
                return hn::Set(f, static_cast<float>(static_cast<double>(edge.at(x, y)) * over_area));
            };
            for (int lane = 0; lane < block_samples; lane += lanes) {
                const auto across = hn::Load(i, offsets.x + lane), below = hn::Load(i, offsets.y + lane);
                const auto at_samples = [&](const WideEdge& edge) {
                    const auto start = hn::Set(i, clamped(edge.at(x, y) - (edge.owns ? 0 : 1)));
                    const auto along = hn::Set(i, static_cast<std::int32_t>(grid_per_sample * edge.along));
                    const auto down = hn::Set(i, static_cast<std::int32_t>(grid_per_sample * edge.down));
                    return hn::Add(start, hn::Add(hn::Mul(along, across), hn::Mul(down, below)));
                };
                const auto edge1 = at_samples(edges[1]), edge2 = at_samples(edges[2]);
                const auto outside = hn::Or(hn::Or(at_samples(edges[0]), edge1), edge2);
                FloatMask mask = hn::RebindMask(f, hn::Gt(outside, hn::Set(i, -1)));
                if (hn::AllFalse(f, mask)) continue;
                const auto x_in = hn::ConvertTo(f, across), y_in = hn::ConvertTo(f, below);
                const auto share_at = [&](const WideEdge& edge, VInt whole, float slope_x, float slope_y) {
                    if (is_small) {
                        const auto exact = hn::ConvertTo(f, hn::Add(whole, hn::Set(i, edge.owns ? 0 : 1)));
                        return hn::Mul(exact, hn::Set(f, static_cast<float>(over_area)));
                    }
                    return hn::Add(hn::Add(share(edge), hn::Mul(x_in, hn::Set(f, slope_x))),
                                   hn::Mul(y_in, hn::Set(f, slope_y)));
                };
                const auto second = share_at(edges[1], edge1, slopes.second_x, slopes.second_y);
                const auto third = share_at(edges[2], edge2, slopes.third_x, slopes.third_y);
                const auto depth =
                    between(shades.at.depth, shades.to_second.depth, shades.to_third.depth, second, third);
                const Block block = layer.block(column - layer.blocks().x0, row - layer.blocks().y0);
                const auto exists = [&](FloatMask& there) {
                    return !(shades.alpha_cutoff > 0) || keep_surface(shades, second, third, there);
                };
                if (!nearer(depth, mask, block, lane, exists)) continue;
                shade(shades, second, third, mask, block, lane);
                update_farthest(block);
            }
        }
    }
}

void fill_wide_all(const TextureLayers& textures, std::span<const WideTriangle> triangles, NearLayer& layer) {
    for (const WideTriangle& triangle : triangles) fill_wide(textures, triangle, layer);
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render::native {

HWY_EXPORT(fill_person);
HWY_EXPORT(fill_wide_all);

void fill(const PersonMesh& mesh, const PersonOnGrid& person, NearLayer& layer) {
    HWY_DYNAMIC_DISPATCH(fill_person)(mesh, person, layer);
}

void fill(const TextureLayers& textures, std::span<const WideTriangle> triangles, NearLayer& layer) {
    HWY_DYNAMIC_DISPATCH(fill_wide_all)(textures, triangles, layer);
}

}  // namespace render::native
#endif  // HWY_ONCE
