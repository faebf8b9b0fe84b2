// A way of drawing: by what device, and so as what people can be drawn, and what that is believed to cost.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "figures/expected_error.h"
#include "figures/representation.h"

namespace figures {

// What is measured to be paid for people, in times of one of their triangles. Error is exchanged for work at these.
struct Effort {
    double triangle, point;
    double single;      // somebody who is drawn alone
    double splat;       // somebody who is drawn with their block
    double update;      // of one who moves
    double resampling;  // of a cell of the crowd that is larger than a pixel
};

struct Way {
    sfsm::Drawing drawing;
    std::span<const Representation> representations;  // in the order in which they are drawn and numbered
    std::array<double, sfsm::work_kinds> pieces;      // that one of each kind of work is believed to cost (sfsm/work.h)
    float nearest;                                    // who isn't this many of their radii away is drawn exactly
    float overhang;                                   // of splats beyond their person, in square roots of a silhouette
    std::size_t most_points;                          // of a model: more are of no use, whatever its triangles cost
    ExpectedError error;
    Effort effort;
    bool has_cells;  // points are added up in cells, whatever their number; else each is as large as all others
};

// How many points a model of so many triangles can be drawn by: as many as are believed to cost what those do, at most
// most_points.
std::size_t points_worth(std::size_t triangle_count, const Way& way);

const Way& by_opengl();
const Way& natively();

}  // namespace figures
