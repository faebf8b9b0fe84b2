// Where a percentile stands among frames sorted from the slowest; figures.h says by which definition.
#pragma once

#include <cstdint>

namespace sfsm {

struct Place {
    std::int64_t rank = 1;  // from 1, the slowest
    double beyond = 0;      // of the way to the next, [0, 1)
};

// Of the slowest one in `one_in` of `frames`, which are 1 or more: 2 is the median, 100 is P1.
Place place_of(double one_in, std::int64_t frames);

double rate_of(double ms);  // [frames/s]

}  // namespace sfsm
