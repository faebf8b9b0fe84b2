// Weighted sums of rows of numbers.
#pragma once

#include <array>
#include <cstdint>

namespace render::native {

inline constexpr int mixed_rows = 8, mixed_values = 16;

// out[i] = the sum of weights[row] * rows[row][i], row by row.
void mix(const std::array<const std::uint16_t*, mixed_rows>& rows, const std::array<float, mixed_rows>& weights,
         std::array<float, mixed_values>& out);

}  // namespace render::native
