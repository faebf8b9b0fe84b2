// A front that nobody measured but that looks like one: for tests of the page, and to look at the page.
#pragma once

#include "tests/bench/front/page_crops.h"
#include "tests/bench/front/row.h"

namespace bench::front {

// Four crowds in 13 views, some 25 settings and 15 marks each; the same on every machine up to rounding.
Front made_up_front();

// Of every row of 20,000 people at a preset and of their references.
Crops made_up_crops(const Front& front);

}  // namespace bench::front
