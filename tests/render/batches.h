// Batches in words.
#pragma once

#include "figures/points.h"
#include "render/frame.h"

namespace tests {

// How many points each person of it gets; 0: they are drawn by something else.
inline std::uint32_t points_each(const render::Batch& batch) {
    const std::string_view name = figures::representations()[batch.representation].name;
    return name == figures::points.name ? batch.count : 0;
}

}  // namespace tests
