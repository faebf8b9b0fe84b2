// A mesh's materials as its readers list them, each once. Internal to the loaders.
#pragma once

#include <cstdint>
#include <vector>

#include "model/material.h"

namespace model {

// The number of `material` among `materials`, where it is put if it is new. Throws std::runtime_error beyond 65,536.
std::uint16_t number_of(const Material& material, std::vector<Material>& materials);

}  // namespace model
