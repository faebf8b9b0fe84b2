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

// Rows that say nothing of any recording are left out, and so are groups without rows.
std::vector<NumberGroup> numbers_of(std::span<const ReportedRecording> recordings);

}  // namespace sfsm::report
