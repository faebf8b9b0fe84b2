#include "model/io/data_uri.h"

#include <algorithm>
#include <cstdint>

#include "model/input_file.h"

namespace model {
namespace {

constexpr std::string_view scheme = "data:";
constexpr std::string_view base64_mark = ";base64";

bool equal_but_for_case(std::string_view text, std::string_view lower) {
    return std::ranges::equal(text, lower, [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

// -1: no digit of base64, nor of its variant for URLs.
int digit_of_base64(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

std::vector<unsigned char> from_base64(std::string_view text) {
    std::vector<unsigned char> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        if (c == '=' || c == ' ' || (c >= '\t' && c <= '\r')) continue;
        const int digit = digit_of_base64(c);
        if (digit < 0) fail("a data URI with " + in_quotes({&c, 1}) + " in it", "base64");
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<unsigned char>(bits >> held));
    }
    return bytes;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    return equal_but_for_case(uri.substr(0, scheme.size()), scheme);
}

std::vector<unsigned char> data_of_uri(std::string_view uri) {
    uri.remove_prefix(scheme.size());
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) fail("a data URI without a comma", "one before its data");
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    if (head.size() >= base64_mark.size() &&
        equal_but_for_case(head.substr(head.size() - base64_mark.size()), base64_mark))
        return from_base64(data);
    const std::string bytes = percent_decoded(data);
    return {bytes.begin(), bytes.end()};
}

std::string percent_decoded(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        out += low < 0 ? text[i] : static_cast<char>(high * 16 + low);
        if (low >= 0) i += 2;
    }
    return out;
}

}  // namespace model
