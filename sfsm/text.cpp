#include "sfsm/text.h"

#include <algorithm>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

bool continues_character(char c) {  // UTF-8
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

}  // namespace

bool same_name(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view without_blanks(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string shown(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::size_t length = text.size();
    if (length > longest) {
        length = longest;
        while (length > 0 && continues_character(text[length])) --length;
    }
    std::string line = "'" + std::string(text.substr(0, length));
    std::replace_if(line.begin(), line.end(), is_control, '?');
    return line + (length < text.size() ? "...'" : "'");
}

}  // namespace sfsm
