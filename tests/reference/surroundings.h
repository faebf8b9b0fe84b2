// Light, sky and ground of a clear afternoon.
#pragma once

#include <glm/glm.hpp>

#include "tests/reference/picture.h"

namespace reference {

// Linear light on a surface with this unit normal; `open`: the share that it gets of what comes from above and below.
glm::dvec3 light_on(const glm::dvec3& normal, double open = 1);

// Linear light to a stored colour [0, 255]; the picture's curve is a square root.
glm::dvec3 stored(const glm::dvec3& linear);

// Along a ray of any length.
Shade sky(const glm::dvec3& ray);

// At x, z from the structure's origin, where a pixel may look anywhere within `blur` [m]. `scene` says where the track
// is.
Shade ground(const Scene& scene, const glm::dvec2& xz, double blur);

// The same, the mean over one pixel whose middle is at `xz` and whose sides reach `to_right` and `to_below` [m].
glm::dvec3 ground_seen(const Scene& scene, const glm::dvec2& xz, const glm::dvec2& to_right,
                       const glm::dvec2& to_below);

}  // namespace reference
