#include "apps/table.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace apps {

void write_table(std::ostream& out, const std::vector<TableLine>& lines) {
    constexpr std::size_t narrowest = 8;
    std::size_t label_width = 0;
    std::vector<std::size_t> widths;
    for (const TableLine& line : lines) {
        label_width = std::max(label_width, width_of(line.label));
        widths.resize(std::max(widths.size(), line.cells.size()), narrowest);
        for (std::size_t i = 0; i < line.cells.size(); ++i) widths[i] = std::max(widths[i], width_of(line.cells[i]));
    }
    const auto blanks = [](std::size_t count) { return std::string(count, ' '); };
    for (const TableLine& line : lines) {
        out << line.label;
        if (!line.cells.empty()) out << blanks(label_width - width_of(line.label));
        for (std::size_t i = 0; i < line.cells.size(); ++i)
            out << blanks(2 + widths[i] - width_of(line.cells[i])) << line.cells[i];
        out << '\n';
    }
}

std::string fixed(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << value;
    return text.str();
}

std::size_t width_of(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace apps
