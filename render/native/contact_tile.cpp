#include "render/native/contact_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/contact_tile.cpp"
#include <hwy/foreach_target.h>
// After it, as Highway wants it.
#include <hwy/highway.h>

#include <cstddef>

#include "render/native/glsl.h"

#ifndef GRANDSTAND_NATIVE_CONTACT_TILE_ONCE
#define GRANDSTAND_NATIVE_CONTACT_TILE_ONCE

namespace render::native {

// Pixels in rows: `ray` goes through the first one's middle and has depth 1, the steps lead to the next and down.
struct PixelRows {
    glm::vec3 ray, step_right, step_down;
    const float* depth;  // as a backdrop's
    float* left;         // of their colours
    int depth_stride, left_stride, columns, rows;
};

}  // namespace render::native

#endif

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

#include "shaders/contact.glsl"

constexpr int lanes = static_cast<int>(hn::MaxLanes(Floats()));

// Multiplies what is left by what `shade` leaves, whose least and greatest depth are given as a backdrop has them. All
// is read and written in whole vectors.
__attribute__((flatten)) void Darken(const PixelRows& pixels, const ContactShade& shade, float farthest,
                                     float nearest) {
    const Floats d;
    const real peak(shade.peak), fall(shade.fall);
    const vec3 feet(shade.feet), step(pixels.step_right);
    const auto far = hn::Set(d, farthest), near = hn::Set(d, nearest);
    for (int y = 0; y < pixels.rows; ++y) {
        const float* depths = pixels.depth + std::ptrdiff_t{pixels.depth_stride} * y;
        float* left = pixels.left + std::ptrdiff_t{pixels.left_stride} * y;
        const vec3 ray(pixels.ray + static_cast<float>(y) * pixels.step_down);
        for (int x = 0; x < pixels.columns; x += lanes) {
            const auto depth = hn::LoadU(d, depths + x);
            const auto is_there = hn::And(hn::Ge(depth, far), hn::Le(depth, near));
            if (hn::AllFalse(d, is_there)) continue;
            const real column(hn::Iota(d, static_cast<float>(x)));
            const vec3 at = (ray + column * step) * (real(near_plane) / real(depth));
            const auto all = hn::Mul(hn::LoadU(d, left + x), left_by(at - feet, peak, fall).v);
            hn::StoreU(hn::IfThenElse(is_there, all, hn::LoadU(d, left + x)), d, left + x);
        }
    }
}

// Colours with so much left of each channel.
void ShadeRow(const std::uint32_t* colors, const float* left, std::uint32_t* to, int count) {
    const Floats d;
    const hn::RebindToUnsigned<Floats> words;
    const hn::RebindToSigned<Floats> ints;
    const auto byte = hn::Set(words, 255u);
    for (int x = 0; x < count; x += lanes) {
        const auto color = hn::LoadU(words, colors + x);
        const auto share = hn::LoadU(d, left + x);
        const auto channel = [&](auto code) HWY_ATTR {
            const auto value = hn::ConvertTo(d, hn::BitCast(ints, hn::And(code, byte)));
            return hn::BitCast(words, hn::NearestInt(hn::Mul(value, share)));
        };
        auto out = hn::AndNot(hn::Set(words, 0x00ffffffu), color);
        out = hn::Or(out, channel(color));
        out = hn::Or(out, hn::ShiftLeft<8>(channel(hn::ShiftRight<8>(color))));
        out = hn::Or(out, hn::ShiftLeft<16>(channel(hn::ShiftRight<16>(color))));
        hn::StoreU(out, words, to + x);
    }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>
#include <cmath>

namespace render::native {

HWY_EXPORT(Darken);
HWY_EXPORT(ShadeRow);

namespace {

constexpr int whole = 16;              // no vector has more lanes
constexpr float whole_reach = 1.001f;  // of the radius: what rounding may move a depth by

Rect intersection(const Rect& a, const Rect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// The tile's columns in whole vectors: planes have room for them.
Rect in_whole_vectors(const Rect& rect, const Tile& tile) {
    const int first = (rect.x0 - tile.x0) / whole * whole, end = (rect.x1 - tile.x0 + whole - 1) / whole * whole;
    return {tile.x0 + first, rect.y0, tile.x0 + end, rect.y1};
}

// Rays through pixels' middles.
class Rays {
public:
    explicit Rays(const View& view)
        : forward_(view.forward), right_(view.tan_half_x * view.right), up_(view.tan_half_y * view.up) {
        step_x_ = 2.0f / static_cast<float>(view.width);
        step_y_ = 2.0f / static_cast<float>(view.height);
    }
    glm::vec3 at(int x, int y) const {
        return forward_ + ((static_cast<float>(x) + 0.5f) * step_x_ - 1.0f) * right_ +
               (1.0f - (static_cast<float>(y) + 0.5f) * step_y_) * up_;
    }
    glm::vec3 step_right() const { return step_x_ * right_; }
    glm::vec3 step_down() const { return -step_y_ * up_; }

private:
    glm::vec3 forward_, right_, up_;
    float step_x_, step_y_;
};

// [low, high] of a / b for a in [a - r, a + r] and b in [near, far] > 0.
struct Range {
    float low, high;
    Range(float a, float r, float near, float far)
        : low(std::min((a - r) / near, (a - r) / far)), high(std::max((a + r) / near, (a + r) / far)) {}
};

}  // namespace

Rect bounds_of(const View& view, const ContactShade& shade) {
    const float depth = view.depth(shade.feet), far = depth + shade.radius;
    if (far < near_plane) return {};
    const float near = std::max(depth - shade.radius, near_plane);
    const Range x(glm::dot(view.right, shade.feet) / view.tan_half_x, shade.radius / view.tan_half_x, near, far);
    const Range y(glm::dot(view.up, shade.feet) / view.tan_half_y, shade.radius / view.tan_half_y, near, far);
    const auto pixel = [](float screen, int size) {
        const float half = 0.5f * static_cast<float>(size);
        return std::clamp(half + half * screen, -1.0f, static_cast<float>(size) + 1.0f);
    };
    return {static_cast<int>(std::floor(pixel(x.low, view.width))),
            static_cast<int>(std::floor(pixel(-y.high, view.height))),
            static_cast<int>(std::ceil(pixel(x.high, view.width))),
            static_cast<int>(std::ceil(pixel(-y.low, view.height)))};
}

ContactTile::ContactTile() : left_(std::size_t{tile_side} * tile_side), colors_(left_.size()) {}

TileColors ContactTile::darken(const View& view, const Tile& tile, const BackdropPicture& behind,
                               std::span<const ContactShade> shades, std::span<const Rect> bounds,
                               std::span<const std::uint32_t> which) {
    const Rect all{tile.x0, tile.y0, tile.x1, tile.y1};
    Rect touched{tile.x1, tile.y1, tile.x0, tile.y0};
    for (const std::uint32_t i : which) {
        const Rect part = intersection(bounds[i], all);
        touched = {std::min(touched.x0, part.x0), std::min(touched.y0, part.y0), std::max(touched.x1, part.x1),
                   std::max(touched.y1, part.y1)};
    }
    if (touched.empty()) return colors_of(tile, behind);
    touched = in_whole_vectors(touched, tile);
    const auto index = [&](int x, int y) { return std::size_t{tile_side} * (y - tile.y0) + (x - tile.x0); };
    for (int y = touched.y0; y < touched.y1; ++y)
        std::fill_n(&left_[index(touched.x0, y)], touched.x1 - touched.x0, 1.0f);

    const Rays rays(view);
    for (const std::uint32_t i : which) {
        const ContactShade& shade = shades[i];
        const Rect part = in_whole_vectors(intersection(bounds[i], all), tile);
        const float depth = view.depth(shade.feet), reach = whole_reach * shade.radius;
        const float farthest = near_plane / (depth + reach), nearest = near_plane / std::max(depth - reach, near_plane);
        HWY_DYNAMIC_DISPATCH(Darken)
        ({rays.at(part.x0, part.y0), rays.step_right(), rays.step_down(), behind.depth.row(part.y0) + part.x0,
          &left_[index(part.x0, part.y0)], behind.depth.stride(), tile_side, part.x1 - part.x0, part.y1 - part.y0},
         shade, farthest, nearest);
    }
    for (int y = tile.y0; y < tile.y1; ++y) {
        const std::uint32_t* from = behind.color.row(y);
        std::copy_n(from + tile.x0, tile.x1 - tile.x0, &colors_[index(tile.x0, y)]);
        if (y < touched.y0 || y >= touched.y1) continue;
        HWY_DYNAMIC_DISPATCH(ShadeRow)
        (from + touched.x0, &left_[index(touched.x0, y)], &colors_[index(touched.x0, y)], touched.x1 - touched.x0);
    }
    return {colors_.data(), tile_side};
}

}  // namespace render::native

#endif
