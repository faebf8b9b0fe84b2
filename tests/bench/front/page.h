// Run time against error for people to read: one HTML file that needs nothing else.
#pragma once

#include <string>

#include "tests/bench/front/page_crops.h"
#include "tests/bench/front/row.h"

namespace bench::front {

// Text may hold anything: it is escaped. The same front gives the same bytes. About 1 KB a row and 4/3 of the crops'
// bytes. Throws std::runtime_error of a crop that is neither PNG nor JPEG or of a row that isn't there.
std::string page_of(const Front& front, const Crops& crops);

}  // namespace bench::front
