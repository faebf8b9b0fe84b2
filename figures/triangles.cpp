#include "figures/triangles.h"

#include <limits>

namespace figures {

std::vector<Level> triangle_levels(const Figure& figure) {
    Level level;
    level.work[sfsm::WorkKind::single] = 1;
    level.work[sfsm::WorkKind::triangle] = static_cast<std::int64_t>(figure.mesh->triangle_count());
    level.reach = std::numeric_limits<float>::infinity();
    level.count = static_cast<std::uint32_t>(figure.mesh->indices.size());
    return {level};
}

}  // namespace figures
