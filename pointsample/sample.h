// From a mesh to a point model. docs/point-models.md has the method, its figures and what was tried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "model/mesh.h"
#include "pointsample/point_model.h"
#include "pointsample/posed_mesh.h"

namespace pointsample {

enum class Order {
    progressive,  // every prefix is blue noise
    even,         // one blue-noise sample of all points, more even than the progressive one; prefixes cover less evenly
    uniform,      // each point drawn by itself, area-uniform: the fastest
};

struct SampleOptions {
    std::size_t count = 4096;  // exactly as many points come back; >= 1
    std::uint64_t seed = 1;
    Order order = Order::progressive;
    bool visible_only = true;  // no points that can't be seen from outside in any of the poses
};

// Points of the first pose's surface: the same bits on every run and thread count.
//   poses      at least one. Each triangle gets the points that it needs in the pose that stretches it most; a
//              point stays if it is seen in any pose. Triangles without a finite area in the first pose get none.
//   options    every count is a sequence of its own: smaller models are its prefixes, and not those of another count.
//   progress   gets rising fractions, 1 in the end
//
//              time [us a point]   memory [bytes a point]
//   progressive        5             800 up to 200,000 points, with 16 candidates each; of more points each has fewer
//                                    candidates (3.2 million in all, at least 6 each) and takes less, down to 330
//   even              40             half as much again
//   uniform          0.2             70
// Triangles add 0.1 us and 40 bytes each. With visible_only: 100 bytes a triangle for each pose that is needed to see
// whether points are hidden, and time in proportion to the surface that is tried, hidden parts included.
// Throws std::runtime_error if no triangle has an area, if all together have one of 3.4e38 or more, or if less than a
// thousandth of it is visible.
PointModel sample(const model::Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options,
                  const std::function<void(double)>& progress = {});

}  // namespace pointsample
