#include "sfsm/number_text.h"

#include <charconv>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr std::size_t longest_number = 32;  // "-2.2250738585072014e-308" has 24 characters

template <typename T>
void append(std::string& out, T value) {
    char buffer[longest_number];
    const std::to_chars_result result = std::to_chars(buffer, buffer + longest_number, value);
    out.append(buffer, result.ptr);
}

template <typename T>
void append_real(std::string& out, T value) {
    if (std::isnan(value)) {
        out += "nan";  // a NaN's sign says nothing, and to_chars would print it
    } else {
        append(out, value);
    }
}

template <typename T>
std::optional<T> parse(std::string_view text) {
    T value{};
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
    return value;
}

}  // namespace

void append_number(std::string& out, double value) {
    append_real(out, value);
}

void append_number(std::string& out, float value) {
    append_real(out, value);
}

void append_number(std::string& out, std::int64_t value) {
    append(out, value);
}

std::string number_text(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

std::optional<double> parse_double(std::string_view text) {
    return parse<double>(text);
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    return parse<std::int64_t>(text);
}

}  // namespace sfsm
