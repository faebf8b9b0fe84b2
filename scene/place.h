// A place that people are in, as a function of its own makes it for an audience: make_stadium in
// scene/places/stadium.h is one. Plain data, no GL.
#pragma once

#include "scene/cameras.h"
#include "scene/crowd.h"
#include "scene/ground.h"
#include "scene/light.h"
#include "scene/static_mesh.h"

namespace scene {

struct Place {
    StaticMesh structure;
    Ground ground;
    Light light;
    Crowd crowd;
    Cameras cameras;
};

// All of it elsewhere, by so much [m], cameras included; it looks the same from there. Up to 10,000 km its pictures are
// off by a fiftieth of a pixel at most (docs/precision.md).
void move(Place& place, const glm::dvec3& by);

}  // namespace scene
