#include "sfsm/frame_times/percentile.h"

#include <cmath>

namespace sfsm {

Place place_of(double one_in, std::int64_t frames) {
    const double place = (static_cast<double>(frames) + 1.0 / 3) / one_in + 1.0 / 3;
    if (place < 1) return {1, 0};
    if (place >= static_cast<double>(frames)) return {frames, 0};
    const double rank = std::floor(place);
    return {static_cast<std::int64_t>(rank), place - rank};
}

double rate_of(double ms) {
    return 1000 / ms;
}

}  // namespace sfsm
