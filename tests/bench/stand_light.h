// How bright and of which colour a stand's people are, however small they are and by however many points they are
// drawn: before black, so that nothing else counts.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace bench {

inline constexpr double stand_heights[] = {1, 2, 4, 8, 16, 32, 64, 128, 400};  // [px] of a standing person
// [px] 0: triangles, natively, by which the measure itself is known.
inline constexpr double stand_splat_sizes[] = {0, 0.35, 0.5, 1, 1.4, 1.68, 2, 4};
inline constexpr double stand_elevations[] = {0.15, 0.9};  // [rad] of the camera above the people

// Shares by which a stand drawn natively is off from the reference.
struct LightError {
    double brightness = 0;  // of the luma of mean linear light
    glm::dvec3 channels{0};
    double coverage = 0;  // of how much of what is behind the people they hide
};

// Of the stands and sizes above. Found when first asked for, all at once.
const LightError& light_error(std::size_t elevation, std::size_t height, std::size_t splat_size);

// Who is drawn as triangles there, as a share of the people.
double share_of_triangles(std::size_t elevation, std::size_t height, std::size_t splat_size);

}  // namespace bench
