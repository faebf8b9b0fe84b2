// From a clip and a time to matrices, and from matrices to the skinned surface. Reference-quality code:
// it bakes the pose table and the tests, never the frame.
#pragma once

#include <span>
#include <vector>

#include "model/character.h"

namespace motion {

// The animated state of a skeleton at one time.
struct Pose {
    std::vector<glm::mat4> world;      // one a node
    std::vector<glm::mat4> palette;    // one a palette entry
    std::vector<float> morph_weights;  // one a model::Mesh::morphs element
};

// The rest pose of the file.
void evaluate_rest(const model::Character& character, Pose& out);

// The pose of `clip` at `time` [s], clamped to the clip's keys. Quaternions take the shorter arc.
void evaluate(const model::Character& character, const model::Clip& clip, double time, Pose& out);

// One pose, as a clip of that name without duration: each channel at its mean over the clip's time.
model::Clip mean_of(const model::Clip& clip);

// Linear-blend skinning of every vertex: positions and unit normals (transformed by the adjugate's rotation
// part, so that mirrored and unevenly scaled joints keep outward normals). Outputs are resized.
void skin(const model::Mesh& mesh, const Pose& pose, std::vector<glm::vec3>& positions,
          std::vector<glm::vec3>& normals);

struct Bounds {
    glm::vec3 min{0.0f}, max{0.0f};
    glm::vec3 size() const { return max - min; }
    glm::vec3 center() const { return 0.5f * (min + max); }
};

// The tight box of the finite ones among `positions`; without any, the origin.
Bounds bounds_of(std::span<const glm::vec3> positions);

}  // namespace motion
