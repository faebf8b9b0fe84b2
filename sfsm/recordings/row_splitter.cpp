#include "sfsm/recordings/row_splitter.h"

#include <algorithm>
#include <cstring>

#include "sfsm/text.h"

namespace sfsm {
namespace {

std::string_view between(const char* begin, const char* end) {
    return {begin, static_cast<std::size_t>(end - begin)};
}

// The field in quotes that begins at `at`, which moves to the separator behind it or to the end. Quotes that are not
// closed hold all the rest.
std::string_view quoted_field(const char*& at, const char* end, char separator, std::string& unquoted) {
    const char* const begin = ++at;
    at = std::find(at, end, '"');
    const char* const first_end = at;
    if (at == end || at + 1 == end || at[1] != '"') {
        at = std::find(at, end, separator);
        return without_blanks(between(begin, first_end));
    }
    unquoted.assign(begin, at);
    while (at != end && at + 1 != end && at[1] == '"') {
        const char* const next = std::find(at + 2, end, '"');
        unquoted.append(at + 1, next);
        at = next;
    }
    at = std::find(at, end, separator);
    return without_blanks(unquoted);
}

// The same for any field.
inline std::string_view field(const char*& at, const char* end, char separator, std::string& unquoted) {
    if (at != end && *at == '"') return quoted_field(at, end, separator, unquoted);
    const char* const begin = at;
    while (at != end && *at != separator) ++at;
    return without_blanks(between(begin, at));
}

}  // namespace

std::vector<std::string> split_fields(std::string_view line, char separator) {
    std::vector<std::string> fields;
    std::string unquoted;
    const char* at = line.data();
    const char* const end = at + line.size();
    while (true) {
        fields.emplace_back(field(at, end, separator, unquoted));
        if (at == end) return fields;
        ++at;
    }
}

RowSplitter::RowSplitter(const Header& header) : separator_(header.separator), header_fields_(header.fields) {
    constexpr std::uint8_t unread = 1;
    std::uint8_t next = unread + 1;
    for (std::size_t column = 0; column < column_count; ++column) {
        if (!header.position[column]) continue;
        const std::size_t position = *header.position[column];
        if (slots_.size() <= position) slots_.resize(position + 1, unread);
        if (slots_[position] == unread) slots_[position] = next++;
        slot_of_[column] = slots_[position];
        if (!may_be_missing(static_cast<Column>(column))) needed_ = std::max(needed_, position + 1);
    }
}

RowSplitter::Result RowSplitter::split(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (fields_ = 0; fields_ < slots_.size(); ++fields_) {
        if (fields_ > 0) {
            if (at == end) break;
            ++at;
        }
        last_ = slots_[fields_];
        texts_[last_] = field(at, end, separator_, unquoted_[last_]);
        if (fields_ + 1 == needed_) is_closed_ = at != end;
    }
    if (fields_ < needed_) return Result::too_short;
    for (std::size_t i = fields_; i < slots_.size(); ++i) texts_[slots_[i]] = {};
    if (at != end) last_ = 0;
    return is_too_long(at, end) ? Result::too_long : Result::good;
}

// Counts the fields behind the last that is read, `at` being where it ends.
bool RowSplitter::is_too_long(const char* at, const char* end) {
    if (!std::memchr(at, '"', static_cast<std::size_t>(end - at))) {
        fields_ += static_cast<std::size_t>(std::count(at, end, separator_));
        if (fields_ <= header_fields_) return false;
        fields_ -= static_cast<std::size_t>(std::count(at, end, separator_));
    }
    bool has_text = false;
    std::string unquoted;
    while (at != end) {
        ++at;
        const std::string_view text = field(at, end, separator_, unquoted);
        has_text = has_text || (++fields_ > header_fields_ && !text.empty());
    }
    return has_text;
}

}  // namespace sfsm
