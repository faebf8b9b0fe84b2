// What a point model is made from, as one short name: a cache keeps models by it.
#pragma once

#include <span>
#include <string>

#include "model/mesh.h"
#include "pointsample/sample.h"

namespace pointsample {

// To be raised when sample() gives other points for the same input: a test knows what it gives in each version.
inline constexpr int sampler_version = 2;

// 32 hexadecimal digits (XXH3, 128 bits) of all that sample() reads: the poses, the triangles, their looks and
// influences, the options and the sampler's version. Two inputs that differ share a key by chance alone.
std::string model_key(const model::Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options);

}  // namespace pointsample
