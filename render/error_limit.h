// How far on the screen at most surfaces are off that are drawn some way from where they are, and what a limit of that
// leaves people.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/view.h"

namespace render {

class ErrorLimit {
public:
    ErrorLimit() = default;
    // `most` [px] > 0; infinite for none.
    ErrorLimit(const View& view, double most)
        : in_middle_(view.pixels_per_metre(1)),
          pixels_(static_cast<double>(in_middle_) *
                  std::hypot(1.0, static_cast<double>(view.tan_half_x), static_cast<double>(view.tan_half_y))),
          most_(most) {}

    bool is_set() const { return std::isfinite(most_); }

    // [px] At most, what is off by so much [m] of somebody who reaches so far [m] from their middle at a view depth.
    // Aside of the picture's middle it is more than in it.
    double pixels(float off, float reach, float depth) const {
        return pixels_ * static_cast<double>(off) / static_cast<double>(std::max(depth - reach - off, near_plane));
    }
    // [m] How far off they may be: pixels() is at most the limit then.
    float off(float reach, float depth) const {
        if (!is_set()) return std::numeric_limits<float>::infinity();
        return std::max(beyond(reach, depth),
                        static_cast<float>(rounding * most_ * static_cast<double>(near_plane) / pixels_));
    }
    // [model units] The same of somebody of whom a model unit covers so many pixels; none who may be at the near plane,
    // as how far that is in model units is not known.
    float off_of(float reach, double scale) const {
        if (!is_set()) return std::numeric_limits<float>::infinity();
        return std::max(beyond(reach, in_middle_ / static_cast<float>(scale)), 0.0f);
    }

private:
    static constexpr double rounding = 1 - 1e-5;

    // What may be off of who is beyond the near plane, in the unit of reach and depth.
    float beyond(float reach, float depth) const {
        return static_cast<float>(rounding * most_ * static_cast<double>(depth - reach) / (pixels_ + most_));
    }

    float in_middle_ = 0;  // [px] that a metre covers at a depth of one
    double pixels_ = 0;    // the same in the corner of the picture
    double most_ = std::numeric_limits<double>::infinity();
};

}  // namespace render
