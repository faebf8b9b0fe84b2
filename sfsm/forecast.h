// What each candidate decision would cost in the frame that is about to be drawn, counted by the renderer before it is
// drawn. Motion and splats are priced apart, so two short lists stand for all their pairs.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace sfsm {

// One distance D, and what it would make of the motion. Losses are means over the visible people.
struct MotionStep {
    double distance = std::numeric_limits<double>::infinity();  // D [m]
    std::int64_t updates = 0;                                   // people that would move
    double loss_px = 0;                                         // how far surfaces are from where they should be [px]

    bool operator==(const MotionStep&) const = default;
};

// One splat size S, and what it would make of the shapes.
struct SplatStep {
    double size = 0;             // S [px]; 0: triangles
    std::int64_t triangles = 0;  // of people
    std::int64_t points = 0;
    double loss_px = 0;  // how far outlines are from where they should be [px]

    bool operator==(const SplatStep&) const = default;
};

// The lists run from no loss (everybody moves; all triangles) to the most, and none of them is empty. Along each, work
// never grows and loss never shrinks. Splat sizes are about a quarter of an octave apart: what lies between two steps
// may be interpolated (logarithms of counts over the logarithm of size). Valid until the next frame's.
struct Forecast {
    std::int64_t people = 0;  // visible
    std::span<const MotionStep> motion;
    std::span<const SplatStep> splats;
};

}  // namespace sfsm
