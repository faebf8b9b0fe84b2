// What a frame may promise of every person in it: how far at most their surface is drawn from where it is, and from the
// nearest that is drawn of it. Bounds, for any tick, person and camera; render/staleness.h has means.
#pragma once

#include <span>
#include <vector>

#include "render/covering.h"
#include "render/motion_bounds.h"

namespace render {

// Of one character. A person's, in metres, are these times their scale [m / model unit].
struct ErrorBounds {
    MotionBounds motion;
    Covering covering;  // of people drawn as points
    float size = 0;     // [model units] between any two spots of a pose, so of people drawn as one splat
};

// By character: 60 ms of the built-in person on two cores, 110 of one of 13,000 vertices and 285 poses.
std::vector<ErrorBounds> measure_error_bounds(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                                              std::span<const figures::Figure> figures);

}  // namespace render
