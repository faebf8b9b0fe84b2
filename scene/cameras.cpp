#include "scene/cameras.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace scene {

const CameraPath& Cameras::named(std::string_view name) const {
    const CameraPath* const paths[] = {&still, &close, &medium, &remote, &roam};
    const auto found = std::find(preset_names.begin(), preset_names.end(), name);
    if (found != preset_names.end()) return *paths[found - preset_names.begin()];
    std::string known;
    for (const std::string_view preset : preset_names) known += (known.empty() ? "" : ", ") + std::string(preset);
    throw std::runtime_error("no camera '" + std::string(name) + "': expected one of " + known);
}

bool is_preset(std::string_view name) {
    return std::find(preset_names.begin(), preset_names.end(), name) != preset_names.end();
}

}  // namespace scene
