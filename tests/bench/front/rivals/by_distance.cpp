#include "tests/bench/front/rivals/by_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bench::front {

float ByDistance::points_of(const render::Subject& subject) const {
    const auto depth = static_cast<double>(subject.depth);
    if (depth < distances_.meshes_to || !std::isfinite(subject.surface)) return std::numeric_limits<float>::infinity();
    if (depth > distances_.splats_from) return 0;
    const double doublings = depth > distances_.points_to ? std::floor(std::log2(depth / distances_.points_to)) : 0;
    const float wanted = std::ceil(std::ldexp(subject.demand, -static_cast<int>(doublings)));
    return std::min(wanted, choices_of(subject).most_samples());
}

bool ByDistance::is_splat(const render::Subject& subject) const {
    const bool may_be = choices_of(subject).block_reach() >= 0;
    return Rival::is_splat(subject) || (may_be && static_cast<double>(subject.depth) > distances_.splats_from);
}

}  // namespace bench::front
