#include "render/native/shade.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/shade.cpp"
#include <hwy/foreach_target.h>
// After it, as Highway wants it.
#include <hwy/highway.h>

#include "render/native/glsl.h"

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

// Each is a shader: what it reads of the frame, and its functions.
struct Daylight {
    const FrameBlock& Frame;
    explicit Daylight(const FrameBlock& frame) : Frame(frame) {}
#include "shaders/light.glsl"
};
struct Sky {
    const FrameBlock& Frame;
    explicit Sky(const FrameBlock& frame) : Frame(frame) {}
#include "shaders/sky.glsl"
};
struct StadiumGround {
    const FrameBlock& Frame;
    explicit StadiumGround(const FrameBlock& frame) : Frame(frame) {}
#include "shaders/grounds/stadium.glsl"
};

using Words = hn::RebindToUnsigned<Floats>;

constexpr int lanes = static_cast<int>(hn::MaxLanes(Floats()));

template <int shift>
HWY_INLINE hn::Vec<Words> packed(real channel) {
    const auto byte = hn::NearestInt((clamp(channel, 0.0f, 1.0f) * 255.0f).v);
    return hn::ShiftLeft<shift>(hn::BitCast(Words(), byte));
}

// Red, green and blue in bytes 0, 1, 2; byte 3 is 255.
HWY_INLINE hn::Vec<Words> packed(vec3 color) {
    const Words du;
    return hn::Or(hn::Or(packed<0>(color.x), packed<8>(color.y)), hn::Or(packed<16>(color.z), hn::Set(du, finished)));
}

std::uint32_t light_corner(const FrameBlock& frame, const scene::StaticVertex& corner) {
    constexpr float whole = 255.0f;
    const vec3 color(corner.color.r / whole, corner.color.g / whole, corner.color.b / whole);
    const vec3 light = Daylight(frame).lit(vec3(corner.normal), corner.open);
    return hn::GetLane(packed(sqrt(color * color * light)));
}

void light_corners(const FrameBlock& frame, std::span<const scene::StaticVertex> corners, std::uint32_t* out) {
    for (const scene::StaticVertex& corner : corners) *out++ = light_corner(frame, corner);
}

// Where a block's pixels are on the screen, its right and upper edge at 1.
struct Screen {
    float x0, y0, step_x, step_y;

    Screen(const Shading& shading, const Cell<most_samples>& cell, int column, int row)
        : step_x(2.0f / static_cast<float>(shading.width)), step_y(-2.0f / static_cast<float>(shading.height)) {
        x0 = (static_cast<float>(cell.x0 + column * block_side) + 0.5f) * step_x - 1.0f;
        y0 = (static_cast<float>(cell.y0 + row * block_side) + 0.5f) * step_y + 1.0f;
    }
};

// The columns and rows of a block's pixels, as they lie in memory.
struct Places {
    alignas(64) float column[block_pixels];
    alignas(64) float row[block_pixels];
};
constexpr Places make_places() {
    Places places{};
    for (int i = 0; i < block_pixels; ++i) {
        places.column[i] = static_cast<float>(i % block_side);
        places.row[i] = static_cast<float>(i / block_side);
    }
    return places;
}
constexpr Places places = make_places();

HWY_INLINE real load(const float* from) {
    return real(hn::Load(Floats(), from));
}

HWY_INLINE vec2 at_pixel(const Screen& screen, int i) {
    return {screen.x0 + load(places.column + i) * screen.step_x, screen.y0 + load(places.row + i) * screen.step_y};
}

// What a block's samples show: so many planes of block_pixels.
struct Surfaces {
    std::uint32_t* of;
    int planes;

    std::uint32_t* at(int plane, int i) const { return of + plane * block_pixels + i; }
};

// Which of a vector of pixels' samples show `surface`; `any`: a sample of which pixels does.
struct Shown {
    hn::Mask<Words> in[most_samples];
    hn::Mask<Words> any;

    HWY_ATTR Shown(const Surfaces& surfaces, int i, std::uint32_t surface) {
        const Words du;
        for (int plane = 0; plane < surfaces.planes; ++plane) {
            in[plane] = hn::Eq(hn::Load(du, surfaces.at(plane, i)), hn::Set(du, surface));
            any = plane == 0 ? in[0] : hn::Or(any, in[plane]);
        }
    }
    HWY_ATTR void replace(const Surfaces& surfaces, int i, hn::Vec<Words> color) const {
        const Words du;
        for (int plane = 0; plane < surfaces.planes; ++plane) {
            std::uint32_t* to = surfaces.at(plane, i);
            hn::Store(hn::IfThenElse(in[plane], color, hn::Load(du, to)), du, to);
        }
    }
};

// Of a block's samples that aren't finished: whether any is sky, and the first and the last number of a ground, or 0.
struct Unfinished {
    bool sky = false;
    std::uint32_t first_ground = 0, last_ground = 0;
};
HWY_INLINE Unfinished find_unfinished(const Surfaces& surfaces) {
    const Words du;
    const auto done = hn::Set(du, finished), one = hn::Set(du, 1);
    auto all = done, least = done, first = done, last = hn::Zero(du);
    for (int i = 0; i < surfaces.planes * block_pixels; i += lanes) {
        const auto s = hn::Load(du, surfaces.of + i);
        all = hn::And(all, s);
        least = hn::Min(least, s);
        first = hn::Min(first, hn::Sub(s, one));  // of sky, the greatest number
        last = hn::Max(last, hn::IfThenZeroElse(hn::Eq(hn::And(s, done), done), s));
    }
    if (hn::AllTrue(du, hn::Eq(all, done))) return {};
    return {hn::GetLane(hn::MinOfLanes(du, least)) == sky_surface, hn::GetLane(hn::MinOfLanes(du, first)) + 1,
            hn::GetLane(hn::MaxOfLanes(du, last))};
}

__attribute__((flatten)) void shade_sky(const Shading& shading, const Screen& screen, const Surfaces& surfaces) {
    Sky sky(shading.frame);
    for (int i = 0; i < block_pixels; i += lanes) {
        const Shown shown(surfaces, i, sky_surface);
        if (!hn::AllFalse(Words(), shown.any)) shown.replace(surfaces, i, packed(sky.sky_at(at_pixel(screen, i))));
    }
}

// The ground under a block's pixels, each as if the triangle were endless, and what it differs by between the two
// neighbours of a pair: pairs begin at even columns and rows.
struct GroundPlaces {
    alignas(64) float x[block_pixels], z[block_pixels];
    alignas(64) float right_x[block_pixels], right_z[block_pixels];
    alignas(64) float up_x[block_pixels], up_z[block_pixels];
};

HWY_INLINE void find_ground_places(const Shading& shading, const Screen& screen, const ScreenTriangle& triangle, int x0,
                                   int y0, GroundPlaces& out) {
    const Floats d;
    const FrameBlock& frame = shading.frame;
    const real depth0(static_cast<float>(triangle.depth + triangle.depth_x * x0 + triangle.depth_y * y0));
    const real depth_x(static_cast<float>(triangle.depth_x)), depth_y(static_cast<float>(triangle.depth_y));
    constexpr float horizon = 1e-7f;  // a thousand kilometres: beyond it lies nothing
    for (int i = 0; i < block_pixels; i += lanes) {
        const real depth = (depth0 + depth_y * load(places.row + i)) + depth_x * load(places.column + i);
        const real away = near_plane / max(depth, horizon);
        const vec2 at = at_pixel(screen, i);
        const vec3 ray = vec3(frame.view_forward) + at.x * vec3(frame.view_right) + at.y * vec3(frame.view_up);
        const real x = frame.camera_position.x + ray.x * away, z = frame.camera_position.z + ray.z * away;
        hn::Store(x.v, d, out.x + i);
        hn::Store(z.v, d, out.z + i);
        hn::Store(hn::Sub(hn::DupOdd(x.v), hn::DupEven(x.v)), d, out.right_x + i);
        hn::Store(hn::Sub(hn::DupOdd(z.v), hn::DupEven(z.v)), d, out.right_z + i);
    }
    const hn::CappedTag<float, block_side> row;
    for (int upper = 0; upper < block_pixels; upper += 2 * block_side)
        for (int i = upper; i < upper + block_side; i += static_cast<int>(hn::Lanes(row))) {
            const int lower = i + block_side;
            const auto up_x = hn::Sub(hn::Load(row, out.x + i), hn::Load(row, out.x + lower));
            const auto up_z = hn::Sub(hn::Load(row, out.z + i), hn::Load(row, out.z + lower));
            for (const int to : {i, lower}) {
                hn::Store(up_x, row, out.up_x + to);
                hn::Store(up_z, row, out.up_z + to);
            }
        }
}

template <typename Ground>
__attribute__((flatten)) void shade_ground(const Shading& shading, const GroundPlaces& at, std::uint32_t number,
                                           const Surfaces& surfaces) {
    for (int i = 0; i < block_pixels; i += lanes) {
        const Shown shown(surfaces, i, number);
        if (hn::AllFalse(Words(), shown.any)) continue;
        Ground ground(shading.frame);
        ground.set_pixel({load(at.right_x + i), load(at.right_z + i)}, {load(at.up_x + i), load(at.up_z + i)});
        const vec3 linear = ground.surface_at({load(at.x + i), load(at.z + i)}) * ground.daylight();
        shown.replace(surfaces, i, packed(sqrt(linear)));
    }
}

const ScreenTriangle& triangle_of(std::span<const std::span<const ScreenTriangle>> grounds, std::uint32_t number) {
    std::size_t i = number - ground_surface;
    while (i >= grounds[0].size()) {
        i -= grounds[0].size();
        grounds = grounds.subspan(1);
    }
    return grounds[0][i];
}

void finish(const Shading& shading, std::span<const std::span<const ScreenTriangle>> grounds,
            const Cell<most_samples>& cell, int column, int row, const Surfaces& surfaces) {
    Unfinished left = find_unfinished(surfaces);
    if (!left.sky && left.last_ground == 0) return;
    const Screen screen(shading, cell, column, row);
    if (left.sky) shade_sky(shading, screen, surfaces);
    while (left.last_ground != 0) {
        const std::uint32_t number = left.last_ground;
        GroundPlaces at;
        find_ground_places(shading, screen, triangle_of(grounds, number), cell.x0 + column * block_side,
                           cell.y0 + row * block_side, at);
        shade_ground<StadiumGround>(shading, at, number, surfaces);
        left = left.first_ground == number ? Unfinished{} : find_unfinished(surfaces);
    }
}

// The mean of four colours' light.
HWY_INLINE hn::Vec<Words> mean(const hn::Vec<Words>* color) {
    const Words du;
    const Floats d;
    auto all = hn::Set(du, finished);
    for (const int shift : {0, 8, 16}) {
        auto light = hn::Zero(d);
        for (int s = 0; s < most_samples; ++s) {
            const auto byte = hn::And(hn::ShiftRightSame(color[s], shift), hn::Set(du, 255));
            const auto root = hn::ConvertTo(d, hn::BitCast(hn::RebindToSigned<Floats>(), byte));
            light = hn::Add(light, hn::Mul(root, root));
        }
        const auto root = hn::NearestInt(hn::Sqrt(hn::Mul(light, hn::Set(d, 1.0f / most_samples))));
        all = hn::Or(all, hn::ShiftLeftSame(hn::BitCast(du, root), shift));
    }
    return all;
}

// The second farthest of four.
HWY_INLINE hn::Vec<Floats> second_farthest(const hn::Vec<Floats>* depth) {
    const auto farther = hn::Max(hn::Min(depth[0], depth[1]), hn::Min(depth[2], depth[3]));
    return hn::Min(farther, hn::Min(hn::Max(depth[0], depth[1]), hn::Max(depth[2], depth[3])));
}

void filter(const Surfaces& surfaces, const float* depths, PaintedBlock& out) {
    const Words du;
    const Floats d;
    for (int i = 0; i < block_pixels; i += lanes) {
        hn::Vec<Words> color[most_samples];
        hn::Vec<Floats> depth[most_samples];
        auto differ = hn::Zero(du);
        for (int s = 0; s < most_samples; ++s) {
            color[s] = hn::Load(du, surfaces.at(s, i));
            differ = hn::Or(differ, hn::Xor(color[s], color[0]));
            depth[s] = hn::Load(d, depths + s * block_pixels + i);
        }
        hn::Store(hn::AllTrue(du, hn::Eq(differ, hn::Zero(du))) ? color[0] : mean(color), du, out.color + i);
        hn::Store(second_farthest(depth), d, out.depth + i);
    }
}

// Of a block that one surface fills.
void spread(const Sheet& sheet, PaintedBlock& out) {
    const Words du;
    const Floats d;
    const auto surface = hn::Set(du, sheet.surface);
    for (int i = 0; i < block_pixels; i += lanes) {
        hn::Vec<Floats> depth[most_samples];
        for (int s = 0; s < most_samples; ++s) {
            constexpr float step = 1.0f / sample_steps;
            const SamplePoint at = sample_points<most_samples>[s];
            const auto x = hn::Add(hn::Load(d, places.column + i), hn::Set(d, step * static_cast<float>(at.x)));
            const auto y = hn::Add(hn::Load(d, places.row + i), hn::Set(d, step * static_cast<float>(at.y)));
            depth[s] = hn::Add(hn::Add(hn::Set(d, sheet.depth), hn::Mul(hn::Set(d, sheet.depth_y), y)),
                               hn::Mul(hn::Set(d, sheet.depth_x), x));
        }
        hn::Store(surface, du, out.color + i);
        hn::Store(second_farthest(depth), d, out.depth + i);
    }
}

void shade(const Shading& shading, std::span<const std::span<const ScreenTriangle>> grounds, Cell<most_samples>& cell,
           int column, int row, PaintedBlock& out) {
    const Floats d;
    const std::size_t block = cell.block(column, row);
    if (cell.is_sheet[block]) {
        spread(cell.sheet[block], out);
        finish(shading, grounds, cell, column, row, {out.color, 1});
    } else {
        const Surfaces surfaces{cell.surfaces(block), most_samples};
        finish(shading, grounds, cell, column, row, surfaces);
        filter(surfaces, cell.depths(block), out);
    }
    auto least = hn::Load(d, out.depth);
    for (int i = lanes; i < block_pixels; i += lanes) least = hn::Min(least, hn::Load(d, out.depth + i));
    out.farthest = hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <stdexcept>
#include <string>

namespace render::native {

GroundPaint find_ground(std::string_view shader) {
    if (shader.empty()) return GroundPaint::none;
    if (shader == "stadium.glsl") return GroundPaint::stadium;
    throw std::runtime_error("shaders/grounds/" + std::string(shader) + ": found no native form of it");
}

HWY_EXPORT(light_corners);
std::vector<std::uint32_t> light_corners(const FrameBlock& frame, std::span<const scene::StaticVertex> corners) {
    std::vector<std::uint32_t> colors(corners.size());
    HWY_DYNAMIC_DISPATCH(light_corners)(frame, corners, colors.data());
    return colors;
}

HWY_EXPORT(shade);
void shade(const Shading& shading, std::span<const std::span<const ScreenTriangle>> grounds, Cell<most_samples>& cell,
           int column, int row, PaintedBlock& out) {
    HWY_DYNAMIC_DISPATCH(shade)(shading, grounds, cell, column, row, out);
}

}  // namespace render::native
#endif
