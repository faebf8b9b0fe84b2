#include "figures/representation.h"

#include <algorithm>
#include <cmath>

namespace figures {

Part part_of(const Level& level, float demand) {
    if (!level.by_ones) return {level.count, 1.0f, level.work};
    const auto samples =
        std::clamp(demand, static_cast<float>(std::min(fewest_points, level.count)), static_cast<float>(level.count));
    Part part;
    part.count = static_cast<std::uint32_t>(std::ceil(samples));
    part.last_share = samples - static_cast<float>(part.count - 1);
    part.work[sfsm::WorkKind::point] = part.count;
    return part;
}

}  // namespace figures
