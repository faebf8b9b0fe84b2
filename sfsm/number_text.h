// Numbers to text and back to the same bits, whatever the locale of the program or of a stream.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sfsm {

// The shortest decimal text that reads back to the same bits of its type; "inf", "-inf", "nan".
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::int64_t value);
std::string number_text(double value);

// The number that all of `text` spells, also "inf" and "nan"; nothing for any other text (blanks and '+' included).
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace sfsm
