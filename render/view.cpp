#include "render/view.h"

#include <cmath>

namespace render {

namespace {

// Infinite far plane, depth reversed: float32 depth keeps its precision to the horizon.
glm::mat4 projection(float tan_half_x, float tan_half_y) {
    glm::mat4 m(0.0f);
    m[0][0] = 1.0f / tan_half_x;
    m[1][1] = 1.0f / tan_half_y;
    m[2][3] = -1.0f;
    m[3][2] = near_plane;
    return m;
}

glm::mat4 rotation_to_camera(const View& view) {
    glm::mat4 m(1.0f);
    for (int axis = 0; axis < 3; ++axis) {
        m[axis][0] = view.right[axis];
        m[axis][1] = view.up[axis];
        m[axis][2] = -view.forward[axis];
    }
    return m;
}

}  // namespace

View make_view(const scene::CameraPose& pose, int width, int height) {
    View view;
    view.width = width;
    view.height = height;
    view.position = pose.position;
    view.forward = glm::vec3(pose.forward());
    // Looking straight up or down leaves no horizon: any heading will do.
    constexpr float nearly_vertical = 0.9999f;
    const glm::vec3 zenith = std::abs(view.forward.y) > nearly_vertical ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    view.right = glm::normalize(glm::cross(view.forward, zenith));
    view.up = glm::cross(view.right, view.forward);
    view.tan_half_y = static_cast<float>(std::tan(0.5 * pose.fov_y));
    view.tan_half_x = view.tan_half_y * static_cast<float>(width) / static_cast<float>(height);
    view.clip_from_camera_relative = projection(view.tan_half_x, view.tan_half_y) * rotation_to_camera(view);

    const glm::vec3 f = view.forward;
    view.planes = {glm::vec4(glm::normalize(f * view.tan_half_x + view.right), 0.0f),
                   glm::vec4(glm::normalize(f * view.tan_half_x - view.right), 0.0f),
                   glm::vec4(glm::normalize(f * view.tan_half_y + view.up), 0.0f),
                   glm::vec4(glm::normalize(f * view.tan_half_y - view.up), 0.0f), glm::vec4(f, -near_plane)};
    return view;
}

bool same_view(const View& a, const View& b) {
    return a.width == b.width && a.height == b.height && a.position == b.position &&
           a.clip_from_camera_relative == b.clip_from_camera_relative;
}

Overlap overlap(const View& view, const motion::Bounds& box) {
    const glm::vec3 center = view.relative(box.center());
    const glm::vec3 half = 0.5f * box.size();
    Overlap result = Overlap::inside;
    for (const glm::vec4& plane : view.planes) {
        const glm::vec3 normal(plane);
        const float distance = glm::dot(normal, center) + plane.w;
        const float reach = glm::dot(glm::abs(normal), half);
        if (distance < -reach) return Overlap::outside;
        if (distance < reach) result = Overlap::partly;
    }
    return result;
}

DepthRange depth_range(const View& view, const motion::Bounds& box) {
    const float middle = view.depth(view.relative(box.center()));
    const float reach = 0.5f * glm::dot(glm::abs(view.forward), box.size());
    return {middle - reach, middle + reach};
}

bool sphere_visible(const View& view, glm::vec3 relative_center, float radius) {
    for (const glm::vec4& plane : view.planes)
        if (glm::dot(glm::vec3(plane), relative_center) + plane.w < -radius) return false;
    return true;
}

}  // namespace render
