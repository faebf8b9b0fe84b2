// The pieces of surface that a character's points stand for.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "figures/figure.h"

namespace render::native {

// Perpendicular to the surface at a point in a pose, outward; as long as the surface there is larger than in the mesh's
// own pose. Of a triangle without area: the point's normal.
glm::vec3 facet(const figures::Figure& figure, int pose, int point);

// How much surface each of a model's points stands for when they are drawn alone, by number of points: means are 1.
class Shares {
public:
    explicit Shares(const pointsample::PointModel& model);

    // Of the first `count` points, in [1, model.size()]; each goes to the nearest, as all the points' own surface.
    std::vector<float> of_first(std::size_t count) const;

private:
    const pointsample::PointModel& model_;
    std::vector<float> own_;  // when all are drawn
};

}  // namespace render::native
