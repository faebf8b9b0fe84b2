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
    const vec3 light = Daylight(frame).lit(vec3(corner.normal));
    return hn::GetLane(packed(sqrt(color * color * light)));
}

void light_corners(const FrameBlock& frame, std::span<const scene::StaticVertex> corners, std::uint32_t* out) {
    for (const scene::StaticVertex& corner : corners) *out++ = light_corner(frame, corner);
}

// Where a block's pixels are on the screen, its right and upper edge at 1.
struct Screen {
    float x0, y0, step_x, step_y;

    Screen(const Shading& shading, const Cell& cell, int column, int row)
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

HWY_INLINE void store_where(hn::Mask<Words> mask, hn::Vec<Words> color, hn::Vec<Words> before, std::uint32_t* to) {
    hn::Store(hn::IfThenElse(mask, color, before), Words(), to);
}

HWY_INLINE bool is_finished(const std::uint32_t* surface) {
    const Words du;
    auto all = hn::Set(du, finished);
    for (int i = 0; i < block_pixels; i += lanes) all = hn::And(all, hn::Load(du, surface + i));
    return hn::AllTrue(du, hn::Eq(all, hn::Set(du, finished)));
}

// Of a block's pixels: whether any is sky, and the greatest number of a ground that is not finished, or 0.
struct Unfinished {
    bool sky = false;
    std::uint32_t ground = 0;
};
HWY_INLINE Unfinished find_unfinished(const std::uint32_t* surface) {
    const Words du;
    const auto done = hn::Set(du, finished);
    auto least = done, most = hn::Zero(du);
    for (int i = 0; i < block_pixels; i += lanes) {
        const auto s = hn::Load(du, surface + i);
        least = hn::Min(least, s);
        most = hn::Max(most, hn::IfThenZeroElse(hn::Eq(hn::And(s, done), done), s));
    }
    return {hn::GetLane(hn::MinOfLanes(du, least)) == sky_surface, hn::GetLane(hn::MaxOfLanes(du, most))};
}

__attribute__((flatten)) void shade_sky(const Shading& shading, const Screen& screen, std::uint32_t* surface) {
    const Words du;
    Sky sky(shading.frame);
    for (int i = 0; i < block_pixels; i += lanes) {
        const auto before = hn::Load(du, surface + i);
        const auto is_sky = hn::Eq(before, hn::Zero(du));
        if (hn::AllFalse(du, is_sky)) continue;
        store_where(is_sky, packed(sky.sky_at(at_pixel(screen, i))), before, surface + i);
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
                                           std::uint32_t* surface) {
    const Words du;
    for (int i = 0; i < block_pixels; i += lanes) {
        const auto before = hn::Load(du, surface + i);
        const auto is_it = hn::Eq(before, hn::Set(du, number));
        if (hn::AllFalse(du, is_it)) continue;
        Ground ground(shading.frame);
        ground.set_pixel({load(at.right_x + i), load(at.right_z + i)}, {load(at.up_x + i), load(at.up_z + i)});
        const vec3 linear = ground.surface_at({load(at.x + i), load(at.z + i)}) * ground.daylight();
        store_where(is_it, packed(sqrt(linear)), before, surface + i);
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

void shade(const Shading& shading, std::span<const std::span<const ScreenTriangle>> grounds, Cell& cell, int column,
           int row) {
    std::uint32_t* surface = &cell.surface[Cell::block(column, row) * block_pixels];
    if (is_finished(surface)) return;
    const Unfinished unfinished = find_unfinished(surface);
    const Screen screen(shading, cell, column, row);
    if (unfinished.sky) shade_sky(shading, screen, surface);
    for (std::uint32_t number = unfinished.ground; number != 0;
         number = is_finished(surface) ? 0 : find_unfinished(surface).ground) {
        GroundPlaces at;
        find_ground_places(shading, screen, triangle_of(grounds, number), cell.x0 + column * block_side,
                           cell.y0 + row * block_side, at);
        shade_ground<StadiumGround>(shading, at, number, surface);
    }
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
void shade(const Shading& shading, std::span<const std::span<const ScreenTriangle>> grounds, Cell& cell, int column,
           int row) {
    HWY_DYNAMIC_DISPATCH(shade)(shading, grounds, cell, column, row);
}

}  // namespace render::native
#endif
