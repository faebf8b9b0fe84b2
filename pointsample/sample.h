// From a mesh to a point model. docs/point-models.md has the method, its figures and what was tried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "motion/character.h"
#include "pointsample/point_model.h"

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

// A mesh's vertices in one pose: motion::skin's outputs, one element a vertex.
struct PosedMesh {
    std::vector<glm::vec3> positions, normals;
};

// `count` poses spread over the clips (indices into character.clips; none: the rest pose alone), the first one first:
// what a model that is to look right in all of them is made for.
std::vector<PosedMesh> spread_poses(const motion::Character& character, std::span<const int> clips, std::size_t count);

// Points of the first pose's surface. Where other poses are given, each triangle has the points that it needs where it
// is stretched most, and a point stays if it is seen in any pose. The same bits on every run and thread count.
// Triangles without a finite area get none. `progress` gets rising fractions, 1 in the end. Memory [bytes]: about 700 a
// point and 40 a triangle. Throws std::runtime_error if no triangle has an area, or less than a thousandth of it is
// visible.
PointModel sample(const motion::Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options,
                  const std::function<void(double)>& progress = {});

}  // namespace pointsample
