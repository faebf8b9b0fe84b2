// The scorecard to read, for programs and for people.
#pragma once

#include <iosfwd>
#include <span>

#include "sfsm/simulate/scorecard.h"

namespace sfsm::simulate {

// {"seeds": N, "reference": LAW, "rows": [{...}, ...]}, a row a line. Shares are in [0, 1], settling and recovery in
// frames, null where that never happens or nothing asks for it. Numbers are rounded to six decimals.
void write_scorecard_json(std::ostream& out, const ScorecardOptions& options, std::span<const Row> rows);

// A table for each scenario, columns aligned. Shares and overshoot are in percent.
void write_scorecard_table(std::ostream& out, const ScorecardOptions& options, std::span<const Row> rows);

}  // namespace sfsm::simulate
