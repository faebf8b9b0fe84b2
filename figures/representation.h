// What a way to draw a person is. Whoever chooses, forecasts or draws goes through a list of them (figures/way.h) and
// knows none by name.
//
// What a person needs is their *demand*: the number of samples that their surface takes if they are to lie about S
// pixels apart,
//   demand = density * area * (pixels that a model unit covers)^2 / S^2.
// It grows without bound as S goes to 0, where only what has the artist's own shape will do.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "figures/figure.h"
#include "sfsm/work.h"

namespace figures {

// One fineness of a representation of one character.
struct Level {
    sfsm::Work work;  // to draw one person so, without what their motion costs
    float reach = 0;  // the greatest demand that it serves; infinite for the artist's own shape
    // What drawers are handed: which of the representation's elements (corners of triangles, points) are drawn.
    std::uint32_t first = 0, count = 0;
    bool by_ones = false;  // points, of which any number up to `count` can be drawn, the last in part
};

// What of a level is drawn of somebody.
struct Part {
    std::uint32_t count = 0;  // of its elements
    float last_share = 1;     // of the last of them, (0, 1]
    sfsm::Work work;
};

// Of fewer points none may show.
inline constexpr std::uint32_t fewest_points = 4;

// For a demand >= 0: all of the level or, where it is drawn by ones, as many as are asked for, but at least
// fewest_points and at most all.
inline Part part_of(const Level& level, float demand) {
    if (!level.by_ones) return {level.count, 1.0f, level.work};
    const auto samples =
        std::clamp(demand, static_cast<float>(std::min(fewest_points, level.count)), static_cast<float>(level.count));
    Part part{static_cast<std::uint32_t>(std::ceil(samples)), 1.0f, level.work};
    part.last_share = samples - static_cast<float>(part.count - 1);
    part.work[sfsm::WorkKind::point] = part.count;
    return part;
}

struct Representation {
    std::string_view name;
    bool is_mesh = false;  // triangles, however many: a frame that has anything else is of state 2
    // Of one character, from the coarsest to the finest; none if it can't be drawn so.
    std::vector<Level> (*levels)(const Figure& figure) = nullptr;
    // [px] How far the outline of a person is off who is drawn so for a given S [px] >= 0. `silhouette`: the side of a
    // square as large as theirs [px].
    double (*outline_px)(double splat_size, double silhouette) = nullptr;
    bool is_by_block = false;  // whole blocks of the crowd are drawn so, and nobody alone
};

}  // namespace figures
