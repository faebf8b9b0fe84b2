// The columns of a trace: one table that writes them, reads them, and says what they mean (traces/README.md shows it).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sfsm/trace.h"

namespace sfsm {

struct TraceColumn {
    std::string_view name;
    std::string_view unit;     // "ms", "m", "px"; "" where there is none
    std::string_view meaning;  // in words
    bool is_required;          // older traces may lack the others, which then keep TraceRow's default
    bool is_decided;           // part of the decision

    void (*write)(std::string& line, const TraceRow& row);  // appends the field

    // Takes the field into the row. Returns what is wrong with it, to be said behind the name: "is 'x', expected a
    // number"; empty: nothing.
    std::string (*read)(TraceRow& row, std::string_view field);
};

// In the order they are written.
std::span<const TraceColumn> trace_columns();

// Their names as a header has them, all or the required ones.
std::string all_column_names();
std::string required_column_names();

}  // namespace sfsm
