// Surfaces that samplers are measured on, made by code; the same on every run.
#pragma once

#include "model/mesh.h"

namespace tests {

model::Mesh make_ball();             // unit sphere, 20,480 triangles
model::Mesh make_plane();            // unit square, two triangles: open
model::Mesh make_huge_among_tiny();  // one triangle of area 1 beside ten thousand that make up a unit square: open
model::Mesh make_cube_and_plate();   // unit cube; apart from it a closed plate of thickness 0.002 and the same area
model::Mesh make_bumpy();            // closed, 5,780 triangles
model::Mesh make_scan();             // closed, 87,120 irregular triangles

}  // namespace tests
