// What the default law chose while it could set D and S alone, as it was recorded: drawn again beside what it chooses
// now.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sfsm/decision.h"

namespace bench::front {

inline constexpr std::string_view law_before_rates = "before rates";  // Row::law

// The default law where it can set D and S alone: a forecast's rates are kept from it.
inline constexpr std::string_view law_by_knobs = "predictive by D and S";  // Row::law

struct Recorded {
    std::int64_t people = 0;
    std::string view;
    double target_ms = 0;
    sfsm::Decision decision;
};

// Of the kept front that was measured last before rates. Read when first asked for; throws what from_csv throws.
std::span<const Recorded> choices_before_rates();

}  // namespace bench::front
