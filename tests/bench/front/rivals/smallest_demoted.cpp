#include "tests/bench/front/rivals/smallest_demoted.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bench::front {

namespace {

constexpr int most_levels = 24;  // from any mesh to the floor

}  // namespace

Rival::Detail SmallestDemoted::at_level(const render::Subject& subject, int level) const {
    const Detail full = full_of(subject);
    if (level == 0 || !std::isfinite(subject.surface)) return full;
    const double most = static_cast<double>(choices_of(subject).most_samples());
    const double points = std::min(std::ceil(std::ldexp(full.points, -level)), most);
    return {std::max(points, least_of(full)), false};
}

float SmallestDemoted::points_of(const render::Subject& subject) const {
    const Detail detail = at_level(subject, subject.surface > lower_up_to_ ? level_ : level_ + 1);
    return detail.is_mesh ? std::numeric_limits<float>::infinity() : static_cast<float>(detail.points);
}

// Who is as large as the last who is demoted is too.
void SmallestDemoted::decide(std::span<const render::Subject> people) {
    lower_up_to_ = -1;
    for (level_ = 0; level_ < most_levels; ++level_) {
        double spent = 0, after = 0;
        for (const render::Subject& subject : people) {
            spent += at_level(subject, level_).points;
            after += at_level(subject, level_ + 1).points;
        }
        if (spent <= budget_) return;
        if (after > budget_) continue;
        for (const render::Subject& subject : people) {
            if (spent <= budget_) return;
            spent -= at_level(subject, level_).points - at_level(subject, level_ + 1).points;
            lower_up_to_ = subject.surface;
        }
        return;
    }
}

}  // namespace bench::front
