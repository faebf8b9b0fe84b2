// The laws a user can name: the clairvoyant, ours, and those that ship elsewhere.
#pragma once

#include <string>
#include <vector>

#include "sfsm/simulate/scorecard.h"

namespace apps {

// Those of `list`: names with commas between, or "all". Throws std::invalid_argument that names `option` and the laws
// there are.
std::vector<sfsm::simulate::Contestant> chosen_laws(const std::string& option, const std::string& list);

}  // namespace apps
