// The laws a user can name: the clairvoyant, ours, and those that ship elsewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sfsm/simulate/scorecard.h"

namespace apps {

// Those of `list`: names with commas between, or "all". Throws std::invalid_argument that names `option` and the laws
// there are.
std::vector<sfsm::simulate::Contestant> chosen_laws(const std::string& option, const std::string& list);

// The one of that name, if there is one.
std::optional<sfsm::simulate::Contestant> find_law(const std::string& name);

// Whether it has seen what the renderer costs, before the run or ahead of it: it can't decide in an open loop.
bool needs_course(const sfsm::simulate::Contestant& law);

std::string law_list();  // of all, blanks between

}  // namespace apps
