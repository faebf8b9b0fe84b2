// Normal numbers of a seeded engine: Box and Muller's, the same on every platform.
#pragma once

#include <cmath>
#include <random>

#include "tests/sfsm/simulation.h"

namespace sfsm {

// Of mean 0 and variance 1.
inline double normal(std::mt19937_64& random) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(random)));
    return radius * std::cos(6.283185307179586 * uniform(random));
}

}  // namespace sfsm
