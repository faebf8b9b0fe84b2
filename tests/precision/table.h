// What docs/precision.md lists, measured.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/precision/setting.h"

namespace precision {

// One step of the way to a pixel through one lens, by the distance from the world's origin; the worse of both ticks.
struct Line {
    std::string step, lens;
    std::array<Errors, origins.size()> at;
};
std::vector<Line> measure_lines();

// The default law, where only units or frame numbers differ.
struct LawLine {
    std::string loop;
    double off;  // [px] of S, at most
};
std::vector<LawLine> measure_law();

// Where something breaks that is doubled, or halved, until it does.
struct Limit {
    std::string what;
    double at;
    std::string unit;
    std::string meaning;  // what breaks there, and what becomes of it
};
std::vector<Limit> measure_limits();

// Rows of markdown, each "| cell | cell |".
std::string row_of(const Line& line);
std::string row_of(const LawLine& line);
std::string row_of(const Limit& limit);

}  // namespace precision
