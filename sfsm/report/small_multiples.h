// Many runs side by side instead of over each other.
#pragma once

#include <iosfwd>

#include "sfsm/report/report.h"

namespace sfsm::report {

// A table: a row a run with its name, a small picture of its times over the first run's and its target, and its scores.
void write_small_multiples(std::ostream& out, const Report& report);

}  // namespace sfsm::report
