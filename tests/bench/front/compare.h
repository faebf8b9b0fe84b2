// What of a front has moved since another one was kept: counts and errors, to the last digit that is written.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/front/row.h"

namespace bench::front {

// A line for each difference, in the order of `committed`: "close, native points S = 2: flip 0.01234, committed
// 0.01200"; and for each row that only one of them has. Times aren't compared, nor what OpenGL drew if its drivers are
// not the same.
std::vector<std::string> moved(const Front& committed, const Front& found);

}  // namespace bench::front
