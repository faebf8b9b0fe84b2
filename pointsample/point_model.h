// A character as points: a progressive sequence in which every prefix covers the whole surface evenly, so that a
// person is drawn by the first n of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "motion/character.h"
#include "motion/pose_table.h"

namespace pointsample {

// Structure of arrays, one element a point.
struct PointModel {
    std::vector<motion::SurfacePoint> surface;  // where on the mesh
    std::vector<glm::vec3> positions;           // of the pose they were sampled in
    std::vector<glm::vec3> normals;             // unit; interpolated from the vertices
    std::vector<glm::u8vec4> colors;            // vertex colour x texture, sRGB-encoded
    std::vector<motion::Tint> tints;
    std::vector<glm::u16vec4> joints;           // the four heaviest of the triangle's
    std::vector<glm::vec4> weights;             // >= 0, sum 1
    float area = 0;                             // of all triangles, hidden ones too [units^2]
    std::size_t hidden_removed = 0;             // candidates that no ray from outside could see

    std::size_t size() const { return positions.size(); }
};

struct SampleOptions {
    std::size_t count = 4096;   // exactly as many points come back; >= 1
    std::uint64_t seed = 1;
    bool visible_only = true;   // drop points that cannot be seen from outside, and put others in their place
};

// Area-uniform points on the mesh in the given posed geometry (motion::skin's outputs). The same bits on every run and
// thread count; n points are the first n of any larger number. Triangles without a finite area get none. `progress`
// gets rising fractions, 1 in the end. Throws std::runtime_error if no triangle has an area, or less than a thousandth
// of it is visible.
PointModel sample(const motion::Mesh& mesh, const std::vector<glm::vec3>& positions,
                  const std::vector<glm::vec3>& normals, const SampleOptions& options,
                  const std::function<void(double)>& progress = {});

}  // namespace pointsample
