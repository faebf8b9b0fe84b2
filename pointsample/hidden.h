// Which points of a moving surface can be seen from outside in any of its poses.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pointsample/surface.h"
#include "pointsample/visibility.h"

namespace pointsample {

class HiddenTest {
public:
    // Keeps a reference.
    HiddenTest(const Surface& surface, bool two_sided);

    // One element a point: 0 if it is hidden in every pose. Fastest where neighbours follow one another. A later pose
    // is looked at only for points that are hidden in all before it; its ray-tracing scene is built when it is first
    // needed, and kept. In parallel; the same on any number of threads.
    std::vector<char> visible(std::span<const motion::SurfacePoint> points);

private:
    const Surface& surface_;
    bool two_sided_;
    std::vector<std::unique_ptr<Visibility>> scenes_;  // one a pose
};

}  // namespace pointsample
