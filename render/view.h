// A camera as the renderer uses it. Distances are subtracted in double once, here; after that everything is float32
// relative to the camera. docs/precision.md says how far that carries.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "motion/pose.h"
#include "scene/camera_path.h"

namespace render {

// What is at `at` [m], seen from `eye` [m], both from one origin.
inline glm::vec3 relative(glm::vec3 at, const glm::dvec3& eye) {
    return glm::vec3(glm::dvec3(at) - eye);
}

struct View {
    int width = 0, height = 0;                                 // [px]
    glm::dvec3 position{0.0};                                  // [m] world, or from where from() was told
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // world, orthonormal
    float tan_half_x = 1, tan_half_y = 1;
    glm::mat4 clip_from_camera_relative{1.0f};  // reversed depth: near plane 1, infinity 0
    std::array<glm::vec4, 5> planes;  // left, right, bottom, top, near: inward unit normal, offset; camera-relative

    // The same view for what is told from `origin` [m].
    View from(const glm::dvec3& origin) const {
        View view = *this;
        view.position -= origin;
        return view;
    }
    glm::vec3 relative(glm::vec3 at) const { return render::relative(at, position); }
    float depth(glm::vec3 relative_position) const { return glm::dot(forward, relative_position); }  // [m]
    // Pixels that one metre across the view covers at a depth [m] > 0.
    float pixels_per_metre(float depth_m) const { return 0.5f * static_cast<float>(height) / (tan_half_y * depth_m); }
};

// Whether a picture of the one is one of the other, to the bit.
bool same_view(const View& a, const View& b);

inline constexpr float near_plane = 0.1f;  // [m]

// `pose.target` straight above or below `pose.position` is fine. width, height > 0.
View make_view(const scene::CameraPose& pose, int width, int height);

enum class Overlap { outside, partly, inside };

// Of a box told from the view's origin / a camera-relative sphere with the view's frustum. Conservative: never says
// outside of what shows.
Overlap overlap(const View& view, const motion::Bounds& box);
bool sphere_visible(const View& view, glm::vec3 relative_center, float radius);

// [m] View depths of such a box.
struct DepthRange {
    float nearest, farthest;
};
DepthRange depth_range(const View& view, const motion::Bounds& box);

}  // namespace render
