// A character as points: surface points in an order in which any first part of them is a sample of the whole surface,
// so that a person is drawn by the first n of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "model/mesh.h"
#include "motion/pose_table.h"

namespace pointsample {

// How well the first `points` points cover the surface: in no pose that the model was made for is any visible spot of
// it farther than `radius` [units] from the nearest of them. A point on the other side of a thin sheet is taken for
// twice as far.
struct Coverage {
    std::uint32_t points = 0;
    float radius = 0;
};

// Structure of arrays, one element a point, but for coverage.
struct PointModel {
    std::vector<motion::SurfacePoint> surface;  // where on the mesh
    glm::dvec3 origin{0.0};                     // the mesh's, that positions are relative to [units]
    std::vector<glm::vec3> positions;           // of the pose they are given in
    std::vector<glm::vec3> normals;             // unit; interpolated from the vertices
    std::vector<glm::u8vec4> colors;            // vertex colour x texture, sRGB-encoded
    std::vector<model::Slot> slots;
    // Seen in any light and shade: what a point emits, sRGB-encoded, and in alpha the share of its colour, 255 = all.
    // None if no point has any.
    std::vector<glm::u8vec4> own_lights;
    std::vector<glm::u16vec4> joints;  // the four heaviest of the triangle's
    std::vector<glm::vec4> weights;    // >= 0, sum 1
    // [units] From each point to the nearest before it, in the pose in which the surface there is stretched most; twice
    // as far where faces oppose. Infinite for the first, and never rises. In a uniform model not measured but expected:
    // sqrt(area / i) / 2 at point i.
    std::vector<float> spacing;
    // By rising points (1, 2, 3, 4, 6, 8, 12 ...), the last of all points; the radius never rises. Measured
    // (coverage.h).
    std::vector<Coverage> coverage;
    float area = 0;                  // of all triangles, hidden ones too, without cutouts [units^2]
    std::size_t hidden_removed = 0;  // so many more the whole surface would have: those that can't be seen from outside

    std::size_t size() const { return positions.size(); }

    // The fewest points that leave no hole in any pose; size() + 1 if all together leave one. Needs `coverage`, between
    // whose entries the radius is taken to fall as a power.
    //   pixels_per_unit  [px] how long a unit is: h / height for a person of h pixels
    //   splat_px         [px] side of the square that a point is drawn as
    std::size_t hole_free_points(float pixels_per_unit, float splat_px) const;
};

}  // namespace pointsample
