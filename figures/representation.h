// The ways a person can be drawn. Whoever chooses, forecasts or draws goes through the list and knows none by name.
//
// What a person needs is their *demand*: the number of samples that their surface takes if they are to lie about S
// pixels apart,
//   demand = density * area * (pixels that a model unit covers)^2 / S^2.
// It grows without bound as S goes to 0, where only what has the artist's own shape will do.
#pragma once

#include <cstdint>
#include <span>
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
};

struct Representation {
    std::string_view name;
    bool is_mesh = false;  // triangles, however many: a frame that has anything else is of state 2
    // Of one character, from the coarsest to the finest; none if it can't be drawn so.
    std::vector<Level> (*levels)(const Figure& figure) = nullptr;
    // [px] How far the outline of a person is off who is drawn so for a given S [px] >= 0. `silhouette`: the side of a
    // square as large as theirs [px].
    double (*outline_px)(double splat_size, double silhouette) = nullptr;
};

// In the order in which they are drawn and numbered.
std::span<const Representation> representations();

}  // namespace figures
