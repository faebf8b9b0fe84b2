#include "model/io/words.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/input_file.h"

namespace model {
namespace {

// std::from_chars knows no plus sign.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return plus ? word.substr(1) : word;
}

template <typename Number>
std::errc parse(std::string_view word, Number& number) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return end == word.data() + word.size() ? error : std::errc::invalid_argument;
}

// std::from_chars does not tell too small from too large.
bool is_tiny(std::string_view word) {
    double number = 0;
    if (parse(word, number) == std::errc()) return std::abs(number) < 1;
    return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
}

}  // namespace

double to_double(std::string_view word) {
    double number = 0;
    const std::string_view digits = without_plus(word);
    const std::errc error = parse(digits, number);
    if (error == std::errc()) return number;
    if (error == std::errc::result_out_of_range) return is_tiny(digits) ? 0 : std::numeric_limits<double>::infinity();
    if (digits.find(".#") != std::string_view::npos) return std::numeric_limits<double>::quiet_NaN();
    fail(word.empty() ? "the end of the line" : in_quotes(word), "a number");
}

double to_double_or_nan(std::string_view word) {
    try {
        return to_double(word);
    } catch (const std::runtime_error&) {
        return std::numeric_limits<double>::quiet_NaN();
    }
}

float to_float(std::string_view word) {
    float number = 0;
    const std::string_view digits = without_plus(word);
    const std::errc error = parse(digits, number);
    if (error == std::errc() && std::isfinite(number)) return number;
    if (error == std::errc::result_out_of_range && is_tiny(digits)) return 0;
    fail(word.empty() ? "the end of the line" : in_quotes(word), "a finite number");
}

std::int64_t to_integer(std::string_view word) {
    std::int64_t number = 0;
    if (parse(without_plus(word), number) != std::errc())
        fail(word.empty() ? "the end of the line" : in_quotes(word), "a whole number");
    return number;
}

}  // namespace model
