// Plain area-uniform sampling: points that know nothing of each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pointsample/surface.h"

namespace pointsample {

// Triangles drawn with a probability proportional to their area, in constant time (Walker 1977, Vose 1991). 12 bytes a
// triangle, 20 while it is made. Areas are right to 2^-32 of the mean.
class AliasTable {
public:
    explicit AliasTable(const Surface& surface);

    // Point `index` of the seed's stream: it depends on these two alone, so that any prefix is uniform and any part can
    // be made on its own.
    motion::SurfacePoint draw(std::uint64_t seed, std::uint64_t index) const;

private:
    struct Slot {
        std::uint32_t threshold, own, other;
    };
    std::vector<Slot> slots_;
};

}  // namespace pointsample
