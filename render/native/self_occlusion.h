// What of a body hides what of it: one pose looked at from a direction, from far away.
//
// From the opposite direction the picture is the same, mirrored; what is nearest there is what is farthest here. So
// both are looked from at once: triangles that face the one eye are drawn for it, the others for the other.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "figures/figure.h"
#include "render/native/array.h"

namespace render::native {

class SelfOcclusion {
public:
    // Of a pose; a facet and a share of the surface for each point (facets.h).
    SelfOcclusion(const figures::Figure& figure, int pose, std::span<const glm::vec3> facets,
                  std::span<const float> shares);

    struct Seen {
        float silhouette = 0;  // [model units^2] area
        float facing = 0;      // sum over the visible points of their facets as they are seen, times their shares
        float squares = 0;     // sum of the squares of the same
        // A bit for each point that nothing is in front of, 32 a word; also for those that face away: seen from a
        // little to the side they may not. And what a point adds to `facing`. Until the next look.
        std::span<const std::uint32_t> visible;
        std::span<const float> shown;
    };
    // From `direction`, unit, from the body towards the eye; and from the opposite one.
    std::array<Seen, 2> look_both_ways(glm::vec3 direction);

    // x, y, z, as many as there are, filled up with copies of the last.
    using Axes = std::array<Array<float>, 3>;

private:
    void add_triangles(const model::Mesh& mesh);
    // Those pieces of one that a mask leaves.
    void add_pieces(const model::Mesh& mesh, std::size_t triangle, int along);

    int points_;
    bool double_sided_;
    std::array<Array<std::int32_t>, 3> corners_;  // of the triangles, filled up with some that have no area
    Axes vertices_;                               // [model units]
    Axes positions_, facets_;                     // of the points; facets times shares
    Axes on_screen_;                              // vertices [cells], and height towards the first eye
    // For each eye, of each cell, the height of what is nearest to it: of surfaces that face it, and of others, where
    // these show.
    std::array<std::array<Array<float>, 2>, 2> heights_;
    std::array<Array<std::uint32_t>, 2> visible_;
    std::array<Array<float>, 2> shown_;
};

}  // namespace render::native
