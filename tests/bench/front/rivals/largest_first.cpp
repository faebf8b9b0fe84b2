#include "tests/bench/front/rivals/largest_first.h"

#include <cmath>
#include <limits>
#include <ranges>

namespace bench::front {

float LargestFirst::points_of(const render::Subject& subject) const {
    if (!std::isfinite(subject.surface)) return std::numeric_limits<float>::infinity();
    const Detail full = full_of(subject);
    if (!(subject.surface > full_above_)) return static_cast<float>(least_of(full));
    return full.is_mesh ? std::numeric_limits<float>::infinity() : static_cast<float>(full.points);
}

// Who is as large as somebody for whom nothing is left has the floor too.
void LargestFirst::decide(std::span<const render::Subject> people) {
    double spent = 0;
    for (const render::Subject& subject : people) {
        const Detail full = full_of(subject);
        spent += std::isfinite(subject.surface) ? least_of(full) : full.points;
    }
    full_above_ = -1;
    for (const render::Subject& subject : people | std::views::reverse) {
        if (!std::isfinite(subject.surface)) continue;
        const Detail full = full_of(subject);
        spent += full.points - least_of(full);
        if (spent <= budget_) continue;
        full_above_ = subject.surface;
        break;
    }
}

}  // namespace bench::front
