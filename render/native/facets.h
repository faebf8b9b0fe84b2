// The pieces of surface that a character's points stand for.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "figures/figure.h"

namespace render::native {

// Perpendicular to the surface at each point in a pose, outward; as long as the surface there is larger than in the
// mesh's own pose. Of a triangle without area: the point's normal.
class Facets {
public:
    // The figure must outlive it.
    explicit Facets(const figures::Figure& figure);

    std::vector<glm::vec3> in_pose(int pose) const;  // a point each

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;
        float rest;  // twice its area in the mesh's own pose
    };
    const figures::Figure& figure_;
    std::vector<Triangle> triangles_;         // those with points on them
    std::vector<std::uint32_t> triangle_of_;  // a point's, among them
};

// How much surface each of a model's points stands for when only the first `counts[i]` are drawn: means are 1. Each of
// the others goes to the nearest that is drawn, as all the points' own surface. Counts rise, from 1 or more to at most
// model.size().
std::vector<std::vector<float>> shares_of_prefixes(const pointsample::PointModel& model, std::span<const int> counts);

}  // namespace render::native
