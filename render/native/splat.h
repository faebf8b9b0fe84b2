// People as points with coverage. A person's points are first added up in a patch of their own, each as the area that
// it covers there, spread over the four cells around it; the patch is then laid behind what is already in the tile.
//
// Within a patch areas add: the points lie side by side on one surface, and those that it hides are left out. Between
// people coverage multiplies: they know nothing of one another. docs/native-splats.md has the whole story.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "model/slot.h"
#include "render/native/array.h"
#include "render/native/near_layer.h"
#include "render/native/posed_chunk.h"

namespace render::native {

// Fixed-point units.
inline constexpr int cell_bits = 7;              // positions: 128 steps a cell
inline constexpr std::int16_t cell_full = 8192;  // a cell that is covered once; up to 4 times fit

// Sums over so few points depend on which they are: they are made to cover what the silhouette does, one by one.
inline constexpr int longest_summed_prefix = 512;

// Where that is in depth which a patch holds.
struct InDepth {
    float depth, reach;  // [m] view depth of the middle; how far anything may be from it
    // The depth again, and how deep a body is: who is no farther apart than this can't be in front of one another.
    std::int16_t depth_code, thickness;
};
InDepth in_depth(float depth, float reach, float thickness);  // [m]

// One person, as their points are drawn. 16-bit fixed point: 32767 = 1 where nothing else is said.
struct SplatPerson : InDepth {
    // Of the pose (splat_model.h).
    const PosedChunk *first_chunk, *other_chunks;
    std::array<std::uint32_t, 4> first_visible;   // of the first chunk
    std::array<const std::uint32_t*, 4> visible;  // of all
    std::array<std::int16_t, 4> visible_share;    // sums above 1 are 1
    float alike;                                  // of the points drawn, how many as uneven ones would show alike much
    std::array<const std::int16_t*, 2> shares;    // the near ones and the far ones
    std::int16_t to_far;
    const std::int16_t* colors;
    const std::int16_t* own_lights;   // null: nothing has any
    const std::uint16_t* slots;       // of long prefixes
    const std::int16_t* slot_shares;  // of short ones, else null
    bool two_sided;                   // points that face away show their other side
    bool hides_itself;                // only what is seen of each point shows
    // Screen x, y [1/128 cell] and the way back from the middle [of `reach`], of a position of 32768, by axis.
    std::array<std::array<std::int16_t, 3>, 3> axes;
    std::array<std::int32_t, 2> middle;  // on the screen [1/128 cell]
    std::int16_t nearness;               // reach / depth: what perspective makes of the way back
    std::array<std::int16_t, 3> to_eye;  // in the model's axes
    std::array<std::int16_t, 3> to_sun;
    std::array<std::array<std::int16_t, 8>, 3> palette;  // linear, by channel, of slots 0 to slot_count
    int count;                                           // points, the last of which counts for `last_share`
    std::int16_t last_share;
    float silhouette;  // [cells]
    float total;       // [cells] that the points add up to; 0: to what `area_each` gives
    // Of few points also their colours depend on which they are: together they send this light, 1 = white.
    std::array<float, 3> mean_light;
    float area_each;              // [cells] of a point that faces the eye, with a facet and a share of 1
    std::int16_t x0, y0, x1, y1;  // [cells] what they may touch
    // A black spot under them, as dark as the shade that is too small to be drawn round (render/contact_shade.h).
    std::int16_t spot;                 // [1/8192 cell]
    std::array<std::int32_t, 2> feet;  // on the screen [1/128 cell]

    const PosedChunk& chunk(int i) const { return i == 0 ? *first_chunk : other_chunks[i - 1]; }
    const std::uint32_t* visible_of(int chunk, int look) const {
        return chunk == 0 ? &first_visible[look] : visible[look] + chunk;
    }
    Rect cells() const { return {x0, y0, x1, y1}; }
    float nearest() const { return depth - reach; }  // [m] view depth
    // They will be drawn soon; and very soon, so that this can be read.
    void prefetch() const;
    void prefetch_points() const;
};

// The same for everybody: 16384 = 1.
struct SplatLight {
    std::array<std::int16_t, 3> level, slope, sun;  // level + slope * normal.y + sun * max(0, normal . to_sun)
};

// Cells [x0, x0 + width) x [y0, y0 + height) of the screen, eight 16-bit lanes each: light of red, green and blue,
// coverage, and the way back times coverage; the rest is of no meaning. Rows are `stride` cells apart.
struct Patch {
    std::int16_t* cells = nullptr;
    std::uint64_t* used = nullptr;  // a row each: which groups of group_cells cells aren't all 0, a bit each
    int x0 = 0, y0 = 0, width = 0, height = 0, stride = 0;
};
inline constexpr int group_cells = 4;
inline constexpr int largest_patch_side = 136;  // [cells]; offsets of cells fit 16 bits

// Calls `visit` with the first lane of every group that isn't all 0, row by row.
template <typename Visit>
void for_each_used_group(const Patch& patch, Visit visit) {
    for (int y = 0; y < patch.height; ++y)
        for (std::uint64_t left = patch.used[y]; left != 0; left &= left - 1)
            visit(patch.cells + std::ptrdiff_t{8} * (patch.stride * y + group_cells * std::countr_zero(left)));
}

// Makes it all 0 again.
inline void clear(const Patch& patch) {
    for_each_used_group(patch, [](std::int16_t* first) { std::fill_n(first, 8 * group_cells, std::int16_t{0}); });
    std::fill_n(patch.used, patch.height, std::uint64_t{0});
}

// Memory for one patch at a time; all 0 between two people.
struct PatchRoom {
    Array<std::int16_t> cells = Array<std::int16_t>(std::size_t{8} * largest_patch_side * largest_patch_side);
    std::array<std::uint64_t, largest_patch_side> used{};

    // Sides in [2, largest_patch_side].
    Patch patch(int x0, int y0, int width, int height) {
        const int stride = (width + group_cells - 1) / group_cells * group_cells;
        return {cells.data(), used.data(), x0, y0, width, height, stride};
    }
};

// Adds a person up in a patch that is all 0.
void splat(const SplatPerson& person, const SplatLight& light, const Patch& patch);

}  // namespace render::native
