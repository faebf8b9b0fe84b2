// GLSL's floats, vectors and functions over Highway vectors: what the shared files of shaders/ mean in C++, for many
// pixels at once. Included once for each instruction set; only operations that IEEE 754 defines to the bit, in an order
// that no set changes, so that every set paints the same picture.
#include <hwy/highway.h>

#if defined(RENDER_NATIVE_GLSL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_NATIVE_GLSL_H_
#undef RENDER_NATIVE_GLSL_H_
#else
#define RENDER_NATIVE_GLSL_H_
#endif

#include <glm/glm.hpp>

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;

struct Bool {
    hn::Mask<Floats> m;
};

struct real {
    hn::Vec<Floats> v;
    real() = default;
    real(float x) : v(hn::Set(Floats(), x)) {}
    explicit real(hn::Vec<Floats> x) : v(x) {}
};

HWY_INLINE real operator+(real a, real b) {
    return real(hn::Add(a.v, b.v));
}
HWY_INLINE real operator-(real a, real b) {
    return real(hn::Sub(a.v, b.v));
}
HWY_INLINE real operator*(real a, real b) {
    return real(hn::Mul(a.v, b.v));
}
HWY_INLINE real operator/(real a, real b) {
    return real(hn::Div(a.v, b.v));
}
HWY_INLINE real operator-(real a) {
    return real(hn::Neg(a.v));
}
HWY_INLINE Bool operator<(real a, real b) {
    return {hn::Lt(a.v, b.v)};
}
HWY_INLINE Bool operator>(real a, real b) {
    return {hn::Gt(a.v, b.v)};
}
HWY_INLINE bool somewhere(Bool condition) {
    return !hn::AllFalse(Floats(), condition.m);
}
HWY_INLINE real select(Bool condition, real yes, real no) {
    return real(hn::IfThenElse(condition.m, yes.v, no.v));
}
HWY_INLINE real min(real a, real b) {
    return real(hn::Min(a.v, b.v));
}
HWY_INLINE real max(real a, real b) {
    return real(hn::Max(a.v, b.v));
}
HWY_INLINE real abs(real a) {
    return real(hn::Abs(a.v));
}
HWY_INLINE real sqrt(real a) {
    return real(hn::Sqrt(a.v));
}
HWY_INLINE real round(real a) {
    return real(hn::Round(a.v));
}
HWY_INLINE real fract(real a) {
    return a - real(hn::Floor(a.v));
}
HWY_INLINE real sign(real a) {
    return select(a > 0.0f, 1.0f, select(a < 0.0f, -1.0f, 0.0f));
}
HWY_INLINE real clamp(real a, real low, real high) {
    return min(max(a, low), high);
}
// Of shares 0 and 1, a and b to the bit: what `somewhere` leaves out is left out of any number of pixels alike.
HWY_INLINE real mix(real a, real b, real share) {
    return a * (1.0f - share) + b * share;
}

// `power`: a power of two.
HWY_INLINE real pow(real a, float power) {
    for (float p = 1.0f; p < power; p *= 2.0f) a = a * a;
    return a;
}

// Within 2e-6 for |a| < 10,000: an odd polynomial of what is left of `a` beyond whole half turns.
HWY_INLINE real sin(real a) {
    const real half_turns = round(a * 0.318309886f);
    const real rest = (a - half_turns * 3.140625f) - half_turns * 9.67653590e-4f;
    const real x = clamp(rest, -1.6f, 1.6f);
    const real y = x * x;
    const real p = x + x * y * (-1.66666597e-1f + y * (8.33305567e-3f + y * (-1.98089111e-4f + y * 2.60479e-6f)));
    const real is_odd = abs(half_turns - 2.0f * round(half_turns * 0.5f));
    return p * (1.0f - 2.0f * is_odd);
}

struct vec2 {
    real x, y;
    vec2() = default;
    vec2(real x_, real y_) : x(x_), y(y_) {}
};

HWY_INLINE vec2 operator+(vec2 a, vec2 b) {
    return {a.x + b.x, a.y + b.y};
}
HWY_INLINE vec2 operator+(vec2 a, real b) {
    return {a.x + b, a.y + b};
}
HWY_INLINE vec2 operator-(vec2 a, vec2 b) {
    return {a.x - b.x, a.y - b.y};
}
HWY_INLINE vec2 operator-(vec2 a, real b) {
    return {a.x - b, a.y - b};
}
HWY_INLINE vec2 operator*(vec2 a, real b) {
    return {a.x * b, a.y * b};
}
HWY_INLINE vec2 operator/(vec2 a, real b) {
    return {a.x / b, a.y / b};
}
HWY_INLINE vec2 select(Bool condition, vec2 yes, vec2 no) {
    return {select(condition, yes.x, no.x), select(condition, yes.y, no.y)};
}
HWY_INLINE vec2 max(vec2 a, real b) {
    return {max(a.x, b), max(a.y, b)};
}
HWY_INLINE vec2 abs(vec2 a) {
    return {abs(a.x), abs(a.y)};
}
HWY_INLINE vec2 fract(vec2 a) {
    return {fract(a.x), fract(a.y)};
}
HWY_INLINE real dot(vec2 a, vec2 b) {
    return a.x * b.x + a.y * b.y;
}
HWY_INLINE real length(vec2 a) {
    return sqrt(dot(a, a));
}

struct vec3 {
    real x, y, z;
    vec3() = default;
    explicit vec3(real all) : x(all), y(all), z(all) {}
    vec3(real x_, real y_, real z_) : x(x_), y(y_), z(z_) {}
    explicit vec3(const glm::vec4& v) : x(v.x), y(v.y), z(v.z) {}
    explicit vec3(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

HWY_INLINE vec3 operator+(vec3 a, vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE vec3 operator-(vec3 a, vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE vec3 operator*(vec3 a, vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE vec3 operator*(vec3 a, real b) {
    return {a.x * b, a.y * b, a.z * b};
}
HWY_INLINE vec3 operator*(real a, vec3 b) {
    return b * a;
}
HWY_INLINE vec3 mix(vec3 a, vec3 b, real share) {
    return a * (1.0f - share) + b * share;
}
HWY_INLINE vec3 sqrt(vec3 a) {
    return {sqrt(a.x), sqrt(a.y), sqrt(a.z)};
}
HWY_INLINE real dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE vec3 normalize(vec3 a) {
    return a * (1.0f / sqrt(dot(a, a)));
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
