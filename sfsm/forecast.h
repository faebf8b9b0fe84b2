// What each candidate decision would draw and lose in the frame that is about to be drawn, counted by the renderer
// before it is drawn. There are two ways to decide. By D and S: D changes only how people move and S only what they are
// drawn as, so two short lists stand for all pairs of them. Or by the one rate at which error is exchanged for work, if
// the renderer can solve its classes of people for it: a third list.
#pragma once

#include <span>

#include "sfsm/decision.h"
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

// A rate that is less than so many times the one before: what is drawn changes there at once.
inline constexpr double least_rise = 1.004;

// One candidate of the list `rates`: everybody drawn and moved as the rate has it.
struct RateStep {
    double rate = 0;  // [px / piece] > 0: Decision::rate
    // What that comes to: 2 if anybody is drawn by anything but a mesh, else 1 if anybody moves less often, else 0. D
    // is the depth from which somebody does; infinite where nobody does. S is the one at which as many points would be
    // drawn; 0 where nobody is.
    State state = State::original;
    double motion_distance = 0;
    double splat_size = 0;
    Work work;        // of the axes motion and shape; the other counts are 0
    double loss = 0;  // the frame's expected mean FLIP that is due to its people, [0, 1]

    bool operator==(const RateStep&) const = default;
};

// Neither of the lists motion and shapes is empty. Each runs from no loss (everybody moves; all are triangles) to the
// most: along it work never grows and loss never shrinks. Between two steps laws interpolate: D and its counts in a
// straight line, S and its counts in a straight line of logarithms. So steps of S are about a quarter of an octave
// apart. Between triangles and the smallest S there is nothing. Valid until the next frame's.
struct Forecast {
    Work frame;  // on WorkAxis::frame, which no decision changes: people in view and what is around them; else 0
    std::span<const Step> motion;
    std::span<const Step> shapes;
    // Empty where the renderer knows no rates. The rate rises along it, the loss never shrinks, and the work, by what
    // pieces are believed to cost (work.h), never grows. Between two steps laws interpolate: rates and counts in
    // straight lines of logarithms, losses in straight lines; counts of a kind that begins there in a straight line,
    // and of one that ends there as if it ended at 1 (rate_plans.h says why). Octaves of the rate apart at most. Two
    // whose rates rise by less than least_rise have nothing between them.
    std::span<const RateStep> rates = {};
};

}  // namespace sfsm
