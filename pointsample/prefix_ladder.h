// The numbers of points that are drawn and measured: powers of two and their halfway marks. Few numbers keep batches
// large, and neighbours differ by no more than half.
#pragma once

#include <bit>
#include <cstdint>

namespace pointsample {

// 1, 2, 3, 4, 6, 8, 12, 16, 24 ... for rungs 0 to 62.
constexpr std::uint32_t points_of_rung(std::uint32_t rung) {
    if (rung < 2) return rung + 1;
    return rung % 2 == 0 ? 3u << (rung / 2 - 1) : 1u << ((rung + 1) / 2);
}

// The highest rung of at most so many points, >= 1.
constexpr std::uint32_t rung_of(std::uint32_t points) {
    const auto octave = static_cast<std::uint32_t>(std::bit_width(points)) - 1;
    if (octave == 0) return 0;
    return 2 * octave - 1 + (points >> (octave - 1) & 1);
}

}  // namespace pointsample
