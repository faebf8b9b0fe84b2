// The files of page/, which travel inside the program.
#pragma once

#include <string_view>

namespace bench::front {

// Of a file of page/; throws std::out_of_range of any other name.
std::string_view page_file(std::string_view name);

}  // namespace bench::front
