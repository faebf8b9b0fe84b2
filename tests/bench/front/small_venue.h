// A few hundred people and small pictures, for tests.
#pragma once

#include "tests/bench/front/venue.h"

namespace bench::front {

inline constexpr std::int64_t few_people = 600;
inline constexpr Size small_size{160, 90};

inline Venue& small_venue() {
    static Venue venue(few_people, small_size, false);
    return venue;
}

}  // namespace bench::front
