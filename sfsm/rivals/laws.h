// The rivals' makers, one a file.
#pragma once

#include <memory>

#include "sfsm/controller.h"

namespace sfsm {

std::unique_ptr<Controller> make_darkplaces();
std::unique_ptr<Controller> make_drei();
std::unique_ptr<Controller> make_filament();
std::unique_ptr<Controller> make_hdrp();
std::unique_ptr<Controller> make_intel();
std::unique_ptr<Controller> make_minetest();
std::unique_ptr<Controller> make_robust_mpc();
std::unique_ptr<Controller> make_second_life();
std::unique_ptr<Controller> make_unity_adaptive();
std::unique_ptr<Controller> make_unity_sample();
std::unique_ptr<Controller> make_unreal_like();
std::unique_ptr<Controller> make_valve();
std::unique_ptr<Controller> make_woof();

}  // namespace sfsm
