// Tables for a terminal.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace apps {

struct TableLine {
    std::string label;
    std::vector<std::string> cells;  // none: a line of its label alone
};

// Labels to the left, all else to the right, in columns of characters of UTF-8.
void write_table(std::ostream& out, const std::vector<TableLine>& lines);

// With so many digits after the point; a dash for what is no number.
std::string fixed(double value, int digits);

// Characters of UTF-8.
std::size_t width_of(std::string_view text);

}  // namespace apps
