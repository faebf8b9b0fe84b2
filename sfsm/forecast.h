// What each candidate decision would draw and lose in the frame that is about to be drawn, counted by the renderer
// before it is drawn. D changes only how people move and S only what they are drawn as, so two short lists stand for
// all pairs of a D and an S.
#pragma once

#include <span>

#include "sfsm/work.h"

namespace sfsm {

// One candidate of a list.
struct Step {
    // In the list `motion`: D [m] > 0; the first may be infinite.
    // In the list `shapes`: S [px]; 0 in the first, which is triangles.
    double setting = 0;
    Work work;           // of the list's own axis; the other counts are 0
    double loss_px = 0;  // [px] how far surfaces (motion) or outlines (shapes) are off, mean over the visible people

    bool operator==(const Step&) const = default;
};

// Neither list is empty. Each runs from no loss (everybody moves; all are triangles) to the most: along it work never
// grows and loss never shrinks. Between two steps laws interpolate: D and its counts in a straight line, S and its
// counts in a straight line of logarithms. So steps of S are about a quarter of an octave apart. Between triangles and
// the smallest S there is nothing. Valid until the next frame's.
struct Forecast {
    Work frame;  // on WorkAxis::frame, which no decision changes: people in view and what is around them; else 0
    std::span<const Step> motion;
    std::span<const Step> shapes;
};

}  // namespace sfsm
