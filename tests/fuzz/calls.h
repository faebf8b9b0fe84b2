// Arbitrary bytes, read as calls into a law: hostile numbers, forecasts and orders of calls come up often.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/controller.h"

namespace sfsm::fuzz {

struct Outcome {
    std::string broken;      // the first rule that a decision broke; empty: none
    std::uint64_t hash = 0;  // of the bits of all decisions
};

// Rules: S is in [0, 32] px and over 0 in state 2 alone; D is over 0, and in states 1 and 2 at most L; the status has
// the same decision, and its numbers are finite.
enum class Forecasts { none, hostile };
Outcome call(Controller& law, std::span<const std::uint8_t> bytes, Forecasts forecasts);

// Laws and rivals.
std::vector<std::string_view> all_names();
std::unique_ptr<Controller> make_any(std::string_view name);

}  // namespace sfsm::fuzz
