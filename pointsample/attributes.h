// What a surface point looks like and how it moves, from the corners of its triangle.
#pragma once

#include "model/mesh.h"
#include "pointsample/point_model.h"
#include "pointsample/posed_mesh.h"

namespace pointsample {

// Fills positions, normals, colours, slots, joints and weights of the model's surface points: positions and normals are
// the pose's, colours are texture times vertex colour in linear light, what shines by itself is the material's, a slot
// is the nearest corner's, and influences are the four heaviest of the corners' together. In parallel; each point
// depends on itself alone.
void describe(const model::Mesh& mesh, const PosedMesh& pose, PointModel& model);

}  // namespace pointsample
