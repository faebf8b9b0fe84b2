// From where a crowd is looked at: what a row's `view` names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/view.h"
#include "scene/cameras.h"

namespace bench::front {

// A frame and the one before it.
struct Shot {
    std::string name;
    bool is_preset = false;
    scene::CameraPose before, now;
    std::int64_t tick = 0;  // of now

    render::View view_before(int width, int height) const { return render::make_view(before, width, height); }
    render::View view_now(int width, int height) const { return render::make_view(now, width, height); }
};

inline constexpr int moments = 8;           // of the roaming path
inline constexpr double tour_seconds = 60;  // that it takes

// The presets still, close, medium, remote and wide: `wide` sees the whole stadium from a kilometre away, and is a
// preset of this comparison only. Their cameras pan by 1.5 pixels from the frame before, which is the same on the
// screen however far people are, and shows who shimmers. Then moments of the roaming path, evenly spread over it, at
// which the camera moves as it does there; "roam-4s" is of 3.75 s. `height`: of the pictures [px]. Throws
// std::logic_error where the tour takes another time: views would have other names.
std::vector<Shot> shots(const scene::Cameras& cameras, int height);

}  // namespace bench::front
