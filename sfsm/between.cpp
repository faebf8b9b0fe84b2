#include "sfsm/between.h"

#include <algorithm>

#include "sfsm/same_bits.h"

namespace sfsm {

double between(double a, double b, double share) {
    const bool is_across_0 = (a <= 0 && b >= 0) || (a >= 0 && b <= 0);
    if (is_across_0) return share * b + (1 - share) * a;
    if (share == 1) return b;
    const double x = a + share * (b - a);
    return b > a ? std::min(x, b) : std::max(x, b);
}

}  // namespace sfsm
