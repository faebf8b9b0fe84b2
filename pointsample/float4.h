// Four floats at a time, in the vector extension that GCC and Clang share; every operation is IEEE's, lane by lane.
#pragma once

#include <cstddef>

namespace pointsample {

using Float4 = float __attribute__((vector_size(16)));

inline Float4 all(float value) {
    return Float4{value, value, value, value};
}
inline Float4 smaller(Float4 a, Float4 b) {
    return a < b ? a : b;
}
inline Float4 larger(Float4 a, Float4 b) {
    return a > b ? a : b;
}
inline float largest(Float4 a) {
    const float x = a[0] > a[1] ? a[0] : a[1], y = a[2] > a[3] ? a[2] : a[3];
    return x > y ? x : y;
}
inline float smallest(Float4 a) {
    return -largest(-a);
}

// 4 n floats. Both compilers let a vector's elements be read and written as floats.
template <std::size_t n>
struct Row {
    Float4 four[n];

    float& operator[](std::size_t i) { return reinterpret_cast<float*>(four)[i]; }
    float operator[](std::size_t i) const { return reinterpret_cast<const float*>(four)[i]; }
    void fill(float value) {
        for (Float4& f : four) f = all(value);
    }
};

template <std::size_t n>
float largest(const Row<n>& row) {
    Float4 most = row.four[0];
    for (std::size_t i = 1; i < n; ++i) most = larger(most, row.four[i]);
    return largest(most);
}
template <std::size_t n>
float smallest(const Row<n>& row) {
    Float4 least = row.four[0];
    for (std::size_t i = 1; i < n; ++i) least = smaller(least, row.four[i]);
    return smallest(least);
}

// The first place of `value`; the last place if there is none.
template <std::size_t n>
std::size_t first_of(const Row<n>& row, float value) {
    std::size_t i = 0;
    while (i + 1 < 4 * n && row[i] != value) ++i;
    return i;
}

}  // namespace pointsample
