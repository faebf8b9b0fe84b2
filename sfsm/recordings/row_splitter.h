// Rows of a table to the few fields that are read. Fields may be in quotes, with separators and doubled quotes within;
// blanks around them don't count.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/recordings/formats.h"

namespace sfsm {

std::vector<std::string> split_fields(std::string_view line, char separator);

class RowSplitter {
public:
    explicit RowSplitter(const Header& header);

    enum class Result {
        good,
        too_short,  // ends before the last field that is read
        too_long,   // has more fields than the header, and they are not empty: it would be misread
    };
    Result split(std::string_view line);

    // Of the last row; valid as long as its line. Empty: there is no such column.
    std::string_view text(Column column) const { return texts_[static_cast<std::size_t>(column)]; }
    std::size_t fields() const { return fields_; }        // of a row too short or too long: how many it has
    std::size_t needed() const { return slots_.size(); }  // fields up to the last that is read
    bool is_closed() const { return is_closed_; }         // a separator follows the last field that is read

private:
    bool is_too_long(const char* at, const char* end);

    char separator_;
    std::size_t header_fields_;
    std::vector<std::int8_t> slots_;  // by position, up to the last that is read: which column, or -1
    std::array<std::string_view, column_count> texts_;
    std::array<std::string, column_count> unquoted_;  // what text() shows where quotes were doubled
    std::size_t fields_ = 0;
    bool is_closed_ = false;
};

}  // namespace sfsm
