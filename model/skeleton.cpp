#include "model/skeleton.h"

#include <cassert>
#include <cstddef>

namespace model {

void resolve_hierarchy(const Skeleton& skeleton, std::vector<glm::mat4>& world, std::vector<glm::mat4>& palette) {
    assert(world.size() == skeleton.nodes.size());
    for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
        const std::int32_t parent = skeleton.nodes[i].parent;
        assert(parent < static_cast<std::int32_t>(i));
        if (parent >= 0) world[i] = world[static_cast<std::size_t>(parent)] * world[i];
    }
    palette.resize(skeleton.palette.size());
    for (std::size_t i = 0; i < skeleton.palette.size(); ++i) {
        const PaletteEntry& entry = skeleton.palette[i];
        palette[i] = world[static_cast<std::size_t>(entry.node)] * entry.inverse_bind;
    }
}

}  // namespace model
