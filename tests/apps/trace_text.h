// A trace as its text has it, whatever the columns are.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace tests {

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// The trace's rows, split at commas; the first is the header.
inline std::vector<std::vector<std::string>> table_of(const std::string& trace) {
    std::vector<std::vector<std::string>> table;
    for (const std::string& line : lines_of(trace)) {
        if (line.starts_with("#")) continue;
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
        table.push_back(cells);
    }
    return table;
}

inline std::vector<std::string> column(const std::string& trace, const std::string& name) {
    const auto table = table_of(trace);
    const auto found = std::find(table.at(0).begin(), table.at(0).end(), name);
    if (found == table[0].end()) return {};
    std::vector<std::string> cells;
    for (std::size_t row = 1; row < table.size(); ++row)
        cells.push_back(table[row].at(static_cast<std::size_t>(found - table[0].begin())));
    return cells;
}

}  // namespace tests
