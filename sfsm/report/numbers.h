// A recording's figures as people read them: in rows, with the words that say what each is.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sfsm/report/report.h"

namespace sfsm::report {

// A figure of each recording, and what it means; `meaning` may be empty.
struct NumberRow {
    std::string name, unit, meaning;
    std::vector<double> values;  // NaN: none
    int digits = 1;
};

struct NumberGroup {
    std::string name;
    std::vector<NumberRow> rows;
};

// [ms]; NaN where recordings have different targets, or one that changes, or none.
double common_target(std::span<const ReportedRecording> recordings);

// Of any recording.
bool has_stutters(const Report& report);

// Rows that say nothing of any recording are left out, and so are groups without rows.
std::vector<NumberGroup> numbers_of(std::span<const ReportedRecording> recordings);

// A change of a difference, or an end of its interval: "+2.1 %", of shares "+0.50 points", hundredths of all; with so
// many digits that what isn't 0 isn't written as 0. Not to be told: a dash.
std::string change_text(const Difference& difference, double change);
std::string interval_text(const Difference& difference);  // "+2.1 to +4.0 %"

}  // namespace sfsm::report
