#include "figures/representation.h"

#include "figures/points.h"
#include "figures/triangles.h"

namespace figures {

std::span<const Representation> representations() {
    static constexpr Representation list[] = {triangles, points};
    return list;
}

}  // namespace figures
