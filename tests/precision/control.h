// The default law's arithmetic. What it decides doesn't depend on the unit of time, nor on how many elements a renderer
// counts for one, as soon as it has seen times: two loops that differ in these alone must then choose the same S. What
// they differ by is rounding.
#pragma once

#include <cstdint>

#include "tests/precision/setting.h"

namespace precision {

struct Loop {
    double milliseconds = 1;    // that all times are multiplied by
    std::int64_t elements = 1;  // that all counts are multiplied by
};
// [px] Of S, over some hundred frames, from those of Loop{}.
Errors errors_of_control(const Loop& loop);

// [px] How much S changes from frame two thousand on to the last of so many, of a renderer whose frames are all alike.
double drift_of_control(std::int64_t frames);

}  // namespace precision
