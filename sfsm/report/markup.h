// Text and numbers as HTML and SVG take them.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace sfsm::report {

// Safe as text and as an attribute's value between double quotes, in HTML and in XML. What is no UTF-8 or no character
// XML allows becomes U+FFFD.
std::string escaped(std::string_view text);

// A JSON string with its quotes, safe inside a <script> of HTML; cleaned as above.
std::string json_string(std::string_view text);

// The text's first `most` characters, an ellipsis for the rest.
std::string shortened(std::string_view text, std::size_t most);

// With `digits` after the point; rounded to three figures from 1e7 on; NaN: a dash.
std::string figure(double value, int digits);

// A length or place in a picture: two digits after the point at most, none that say nothing.
std::string pixels(double value);

// The page's text, with write_part(name) called where {{name}} stands in it.
void fill_page(std::ostream& out, std::string_view page, const std::function<void(std::string_view name)>& write_part);

// With padding.
std::string base64(std::string_view bytes);

}  // namespace sfsm::report
