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
        too_short,  // ends before the last field that it must have
        too_long,   // has more fields than the header, and they are not empty: it would be misread
    };
    Result split(std::string_view line);

    // Of the last row; valid as long as its line. Empty: there is no such column.
    std::string_view text(Column column) const { return texts_[slot_of_[static_cast<std::size_t>(column)]]; }
    std::size_t fields() const { return fields_; }  // of a row too short or too long: how many it has
    std::size_t needed() const { return needed_; }  // fields up to the last that it must have
    bool is_closed() const { return is_closed_; }   // a separator follows that
    void forget_last() { texts_[last_] = {}; }      // what is read of the field that ends the row

private:
    bool is_too_long(const char* at, const char* end);

    char separator_;
    std::size_t header_fields_;
    std::vector<std::uint8_t> slots_;                       // by position, up to the last that is read: in texts_
    std::array<std::uint8_t, column_count> slot_of_{};      // of columns, of which two may be one field
    std::array<std::string_view, column_count + 2> texts_;  // the first stays empty, the second is never looked at
    std::array<std::string, column_count + 2> unquoted_;    // what text() shows where quotes were doubled
    std::size_t needed_ = 0, fields_ = 0;
    std::uint8_t last_ = 0;
    bool is_closed_ = false;
};

}  // namespace sfsm
