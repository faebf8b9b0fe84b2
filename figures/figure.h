// A character as those see it who choose how to draw its people and those who draw them. It owns nothing.
#pragma once

#include "model/mesh.h"
#include "motion/pose_table.h"
#include "pointsample/point_model.h"

namespace figures {

struct Figure {
    const model::Mesh* mesh = nullptr;
    const motion::PoseTable* poses = nullptr;         // of that mesh and of the model's points
    const pointsample::PointModel* points = nullptr;  // only drawers need it
};

}  // namespace figures
