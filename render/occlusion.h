// Whom what stands in a place hides.
#pragma once

#include <glm/glm.hpp>

#include "motion/pose.h"
#include "render/view.h"

namespace render {

// The farthest of what is seen in each block of pixels, from the picture's top left corner, row by row:
// near_plane / view depth, 0 where the sky is. It owns nothing.
struct Occlusion {
    static constexpr int block_side = 8;  // [px]
    const float* farthest = nullptr;
    int stride = 0, columns = 0, rows = 0;  // [blocks]
    float margin = 0;                       // [px] so far around what is asked about it may show as well

    // Whether a camera-relative ball / a box told from the view's origin is hidden in every pixel. Never says so of
    // what shows. `view` is the one that this was made for, from any origin.
    bool hides_ball(const View& view, glm::vec3 center, float radius) const;
    bool hides_box(const View& view, const motion::Bounds& box) const;

private:
    // Of normalized device coordinates, y up; and of the depth of what is nearest in there.
    bool hides(glm::vec2 low, glm::vec2 high, float nearest_depth, const View& view) const;
};

}  // namespace render
