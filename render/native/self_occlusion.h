// What of a body hides what of it: one pose looked at from a direction, from far away.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "figures/figure.h"

namespace render::native {

class SelfOcclusion {
public:
    // Of a pose; a share of the surface for each point (facets.h). The figure must outlive it.
    SelfOcclusion(const figures::Figure& figure, int pose, std::span<const float> shares);

    struct Seen {
        float silhouette = 0;  // [model units^2] area
        float facing = 0;      // sum over the visible points of their facets as they are seen, times their shares
    };
    // `direction`: unit, from the body towards the eye. Sets a bit for each point that nothing is in front of, 32 a
    // word; also for those that face away: seen from a little to the side they may not.
    Seen look_from(glm::vec3 direction, std::span<std::uint32_t> visible);

private:
    void draw_depths();
    void draw_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c);
    bool is_hidden(glm::vec3 at) const;

    const figures::Figure& figure_;
    int points_;
    bool double_sided_;
    std::vector<glm::vec3> vertices_;            // [model units]
    std::vector<glm::vec3> positions_, facets_;  // of the points; facets times shares
    std::vector<glm::vec3> seen_;                // vertices on the screen [cells], and height towards the eye
    std::vector<float> depth_;                   // of each cell: the height nearest to the eye
    float cells_per_unit_ = 0;
    glm::vec3 right_{0}, up_{0}, towards_{0}, low_{0};
};

}  // namespace render::native
