// Where pixels are sampled while the background is painted.
#pragma once

#include <array>

namespace render::native {

// Where the samples of a pixel are [1/8 px], from its top left corner. No two of four are in the same row or column, so
// that an edge that is nearly level or upright crosses a pixel in five steps and not in three.
struct SamplePoint {
    int x, y;
};
inline constexpr int sample_steps = 8;  // in a pixel
template <int samples>
inline constexpr std::array<SamplePoint, samples> sample_points{};
template <>
inline constexpr std::array<SamplePoint, 1> sample_points<1>{{{4, 4}}};
template <>
inline constexpr std::array<SamplePoint, 4> sample_points<4>{{{3, 1}, {7, 3}, {1, 5}, {5, 7}}};
// The first and the last row of samples, and column.
template <int samples>
inline constexpr int first_sample = samples == 1 ? 4 : 1;
template <int samples>
inline constexpr int last_sample = samples == 1 ? 4 : 7;

}  // namespace render::native
