// The parts of a page that tell of recordings, as HTML.
#pragma once

#include <iosfwd>

#include "sfsm/report/report.h"

namespace sfsm::report {

// A group of figures after the other; of one recording as tiles, of several as a table with a column each.
void write_numbers(std::ostream& out, const Report& report);

// A table for each comparison.
void write_comparisons(std::ostream& out, const Report& report);

// Of each recording what it says of the game and the machine, and how it was read.
void write_origins(std::ostream& out, const Report& report);

// Names with their values; nothing where there are none.
void write_facts(std::ostream& out, const std::vector<std::pair<std::string, std::string>>& facts);

// A figure for each recording with CPU or GPU times, for the script to draw into.
void write_busy_figures(std::ostream& out, const Report& report);

// Of each recording how many stutters had which cause, and the longest.
void write_stutters(std::ostream& out, const Report& report);

// "<i class=chip ...>" in the colour of the run or recording at this place.
std::string chip(std::size_t place);

}  // namespace sfsm::report
