// The columns of a front's file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/front/row.h"

namespace bench::front {

// What a column holds, and whether it is the same on every machine.
enum class Kind { name, count, error, time };

struct Column {
    std::string name;
    Kind kind;
    std::string (*write)(const Row& row, std::size_t index);
    // False: `text` is no such value.
    bool (*read)(Row& row, std::size_t index, std::string_view text);
    std::size_t index = 0;      // of a kind of work
    std::string_view expected;  // what a text must be
    bool is_younger = false;    // than files that are still read: without it the value is that of an empty row

    std::string text_of(const Row& row) const { return write(row, index); }
};

std::span<const Column> columns();

std::string header_line();            // without a line end
std::string line_of(const Row& row);  // the same
std::string machine_lines(const Machine& machine);

}  // namespace bench::front
