// How far at most any piece of a person's surface is from the nearest point that is drawn of them, if they are drawn as
// the first points of their model: what pointsample::Coverage measures on some poses and visible spots, as a bound for
// all of the surface in every pose of a PoseTable.
#pragma once

#include <cstdint>
#include <vector>

#include "figures/figure.h"

namespace render {

class Covering {
public:
    // Of a figure whose people have no points.
    Covering() = default;

    // Needs its mesh and poses. 20 to 70 ms of a few thousand points, on two cores.
    explicit Covering(const figures::Figure& figure);

    // [model units] Of the first `count` points of PoseTable::points; all of them if there are fewer. Never rises with
    // `count`; infinite for none.
    float radius(std::uint32_t count) const;

private:
    std::uint32_t point_count_ = 0;
    std::vector<float> radii_;  // by rung (covering.cpp); behind the last comes that of all points
};

}  // namespace render
