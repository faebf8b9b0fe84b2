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

// Points of the first pose's surface; at least one pose. Where other poses are given, each triangle has the points that
// it needs where it is stretched most, and a point stays if it is seen in any pose. The same bits on every run and
// thread count. Every count is a sequence of its own: smaller models are its prefixes, and not those of another count.
// Triangles without a finite area in the first pose get none. `progress` gets rising fractions, 1 in the end.
//
// Time: progressive 5 microseconds a point, even 40, uniform 0.2; a ten-thousandth of a second per thousand triangles;
// and what the hidden test takes, in proportion to the surface that has to be tried for what is visible of it. Memory
// [bytes], progressive: 800 a point up to 200,000 points, which have 16 candidates each; more share 3.2 million
// candidates until they have 6 each, 330 a point. Even: half as much again. Uniform: 70 a point. With it 40 a triangle
// and, if visible_only, 100 a triangle for each pose that is needed to see whether points are hidden.
// Throws std::runtime_error if no triangle has an area, if all together have one of 3.4e38 or more, or if less than a
// thousandth of it is visible.
PointModel sample(const model::Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options,
                  const std::function<void(double)>& progress = {});

}  // namespace pointsample
