// Shares of a range in sixteen bits.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>

namespace model {

inline constexpr std::uint32_t unorm_steps = 65535;

// The code nearest to `share` in [0, 1], counted in the share's own precision. Clamps, and NaN is 0.
template <std::floating_point Real>
std::uint16_t pack_unorm(Real share) {
    constexpr auto steps = static_cast<Real>(unorm_steps);
    const Real at = share * steps;
    return at > 0 ? static_cast<std::uint16_t>(std::min(at, steps) + Real(0.5)) : std::uint16_t{0};
}

}  // namespace model
