// The five cameras that every place has: the user's keys 1 to 5.
#pragma once

#include <array>
#include <string_view>

#include "scene/camera_path.h"

namespace scene {

struct Cameras {
    CameraPath still;   // from where somebody could be, most of the place in view
    CameraPath close;   // a few metres from people
    CameraPath medium;  // some tens of metres from most people in view
    CameraPath remote;  // from above, everybody in view
    CameraPath roam;    // a closed tour that goes close, medium and remote

    // One of preset_names, or throws std::runtime_error naming them.
    const CameraPath& named(std::string_view name) const;
};

inline constexpr std::array<std::string_view, 5> preset_names{"still", "close", "medium", "remote", "roam"};

bool is_preset(std::string_view name);

}  // namespace scene
