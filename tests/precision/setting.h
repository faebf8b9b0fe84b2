// Where, when and how a picture is taken whose arithmetic is held against double precision.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/view.h"
#include "scene/camera_path.h"

namespace precision {

inline constexpr std::int64_t thirty_days = std::int64_t{30} * 24 * 3600 * 60;  // [ticks]

struct Setting {
    double origin;      // [m] of what is looked at from the world's
    std::int64_t tick;  // into the run
    double fov;         // [degrees] vertical
    int width, height;  // [px]

    glm::dvec3 place() const;  // [m] world: so far from its origin, in a direction along no axis
    // [m] Where somebody takes a third of the picture's height, but at least two metres.
    double distance() const;
    double pixels_per_metre(double depth) const;
};

inline constexpr std::array origins{1.0, 1e3, 1e5, 1e7};  // [m]
inline constexpr std::array<std::int64_t, 2> ticks{0, thirty_days};
struct Lens {
    double fov;         // [degrees]
    int width, height;  // [px]
};
inline constexpr std::array lenses{Lens{1, 1, 1}, Lens{170, 1, 1}, Lens{1, 7680, 4320}, Lens{170, 7680, 4320}};

// A picture of `target` [m, world] from the setting's distance; `number` says from where.
scene::CameraPose aim(const Setting& setting, const glm::dvec3& target, int number);

// Where double precision sees things.
struct Eye {
    glm::dvec3 position, right, up, forward;
    double tan_x, tan_y;
    int width, height;

    Eye(const scene::CameraPose& pose, int width, int height);
    double depth(const glm::dvec3& from_eye) const { return glm::dot(forward, from_eye); }
    glm::dvec2 pixel(const glm::dvec3& from_eye) const;  // from the picture's top left corner
    bool shows(const glm::dvec2& pixel) const;
};

// How far off something is [px].
struct Errors {
    double worst = 0, sum = 0;
    std::int64_t count = 0;

    void add(double px);
    double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
    void include(const Errors& other);
};

}  // namespace precision
