// Where the camera is at a time: the presets, and paths from files.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/places/stadium.h"

namespace scene {

struct CameraPose {
    glm::dvec3 position{0.0};          // [m]
    glm::dvec3 target{0.0, 0.0, 1.0};  // [m] looked at; differs from position
    double fov_y = 0.9;                // [rad] vertical, in (0, pi)
};

struct CameraKey {
    double time = 0;  // [s]
    CameraPose pose;
    bool cut = false;  // the camera stays where the previous key has it, and jumps here; never of the first key
};

// Catmull-Rom through the keys between two cuts; one key = a still camera. A closed path runs from the last key's time
// back to the first. Where position and target would meet between keys, the camera looks along z.
struct CameraPath {
    std::vector<CameraKey> keys;  // ascending times, >= 1
    bool closed = false;          // repeats for ever: the last key equals the first
    CameraPose at(double time) const;
};

// "still", "close", "medium", "remote", "roam" for this stadium, or throws std::runtime_error naming the presets.
//   still   from a seat high in a corner, most of the stadium in view
//   close   a few metres from people in the stands
//   medium  from the infield towards a stand
//   remote  from above the rim, everybody in view
//   roam    a 60 s closed tour that goes close, medium and remote
CameraPath preset_path(const std::string& name, const StadiumPlan& plan);
bool is_preset(const std::string& name);

// {"closed": bool = false, "keys": [{"time_s": t, "position": [x,y,z], "target": [x,y,z], "fov_deg": 50,
//                                     "cut": bool = false}, ...]}
// Throws std::runtime_error with one line naming the file and the first broken rule.
CameraPath load_camera_path(const std::filesystem::path& path);

}  // namespace scene
