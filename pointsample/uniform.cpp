#include "pointsample/uniform.h"

#include <algorithm>

#include "sfsm/random.h"

namespace pointsample {

using sfsm::lower_unit;
using sfsm::stream;
using sfsm::upper_unit;

AliasTable::AliasTable(const Surface& surface) {
    std::vector<double> share;
    for (std::size_t i = 0; i < surface.triangle_count(); ++i) {
        const double area = surface.area(i);
        if (!(area > 0)) continue;
        slots_.push_back({~0u, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i)});
        share.push_back(area);
    }
    const std::size_t n = share.size();
    for (double& s : share) s *= static_cast<double>(n) / surface.total_area();
    // `small` runs through the slots with less than the mean, `large` through those with more; what a large one gives
    // away may make it small in its turn.
    const auto skip = [&](std::size_t i, bool below_mean) {
        while (i < n && (share[i] < 1) != below_mean) ++i;
        return i;
    };
    std::size_t large = skip(0, false), next_small = skip(0, true), small = next_small;
    while (small < n && large < n) {
        slots_[small].threshold = static_cast<std::uint32_t>(std::min(share[small] * 0x1p32, 0x1p32 - 1));
        slots_[small].other = slots_[large].own;
        share[large] -= 1 - share[small];
        if (share[large] < 1 && large < next_small) {
            small = large;  // it will not come up again
            large = skip(large + 1, false);
        } else {
            if (share[large] < 1) large = skip(large, false);
            next_small = skip(next_small + 1, true);
            small = next_small;
        }
    }
}

motion::SurfacePoint AliasTable::draw(std::uint64_t seed, std::uint64_t index) const {
    const std::uint64_t a = stream(seed, 2 * index), b = stream(seed, 2 * index + 1);
    const Slot& slot = slots_[(a >> 32) * slots_.size() >> 32];
    const std::uint32_t triangle = static_cast<std::uint32_t>(a) < slot.threshold ? slot.own : slot.other;
    const float u = upper_unit(b), v = lower_unit(b);
    const bool outside = u > 1 - v;  // the triangle: folded over, without a branch; all of this is exact
    return {triangle, outside ? 1 - u : u, outside ? 1 - v : v};
}

}  // namespace pointsample
