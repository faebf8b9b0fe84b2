#include "sfsm/report/markup.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <ostream>

namespace sfsm::report {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

// The bytes of the character that begins `text`; 0: none begins there, or one that XML does not allow.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    std::uint32_t code = first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};  // shorter would have done
    const bool is_surrogate = code >= 0xD800 && code < 0xE000;
    const bool is_allowed = code != 0xFFFE && code != 0xFFFF && code < 0x110000;
    return code >= least[length] && !is_surrogate && is_allowed ? length : 0;
}

// Calls add(character) with each character's bytes.
template <class Add>
void for_each_character(std::string_view text, Add add) {
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        add(length == 0 ? replacement : text.substr(0, length));
        text.remove_prefix(length == 0 ? 1 : length);
    }
}

std::string_view entity(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        default:
            return {};
    }
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for_each_character(text, [&](std::string_view character) {
        const std::string_view name = entity(character[0]);
        out += name.empty() ? character : name;
    });
    return out;
}

std::string json_string(std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string out = "\"";
    for_each_character(text, [&](std::string_view character) {
        const auto code = static_cast<unsigned char>(character[0]);
        if (code < 0x20 || !entity(character[0]).empty() || code == '\\') {
            out.append("\\u00").append({hex[code >> 4], hex[code & 15]});
        } else {
            out += character;
        }
    });
    return out += '"';
}

std::string shortened(std::string_view text, std::size_t most) {
    std::string out;
    std::size_t count = 0;
    for_each_character(text, [&](std::string_view character) {
        if (++count <= most) out += character;
    });
    return count <= most ? out : out + "\u2026";
}

std::string figure(double value, int digits) {
    if (std::isnan(value)) return "\u2013";
    if (std::isinf(value)) return value > 0 ? "\u221E" : "\u2212\u221E";
    constexpr double longest = 1e7;
    char text[64];
    const bool is_long = std::abs(value) >= longest;
    const auto end =
        std::to_chars(text, text + sizeof text, value,
                      is_long ? std::chars_format::scientific : std::chars_format::fixed, is_long ? 2 : digits);
    const std::string_view shown(text, end.ptr);
    const bool is_zero = shown.find_first_of("123456789") == shown.npos;
    return std::string(is_zero && shown[0] == '-' ? shown.substr(1) : shown);
}

std::string pixels(double value) {
    std::string text = figure(value, 2);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

void fill_page(std::ostream& out, std::string_view page, const std::function<void(std::string_view name)>& write_part) {
    for (std::size_t begin; (begin = page.find("{{")) != page.npos;) {
        const std::size_t end = page.find("}}", begin);
        out << page.substr(0, begin);
        write_part(page.substr(begin + 2, end - begin - 2));
        page.remove_prefix(end + 2);
    }
    out << page;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) out += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

}  // namespace sfsm::report
