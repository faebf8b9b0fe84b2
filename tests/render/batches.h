// Batches in words.
#pragma once

#include "figures/representation.h"
#include "render/frame.h"

namespace tests {

// How many points each person of it gets; 0: triangles.
inline std::uint32_t points_each(const render::Batch& batch) {
    return figures::representations()[batch.representation].is_mesh ? 0 : batch.count;
}

}  // namespace tests
