// The constants of what is expected, fitted to what was measured of pictures of presets.
#pragma once

#include "tests/bench/loss/model.h"

namespace bench::loss {

// To views of nobody, each by its relative error.
render::native::BackdropErrors fit_backdrop(const std::vector<Picture>& pictures);

// Of people who only move less often there may be pictures, and then motion's constants are fitted, or not.
enum class Motion { fitted, held };

// From `start`; constants that are 0 stay so. A picture counts by the relative error of what is expected of it, and its
// classes of people, together a third as much, by theirs.
figures::ExpectedError fit_people(const Measured& measured, const render::native::BackdropErrors& around,
                                  const figures::ExpectedError& start, Motion motion);

}  // namespace bench::loss
