// Which times, targets and ranges a law may believe at all.
#pragma once

#include <cmath>

namespace sfsm {

// Finite and over 0.
inline bool is_usable(double value) {
    return std::isfinite(value) && value > 0;
}

}  // namespace sfsm
