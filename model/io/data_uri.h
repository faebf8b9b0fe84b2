// Bytes and names in URIs (RFC 2397, RFC 3986). Internal to the loaders.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace model {

bool is_data_uri(std::string_view uri);

// What a data URI holds, in base64 or percent-encoded; its type and other parameters mean nothing. Throws
// std::runtime_error, "found ...; expected ...".
std::vector<unsigned char> data_of_uri(std::string_view uri);

// With %20 and the like as the bytes that they stand for; others stay.
std::string percent_decoded(std::string_view text);

}  // namespace model
