// Text from files that may hold anything: compared, and made fit for a message.
#pragma once

#include <string>
#include <string_view>

namespace sfsm {

// Equal but for the case of ASCII letters.
bool same_name(std::string_view a, std::string_view b);

std::string_view without_blanks(std::string_view text);  // around it

// In quotes, on one line, at most about 60 bytes: control characters become '?', what is too long ends in "...".
std::string shown(std::string_view text);

}  // namespace sfsm
