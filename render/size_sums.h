// Sums over people by their size on the screen, in single precision: of those who are smaller than a size. What people
// between two sizes come to is the difference of two. All sums are made at a time, and the same bits on any processor.
//
// Sizes are places among bins: a whole number is an edge between two, and whoever is in a bin is spread evenly over it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace render {

struct alignas(64) SizeSums {
    static constexpr std::size_t most_cells = 4;
    enum : std::size_t {
        people,
        surface,  // [px^2]
        shown,    // [px] of silhouettes
        // Were everybody drawn alike: work, and errors, of points by the cell that they are added up in.
        triangles,
        few_points,
        most_points,
        mesh_error,
        splat_error,
        few_error,
        most_error = few_error + most_cells,
        count = most_error + most_cells
    };
    std::array<float, count> sums{};

    double operator[](std::size_t sum) const { return static_cast<double>(sums[sum]); }
};

// The people of a bin.
struct SizeBin {
    double people = 0, surface = 0, shown = 0;
};
// `weights`: by bin, what each sum gains for one of people, of their surface or of what shows, whichever it grows with.
// `below`: by edge, one more than bins.
void sum_up(std::span<const SizeBin> bins, const SizeSums* weights, SizeSums* below);

// People who have the same borders.
struct SizedRow {
    const SizeSums *below, *all;  // the sums by edge, and the last of them: another is read behind it and has no effect
    float first, bins;            // place of the first edge; bins
    std::uint32_t borders;        // index of theirs
};
// Places from which on people are drawn as something else, in ascending order.
struct alignas(16) SizeBorders {
    float splats_to, few_to, most_from, meshes_from;
};
// People by what they are drawn as: splats, as few points as there may be, points by their spacing, as many as there
// are, meshes.
struct SizeParts {
    SizeSums splats, few, spaced, most, meshes;
};
inline constexpr std::size_t most_sized_rows = 32;
// Of all rows together, of which there are no more than that.
SizeParts divide(std::span<const SizedRow> rows, const SizeBorders* borders);

}  // namespace render
