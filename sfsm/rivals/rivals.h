// Frame-time laws that ship elsewhere, rewritten from their published facts as baselines: one small file a law.
// docs/rivals.md says whose they are, how each knob is mapped, and what of them is a model of ours.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sfsm/controller.h"

namespace sfsm {

// In the order they are listed to a user.
std::span<const std::string_view> rival_names();

// Throws std::invalid_argument naming the rivals there are.
std::unique_ptr<Controller> make_rival(std::string_view name);

}  // namespace sfsm
