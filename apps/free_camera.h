// A camera flown by its user.
#pragma once

#include "render/input.h"
#include "scene/camera_path.h"

namespace apps {

class FreeCamera {
public:
    explicit FreeCamera(const scene::CameraPose& start);

    // `seconds` since the last move. Stays above the ground and within a kilometre.
    void move(const render::Input& input, double seconds);

    scene::CameraPose pose() const;

    // Whether the user does anything that a preset should give way to.
    static bool steers(const render::Input& input);

private:
    glm::dvec3 forward() const;

    glm::dvec3 position_;
    double heading_, pitch_;  // [rad] heading 0 looks along +z
    double fov_y_;
};

}  // namespace apps
