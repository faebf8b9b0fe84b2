// Which points of a moving surface can be seen from outside in any of its poses.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/mesh.h"
#include "pointsample/surface.h"
#include "pointsample/visibility.h"

namespace pointsample {

class HiddenTest {
public:
    // Keeps references. `mesh`: whose triangles the surface's are. Its materials say which points are two-sided, and
    // where one sees through it: by cutouts, and through the backs of outline hulls, which are larger than what they
    // are around and face inward.
    HiddenTest(const Surface& surface, const model::Mesh& mesh);
    // Nothing is to be seen through, and all are two-sided or none.
    HiddenTest(const Surface& surface, bool two_sided);

    // One element a point: 0 if it is hidden in every pose. Fastest where neighbours follow one another. A later pose
    // is looked at only for points that are hidden in all before it; its ray-tracing scene is built when it is first
    // needed, and kept. In parallel; the same on any number of threads.
    std::vector<char> visible(std::span<const motion::SurfacePoint> points);

private:
    std::vector<char> look(std::size_t pose, std::span<const motion::SurfacePoint> points,
                           std::span<const std::size_t> chosen);

    const Surface& surface_;
    const model::Mesh* mesh_ = nullptr;  // null: of one kind
    bool two_sided_ = false;
    InTheWay in_the_way_;
    std::vector<std::unique_ptr<Visibility>> scenes_;  // one a pose
};

}  // namespace pointsample
