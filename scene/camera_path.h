// Where the camera is at a time.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace scene {

struct CameraPose {
    glm::dvec3 position{0.0};          // [m]
    glm::dvec3 target{0.0, 0.0, 1.0};  // [m] looked at; differs from position
    double fov_y = 0.9;                // [rad] vertical, in (0, pi)

    // The unit vector from `position` to `target`, however near they are.
    glm::dvec3 forward() const;
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

// {"closed": bool = false, "keys": [{"time_s": t, "position": [x,y,z], "target": [x,y,z], "fov_deg": 50,
//                                     "cut": bool = false}, ...]}
// Throws std::runtime_error with one line naming the file and the first broken rule.
CameraPath load_camera_path(const std::filesystem::path& path);

}  // namespace scene
