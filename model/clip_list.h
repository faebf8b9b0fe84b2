// The names of clips, for messages.
#pragma once

#include <span>
#include <string>

#include "model/clip.h"

namespace model {

// "'T-Pose', 'Idle', 'Run'", cut where it is long.
std::string list_of(std::span<const Clip> clips);

}  // namespace model
