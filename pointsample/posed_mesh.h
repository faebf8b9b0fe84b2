// A mesh's vertices in one pose, and the poses that a model is to look right in.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "model/character.h"
#include "motion/pose_table.h"

namespace pointsample {

// motion::skin's outputs, one element a vertex.
struct PosedMesh {
    std::vector<glm::vec3> positions, normals;
};

// `count` >= 1 poses spread over the clips (indices into character.clips; none: the rest pose alone), the first clip's
// first frame first.
std::vector<PosedMesh> spread_poses(const model::Character& character, std::span<const int> clips, std::size_t count);

// A point of the surface in one pose.
struct Place {
    glm::vec3 position;  // [units]
    glm::vec3 normal;    // unit: the triangle's, turned to the side of its corners' normals; 0 if it has no area
};

Place place_of(const motion::SurfacePoint& point, std::span<const std::uint32_t> indices, const PosedMesh& pose);

// The triangle's, as in Place.
glm::vec3 face_normal(std::span<const std::uint32_t> indices, const PosedMesh& pose, std::size_t triangle);

}  // namespace pointsample
